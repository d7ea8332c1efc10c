from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from flint import fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import DegenerateMapError, UnableError
from cuspaudit.geometry.fibers import proposal
from cuspaudit.geometry.fibers.generic_fiber import function_equation, generic_fiber

PLANE = Ring(["x", "y"])
X, Y = PLANE.gens
R2 = PolynomialSystem(PLANE)
CUSP = PolynomialMap(PLANE, (X**3 + X * Y, Y))
TORUS = Ring(["c", "s", "e", "t"])
C, S, E, T = TORUS.gens
CIRCLES = PolynomialSystem(TORUS, (C**2 + S**2 - 1, E**2 + T**2 - 1))


def test_the_cusp_has_its_cubic() -> None:
    """Over (u, v) the Whitney cusp has the points x^3 + v x = u, y = v."""
    fiber = generic_fiber(R2, CUSP)
    t, u, v = fiber.ring.gens
    assert fiber.form == (1, 0)
    assert fiber.omega / fiber.leading == t**3 + v * t - u
    assert (fiber.discriminant / (4 * v**3 + 27 * u**2)).is_constant()


def test_sheets_are_all_the_real_points_of_a_fiber() -> None:
    """The sheets over (1, -3) are the three roots of x^3 - 3x = 1, increasing."""
    sheets = generic_fiber(R2, CUSP).sheets((fmpq(1), fmpq(-3)))
    roots = sorted(np.roots([1, 0, -3, -1]).real)
    assert np.allclose([float(x.mid()) for x, _ in sheets], roots)
    assert all(y.contains(-3) for _, y in sheets)


def test_a_form_is_found_when_no_coordinate_separates() -> None:
    """(c, e) has 4 points on a generic fiber; no coordinate tells them apart."""
    fiber = generic_fiber(CIRCLES, PolynomialMap(TORUS, (C, E)))
    assert fiber.degree == 4
    assert sum(1 for weight in fiber.form if weight) > 1
    assert len(fiber.sheets((fmpq(1, 3), fmpq(1, 5)))) == 4


def test_names_of_the_values_avoid_those_of_the_variables() -> None:
    """A variety in the variables t, y1 and e is no problem."""
    ring = Ring(["t", "y1", "e"])
    t, y1, e = ring.gens
    sphere = PolynomialSystem(ring, (t**2 + y1**2 + e**2 - 1,))
    fiber = generic_fiber(sphere, PolynomialMap(ring, (t, y1)))
    assert fiber.degree == 2
    assert not set(fiber.ring.variables) & set(ring.variables)


def test_a_map_without_rank_is_refused() -> None:
    """(x, x^2) has rank 1 everywhere."""
    with pytest.raises(DegenerateMapError):
        generic_fiber(R2, PolynomialMap(PLANE, (X, X**2)))


def test_a_component_without_rank_puts_its_values_among_the_atypical() -> None:
    """On x y = 0 the map x is constant on x = 0, whose value is in {lc disc = 0}."""
    cross = PolynomialSystem(PLANE, (X * Y,))
    fiber = generic_fiber(cross, PolynomialMap(PLANE, (X,)))
    assert not fiber.is_regular((fmpq(0),))
    assert len(fiber.sheets((fmpq(2),))) == 1


def test_the_equation_of_a_function_vanishes_on_its_values() -> None:
    """Delta = 3x^2 + y of the cusp is 9/4 + v at x = -3/2 and there a root of mu."""
    fiber = generic_fiber(R2, CUSP)
    mu = function_equation(fiber, 3 * X**2 + Y)
    x, y = fmpq(-3, 2), fmpq(5)
    value = mu.subs({"t": 3 * x**2 + y, "y1": x**3 + x * y, "y2": y})
    assert value == 0
    assert mu.degrees()[0] == 3


def doubled(a: Polynomial) -> Polynomial:
    """A polynomial with one coefficient changed."""
    return a + a.context().gens()[-2]


def squared(a: Polynomial) -> Polynomial:
    """A polynomial with superfluous zeros."""
    return a * a


@pytest.mark.parametrize("change", [doubled, squared])
def test_a_wrong_elimination_is_an_error(
    monkeypatch: pytest.MonkeyPatch, change: Callable[[Polynomial], Polynomial]
) -> None:
    """No proposal of msolve is believed: a changed one is refused."""
    true = proposal.propose_elimination

    def lie(*args: object) -> list[Polynomial]:
        return [change(p) for p in true(*args)]  # type: ignore[arg-type]  # same call

    monkeypatch.setattr(proposal, "propose_elimination", lie)
    with pytest.raises(UnableError):
        generic_fiber(R2, CUSP)


def test_the_time_limit_ends_the_eliminations() -> None:
    """No time at all is an error that names the step."""
    with pytest.raises(UnableError, match="atypical_values"):
        generic_fiber(R2, CUSP, timeout=0)


def test_a_reordered_fiber_is_that_of_the_reordered_map() -> None:
    """omega, rho and the discriminant agree with those computed for (r_2, r_1)."""
    moved = generic_fiber(R2, CUSP).reordered((1, 0))
    own = generic_fiber(R2, PolynomialMap(PLANE, CUSP.components[::-1]))
    assert moved.mapping.components == own.mapping.components
    assert (moved.omega, moved.rho) == (own.omega, own.rho)
    assert moved.discriminant == own.discriminant
