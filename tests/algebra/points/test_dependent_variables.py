"""Variables that are polynomials in the others, left out and put back."""

from __future__ import annotations

from cuspaudit.algebra.points.dependent_variables import without_dependents
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem

SPACE = Ring(["x", "y", "z"])
X, Y, Z = SPACE.gens


def test_chains_of_variables_come_back() -> None:
    """X by y, y by z: the zeros are those of the whole system."""
    equations = [X - Y**3 - Z, Y - 2 * Z + 1, Z**2 - 3 * Z + 1]
    smaller = without_dependents(SPACE, equations)
    assert smaller is not None
    assert smaller.ring.variables == ("z",)
    own = PolynomialSystem(smaller.ring, smaller.equations)
    found = smaller.lifted(solve_zero_dimensional(own))
    assert found.variables == ("x", "y", "z")
    assert all(found.vanishes(SPACE, p) for p in equations)
    whole = PolynomialSystem(SPACE, tuple(equations))
    assert found.same_points(solve_zero_dimensional(whole))


def test_constants_are_variables_with_values() -> None:
    """Y = 5, and x twice it: one point over each z."""
    smaller = without_dependents(SPACE, [Y - 5, X - 2 * Y, Z**2 - X])
    assert smaller is not None
    found = smaller.lifted(
        solve_zero_dimensional(PolynomialSystem(smaller.ring, smaller.equations))
    )
    assert found.degree == 2
    assert all(found.vanishes(SPACE, p) for p in (Y - 5, X - 10, Z**2 - 10))


def test_long_values_stay_where_they_are() -> None:
    """X = y^2 + z^2 is not put into another equation; without linear ones none is."""
    assert without_dependents(SPACE, [X - Y**2 - Z**2, X**2 - Z, X * Y - 1]) is None
    assert without_dependents(SPACE, [X**2 - Y, Y**2 - X * Z, X * Z - 2]) is None


def shape() -> tuple[Ring, list[Polynomial]]:
    """(t^2 - 2)^4 (t^2 + 1)^5 = 0, and two long polynomials in t."""
    ring = Ring(["a", "b", "t"])
    a, b, t = ring.gens
    powers = [sum((k * k - 7 * k + 3) % 19 * t**k for k in range(18)), 0]
    powers[1] = sum((k**3 + 5 * k + 1) % 23 * t**k for k in range(18))
    return ring, [
        (t**2 - 2) ** 4 * (t**2 + 1) ** 5,
        1451 * a - powers[0],
        4784 * b + powers[1],
    ]


def test_multiple_zeros_in_shape_position() -> None:
    """Of eighteen zeros four differ, and two are real: completely listed."""
    ring, equations = shape()
    found = solve_zero_dimensional(PolynomialSystem(ring, tuple(equations)))
    assert (found.degree, len(found.real_points())) == (4, 2)
    assert all(found.vanishes(ring, p) for p in equations)
