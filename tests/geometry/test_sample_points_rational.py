from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq
from surfaces import labels

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import UnableError
from cuspaudit.geometry.sample_points_rational import sample_points_rational

RING = Ring(["x", "y"])
X, Y = RING.gens
SHAPES: dict[str, tuple[list[Polynomial], int]] = {
    "nothing": ([], 1),
    "a constant": ([RING.constant(3)], 1),
    "circle": ([X**2 + Y**2 - 1], 2),
    "cross": ([X, Y], 4),
    "cross as one product": ([X * Y], 4),
    "three lines": ([X, Y, X + Y - 1], 7),
    "nodal cubic": ([Y**2 - X**2 * (X + 1)], 3),
    "cuspidal cubic": ([Y**2 - X**3], 2),
    "two ovals": ([Y**2 + (X**2 - 1) * (X**2 - 4)], 3),
    "hyperbola": ([X * Y - 1], 3),
    "vertical line and circle": ([X, X**2 + Y**2 - 1], 4),
    "a point": ([X**2 + Y**2], 1),
    "lemniscate": ([(X**2 + Y**2) ** 2 - X**2 + Y**2], 3),
    "repeated": ([(X**2 + Y**2 - 1) ** 2 * X], 4),
    "two circles, 1e-6 apart": (
        [X**2 + Y**2 - 1, X**2 + Y**2 - 1 - fmpq(1, 10**6)],
        3,
    ),
}


def cells_of(polynomials: list[Polynomial], points: list[tuple[fmpq, ...]]) -> set[int]:
    """The cells that the points lie in, by a fine grid with every point on it."""
    xs = sorted(
        {0.0} | {float(x) for x, _ in points} | set(np.linspace(-3.01, 3.02, 200))
    )
    ys = sorted(
        {float(y) for _, y in points} | set(np.linspace(-3.03, 3.01, 200)) | {0.0}
    )
    gx, gy = np.meshgrid(xs, ys, indexing="ij")
    signs = np.zeros(gx.shape, dtype=int)
    for p in polynomials:
        value = sum(
            float(int(c.p) / int(c.q)) * gx ** int(i) * gy ** int(j)
            for (i, j), c in p.to_dict().items()
        )
        signs = 3 * signs + np.sign(value).astype(int)
    label = labels(signs, around=False)
    return {int(label[xs.index(float(x)), ys.index(float(y))]) for x, y in points}


@pytest.mark.parametrize("name", [n for n in SHAPES if "apart" not in n])
def test_every_cell_is_met(name: str) -> None:
    """The points lie off the curves and meet every cell of the plane."""
    polynomials, cells = SHAPES[name]
    points = sample_points_rational(RING, polynomials, ("x", "y"))
    for x, y in points:
        at = {"x": x, "y": y}
        assert all(RING.substitute(p, at) != 0 for p in polynomials)
    radical = [f for p in polynomials for f, _ in p.factor()[1]]
    assert len(cells_of(radical, points)) == cells


def test_a_thin_cell_is_met() -> None:
    """The ring between two circles 1e-6 apart has its point."""
    polynomials, _ = SHAPES["two circles, 1e-6 apart"]
    points = sample_points_rational(RING, polynomials, ("x", "y"))
    signs = {tuple(p(x, y) > 0 for p in polynomials) for x, y in points}
    assert signs == {(True, True), (True, False), (False, False)}


def test_over_a_quadratic_field() -> None:
    """The cells of (x - sqrt 2)(y^2 - 2) are met, double factor or not."""
    ring = Ring(["x", "y"], 2)
    x, y = ring.gens
    lines = [x - ring.surd, y**2 - 2]
    for polynomials in (lines, [lines[0], lines[1] ** 2], [lines[0] * lines[1]]):
        points = sample_points_rational(ring, polynomials, ("x", "y"))
        cells = {
            (float(u) > 2**0.5, float(v) > 2**0.5, float(v) < -(2**0.5))
            for u, v in points
        }
        assert len(cells) == 6


def test_dimension_one_and_three() -> None:
    """The real line and space fall into the cells they should."""
    line = Ring(["x"])
    x = line.gen("x")
    found = sample_points_rational(line, [x**3 - x], ("x",))
    assert [(v > 0) - (v < 0) for (v,) in found] == [-1, -1, 1, 1]
    space = Ring(["x", "y", "z"])
    x, y, z = space.gens
    points = sample_points_rational(space, [x, y, z], ("x", "y", "z"))
    assert len({tuple(c > 0 for c in p) for p in points}) == 8
    sphere = [x**2 + y**2 + z**2 - 1]
    points = sample_points_rational(space, sphere, ("x", "y", "z"))
    assert {sum(c * c for c in p) < 1 for p in points} == {True, False}


def test_points_that_are_refused_are_replaced() -> None:
    """A condition true outside a proper algebraic set is met in every cell."""
    refused: list[tuple[fmpq, ...]] = []

    def accept(point: tuple[fmpq, ...]) -> bool:
        x, y = point
        good = bool((x - y) * x * y * (x - 1) != 0)
        if not good:
            refused.append(point)
        return good

    points = sample_points_rational(RING, [X**2 + Y**2 - 4], ("x", "y"), accept)
    assert all(accept(point) for point in points)
    assert {x * x + y * y < 4 for x, y in points} == {True, False}
    assert refused


def test_a_condition_that_fails_over_a_whole_fiber_moves_the_fiber() -> None:
    """The cells of (x - sqrt 2)(y^2 - 2) are met, with a double factor or not."""
    simplest = sample_points_rational(RING, [X - 5, Y], ("x", "y"))[0][0]
    points = sample_points_rational(
        RING, [X - 5, Y], ("x", "y"), lambda p: bool(p[0] != simplest)
    )
    assert len(points) == 4
    assert all(x != simplest for x, _ in points)


def test_a_condition_that_always_fails_is_unable() -> None:
    """When nothing is accepted the search ends, and says so."""
    with pytest.raises(UnableError, match="no generic point"):
        sample_points_rational(RING, [X], ("x", "y"), lambda point: False)
