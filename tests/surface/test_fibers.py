from __future__ import annotations

import itertools

import numpy as np
import pytest
from flint import arb, fmpq
from surfaces import arm_map, plane, torus

from cuspaudit.algebra.elimination import discriminant
from cuspaudit.algebra.numeric import numeric_values
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import DegenerateMapError, UnableError
from cuspaudit.geometry.crit import crit
from cuspaudit.surface.fibers import FiberPolynomials, fiber_polynomials
from cuspaudit.surface.roadmap import orient
from cuspaudit.surface.sample_points import sample_points
from cuspaudit.surface.surface import Surface, product_factors

Pair = tuple[PolynomialSystem, PolynomialMap]
ARMS = {
    "ISSAC": ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
    "sqrt 3": ((1, 2, 1), (0, 1, 0), (-30, 90, 0)),
    "sqrt 2": ((1, "3/2", 1), (0, 1, "1/2"), (45, -45, 0)),
    "general": ((1, "1.3", ".9"), (0, ".4", "-.7"), (70, 110, 0)),
    "1 || 2": ((1, "3/2", 1), (0, 1, "1/2"), (0, 90, 0)),
    "2 || 3": ((".05", 1, ".9"), (0, ".3", 0), (-90, 0, 0)),
    "a1 = 0": ((0, "3/2", 1), (0, 1, "1/2"), (-90, 90, 0)),
}


def fibers_of(pair: Pair) -> FiberPolynomials:
    """The fiber polynomials on the oriented surface."""
    variety, mapping = pair
    surface = Surface(variety.ring, *product_factors(variety))
    delta = surface.reduce(crit(variety, mapping)[0])
    return fiber_polynomials(orient(surface, delta), mapping)


def newton_postures(pair: Pair, value: tuple[float, float]) -> list[np.ndarray]:
    """All zeros of R - value on the torus, by Newton's method from a grid."""
    variety, mapping = pair

    def residual(q: np.ndarray) -> np.ndarray:
        columns = (np.cos(q[:, 0]), np.sin(q[:, 0]), np.cos(q[:, 1]), np.sin(q[:, 1]))
        points = np.stack(columns, axis=1)
        return numeric_values(variety.ring, mapping.components, points) - value

    q = np.array(list(itertools.product(np.linspace(-3, 3, 16), repeat=2)))
    for _ in range(30):
        error, steps = residual(q), 1e-6 * np.eye(2)
        J = np.stack(
            [(residual(q + e) - residual(q - e)) / 2e-6 for e in steps], axis=2
        )
        move = (np.linalg.pinv(J) @ error[:, :, None])[:, :, 0]
        q = q - np.clip(move, -0.3, 0.3)
    q = q[np.abs(residual(q)).max(axis=1) < 1e-9]
    points = np.stack([np.cos(q), np.sin(q)], axis=2).reshape(len(q), 4)
    found: list[np.ndarray] = []
    for point in points:
        if all(np.abs(point - other).max() > 1e-5 for other in found):
            found.append(point)
    return found


@pytest.mark.parametrize("name", ARMS)
def test_postures_are_those_of_newton_s_method(name: str) -> None:
    """Over a value with postures, sample_points finds what a dense search finds."""
    pair = arm_map(*ARMS[name])
    fibers = fibers_of(pair)
    names = pair[0].ring.variables
    for start in ((0.4, 0.9), (-2.0, 1.1), (2.2, -0.3)):
        point = [
            [np.cos(start[0]), np.sin(start[0]), np.cos(start[1]), np.sin(start[1])]
        ]
        at = numeric_values(pair[0].ring, pair[1].components, point)[0].round(3)
        value = (fmpq(round(1000 * at[0]), 1000), fmpq(round(1000 * at[1]), 1000))
        fiber = sample_points(fibers, value)
        found = [
            np.array(
                [float(ball.mid()) for ball in (p.coordinates(128)[n] for n in names)]
            )
            for p in fiber.postures
        ]
        wanted = newton_postures(pair, (at[0], at[1]))
        assert len(found) == len(wanted) > 0
        for posture in found:
            assert min(np.abs(posture - other).max() for other in wanted) < 1e-6


@pytest.mark.parametrize("name", ARMS)
def test_fiber_polynomials_vanish_on_the_map(name: str) -> None:
    """F(t; R(q)) = 0 at every q, for both eliminants."""
    variety, mapping = arm_map(*ARMS[name])
    fibers = fibers_of((variety, mapping))
    for y, x in ((fmpq(1, 3), fmpq(2, 5)), (fmpq(-7, 4), fmpq(5, 3))):
        at = fibers.surface.coordinates(arb(y), arb(x))
        u, v = (variety.ring.evaluate(r, at) for r in mapping.components)
        place = {"y": arb(y), "x": arb(x), "u": u, "v": v}
        for polynomial in (fibers.polynomial, *map(fibers.eliminant, "xy")):
            assert fibers.ring.evaluate(polynomial, place).contains(0)
        s1, s0 = (fibers.ring.evaluate(p, place) for p in fibers.linear_factor)
        assert (s1 * place[fibers.other] + s0).contains(0)


@pytest.mark.parametrize("name", ARMS)
def test_the_discriminant_belongs_to_the_polynomial(name: str) -> None:
    """It is not zero, and it is the discriminant up to a positive factor."""
    fibers = fibers_of(arm_map(*ARMS[name]))
    assert fibers.discriminant != 0
    assert fibers.polynomial.derivative(fibers.other) == 0
    again = discriminant(fibers.ring, fibers.polynomial, fibers.separating)
    assert again == fibers.discriminant


def test_the_separating_coordinate_is_the_one_that_separates() -> None:
    """A fold of x is told by x, whichever factor x is."""
    for build in (lambda x, y: (x**2, y), lambda x, y: (x, y**2)):
        fibers = fibers_of(plane(build))
        assert (
            fibers.polynomial.degrees()[
                fibers.ring.context.variable_to_index(fibers.separating)
            ]
            == 2
        )


def test_a_map_that_neither_coordinate_separates() -> None:
    """(x^2, y^2): four postures, two by two alike in x and in y."""
    with pytest.raises(UnableError, match="neither"):
        fibers_of(plane(lambda x, y: (x**2, y**2)))


def test_rank_below_two_is_degenerate() -> None:
    """A map to a curve has no fibers that are finite."""
    variety, mapping = plane(lambda x, y: (x + y, (x + y) ** 2))
    surface = Surface(variety.ring, *product_factors(variety))
    with pytest.raises(DegenerateMapError):
        fiber_polynomials(surface, mapping)


def test_a_map_that_stands_still_along_a_curve() -> None:
    """Where d_x R = 0 on a curve over an interval of y, x is the one that separates."""
    fibers = fibers_of(plane(lambda x, y: (y + (x - y) ** 2, y + 3 * (x - y) ** 2)))
    assert fibers.surface.fiber.names == ("x",)
    assert fibers.separating == "y"


def test_a_high_degree_is_outside() -> None:
    """A coordinate of degree above 2 needs higher subresultants."""
    fibers = fibers_of(plane(lambda x, y: (x**3 + x * y**2, x)))
    with pytest.raises(UnableError, match="degree 3"):
        sample_points(fibers, (fmpq(1), fmpq(1, 2)))


def test_the_chart_gap_is_not_zero() -> None:
    """The gap is a proper algebraic set, also where a missed point is a wall."""
    still = torus(
        lambda c2, s2, c3, s3: (c3 * (1 + c2) + s2 * s3, s3 * (1 + c2) - s2 * c3 + s2)
    )
    for pair in (arm_map((1, 1, 1), (0, 0, 0), (-90, 90, 0)), still):
        assert fibers_of(pair).chart_gap() != 0
