from __future__ import annotations

import pytest
from flint import fmpq

from cuspaudit.algebra.points.parametrization import (
    ZeroDimensionalParametrization,
    empty_set,
)
from cuspaudit.algebra.points.union import restricted, union, with_form
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import InvalidSystemError

RING = Ring(["x", "y"])
X, Y = RING.gens


def points(*equations: Polynomial, seed: int = 1) -> ZeroDimensionalParametrization:
    """All solutions of the equations."""
    return solve_zero_dimensional(PolynomialSystem(RING, equations), seed=seed)


A = (X**2 - 2, Y**2 - 3)
B = (X**2 - 2, Y**2 - 2)
BOTH = (X**2 - 2, (Y**2 - 3) * (Y**2 - 2))


@pytest.mark.parametrize("seed", range(3))
def test_a_disjoint_union_has_all_the_points(seed: int) -> None:
    """{x^2=2, y^2=3} ∪ {x^2=2, y^2=2} is {x^2=2, (y^2-3)(y^2-2)=0}, either way."""
    first, second = points(*A, seed=seed), points(*B, seed=seed + 7)
    whole = points(*BOTH)
    assert union(first, second, seed).same_points(whole)
    assert union(second, first, seed).same_points(whole)
    assert union(first, second).degree == 8


def test_common_points_come_once() -> None:
    """The union with a subset, with itself or with nothing is the set itself."""
    whole, part = points(*BOTH, seed=3), points(*A)
    assert union(whole, part).same_points(whole)
    assert union(part, part).same_points(part)
    assert union(part, empty_set(RING.variables)).same_points(part)
    assert union(empty_set(RING.variables), part).same_points(part)


def test_a_form_that_meets_two_points_at_one_value_is_given_up() -> None:
    """(0, 1) and (0, 2) parametrized by x are two points, not one."""
    form = (fmpq(1), fmpq(0))
    first = with_form(points(X, Y - 1), form)
    second = with_form(points(X, Y - 2), form)
    assert first is not None and second is not None
    joined = union(first, second)
    assert joined.degree == 2
    assert joined.contains((0, 1)) and joined.contains((0, 2))


def test_the_form_changes_and_the_points_do_not() -> None:
    """A separating form gives the same points; x alone does not separate four."""
    given = points(*A)
    changed = with_form(given, (fmpq(1), fmpq(5)))
    assert changed is not None and changed.form == (1, 5)
    assert changed.same_points(given)
    assert with_form(given, (fmpq(1), fmpq(0))) is None


def test_a_projection_that_is_one_to_one() -> None:
    """{(√2, √2), (-√2, -√2)} projects to x = ±√2."""
    diagonal = points(X**2 - 2, Y - X)
    line = restricted(diagonal, ("x",), (fmpq(1),))
    assert line.variables == ("x",)
    ring = Ring(["x"])
    assert line.degree == 2 and line.vanishes(ring, ring.gen("x") ** 2 - 2)


def test_points_of_different_spaces_have_no_union() -> None:
    """The variables must be the same, in the same order."""
    with pytest.raises(InvalidSystemError, match="points of one space"):
        union(points(*A), empty_set(("y", "x")))
