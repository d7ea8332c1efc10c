from __future__ import annotations

import pytest

from cuspaudit.algebra.msolve_points import msolve_points, parse_parametrization
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import UnableError

RING = Ring(["x", "y"])
X, Y = RING.gens

#: msolve on {x^2 = 2, y^2 = 3}, with a variable A = -(x + y) of its own
OWN = """[0, [0, 3, 4, ['x', 'y', 'A'], [1,1,1], [1,
[[4, [1, 0, -10, 0, 1]], [3, [0, -20, 0, 4]],
[[[3, [8, 0, 8, 0]], 1], [[3, [-12, 0, 12, 0]], 1]]]]]]:"""


def test_a_variable_of_msolve_s_own_is_minus_its_form() -> None:
    """The parameter A is -x - y; the points are the four (±√2, ±√3)."""
    found = parse_parametrization(OWN)
    assert found is not None
    assert found.form == (-1, -1, 0)
    ring = Ring(["x", "y", "A"])
    x, y, a = ring.gens
    for p in (x**2 - 2, y**2 - 3, a + x + y):
        assert found.vanishes(ring, p)


def test_denominators_are_read() -> None:
    """Coordinates over c_i w' with w not monic: (1/2, 1/3) from msolve itself."""
    found = msolve_points(RING, [2 * X - 1, 3 * Y - 1], ("x", "y"), 10, 1)
    assert found.degree == 1
    (point,) = found.real_points()
    assert point.sign(6 * X * Y - 1, RING) == 0 == point.sign(2 * X - 1, RING)


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize(
    "equations",
    [
        (X**2 - 1, Y**2 - 1),
        (X**2 + Y**2 - 25, X * Y - 12),
        (X**3 - Y**2, X * Y),
        ((X - 1) ** 2, Y**3 - 2),
        (X**2 + 1, Y - X),
    ],
)
def test_it_finds_what_the_exact_route_finds(
    equations: tuple[Polynomial, ...], seed: int
) -> None:
    """Simple, multiple and complex points: the same sets, with no ground claimed."""
    exact = solve_zero_dimensional(PolynomialSystem(RING, equations))
    found = msolve_points(RING, equations, ("x", "y"), 10, seed)
    assert found.same_points(exact)
    assert found.grounds == ()


def test_no_solution_and_infinitely_many() -> None:
    """[-1] is the empty set; a curve is an error."""
    assert msolve_points(RING, [X, X - 1], ("x", "y"), 10, 1).degree == 0
    with pytest.raises(UnableError, match="infinitely many"):
        msolve_points(RING, [X * Y], ("x", "y"), 10, 1)


def test_a_form_that_does_not_separate_is_followed_by_another() -> None:
    """Pairs of roots of t^6 - t - 1: with this seed the first form is symmetric."""
    ring = Ring(["x", "y", "v"])
    x, y, v = ring.gens
    system = [x**6 - x - 1, y**6 - y - 1, v * x - 1]
    assert msolve_points(ring, system, ("x", "y"), 10, seed=5).degree == 36
