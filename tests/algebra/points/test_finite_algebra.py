from __future__ import annotations

from itertools import pairwise

import pytest
from flint import fmpq, fmpq_mat

from cuspaudit.algebra.points.finite_algebra import (
    parametrization_of,
    parametrize,
    quotient_algebra,
    radical_quotient,
    staircase,
)
from cuspaudit.algebra.points.ideal import groebner_basis
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import NotZeroDimensionalError

RING = Ring(["x", "y", "z"])
X, Y, Z = RING.gens
SYSTEMS = {
    "simple": ((X**2 - 2, Y**2 - X, Z - Y), 4, 4),
    "fat point": ((X**2, Y**2, Z**2, X * Y * Z), 7, 1),
    "two fat points": (((X - 1) ** 2 * X, Y - X**2, Z**2 - Y * Z), 6, 3),
    "one first coordinate": ((X, Y**2 - 3 * Y, Z**2 - 1), 4, 4),
    "nothing": ((X * Y - 1, X, Z), 0, 0),
}
CASES = pytest.mark.parametrize("name", SYSTEMS)


@CASES
def test_multiplications_commute_and_satisfy_the_equations(name: str) -> None:
    """M_x M_y = M_y M_x, and each equation is 0 in the matrices."""
    equations, size, _ = SYSTEMS[name]
    algebra = quotient_algebra(groebner_basis(RING, equations))
    assert algebra.dimension == size
    for a, b in pairwise(algebra.matrices):
        assert a * b == b * a
    for p in equations:
        assert value(p, algebra.matrices, size) == fmpq_mat(size, size)


@CASES
def test_the_radical_counts_distinct_points(name: str) -> None:
    """A / rad A has as many dimensions as there are points; so has omega."""
    equations, _, points = SYSTEMS[name]
    algebra = quotient_algebra(groebner_basis(RING, equations))
    reduced = radical_quotient(algebra)
    assert reduced.dimension == points
    found = parametrization_of(algebra, ("test",))
    assert found.degree == points
    assert all(found.vanishes(RING, p) for p in equations)


def test_a_form_that_does_not_separate_is_refused() -> None:
    """The points (0, y, z) of {y (y - 3) = 0, z^2 = 1} are not told apart by x."""
    equations, _, _ = SYSTEMS["one first coordinate"]
    algebra = quotient_algebra(groebner_basis(RING, equations))
    assert parametrize(algebra, (fmpq(1), fmpq(0), fmpq(0)), ()) is None
    assert parametrize(algebra, (fmpq(0), fmpq(1), fmpq(1)), ()) is not None


def test_infinitely_many_monomials_are_an_error() -> None:
    """A line has no finite staircase."""
    with pytest.raises(NotZeroDimensionalError, match="dimension 1"):
        staircase(groebner_basis(RING, (X, Y)))


def value(p: Polynomial, matrices: tuple[fmpq_mat, ...], size: int) -> fmpq_mat:
    """The polynomial at the commuting matrices."""
    total = fmpq_mat(size, size)
    identity = fmpq_mat([[int(i == j) for j in range(size)] for i in range(size)])
    for exponents, coefficient in p.to_dict().items():
        term = coefficient * identity
        for matrix, exponent in zip(matrices, exponents, strict=True):
            for _ in range(int(exponent)):
                term = term * matrix
        total = total + term
    return total
