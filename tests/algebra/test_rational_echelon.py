"""Echelon forms with small numbers, against FLINT's."""

from __future__ import annotations

import random

from flint import fmpq, fmpq_mat, fmpz

from cuspaudit.algebra.rational_echelon import rational_echelon

rng = random.Random(5)


def whole(rows: int, columns: int, size: int) -> list[list[fmpz]]:
    """A random matrix of integers."""
    return [
        [fmpz(rng.randint(-size, size)) for _ in range(columns)] for _ in range(rows)
    ]


def test_the_form_is_that_of_flint() -> None:
    """Of random matrices, numbers of all lengths among them."""
    for size in (3, 10**6, 10**40):
        rows = whole(6, 11, size)
        expected, rank = fmpq_mat([[fmpq(v) for v in row] for row in rows]).rref()
        assert rank == 6
        pivots = [next(k for k in range(11) if expected[i, k] != 0) for i in range(6)]
        found = rational_echelon(rows, pivots)
        assert found is not None
        table, below, _ = found
        got = [[fmpq(v, below) for v in row] for row in table.tolist()]
        assert fmpq_mat(got) == expected


def test_dependent_rows_and_wrong_pivots_have_none() -> None:
    """Rows that are dependent, and pivots where they are, have no form."""
    rows = whole(3, 6, 9)
    rows[2] = [a + 2 * b for a, b in zip(rows[0], rows[1], strict=True)]
    assert rational_echelon(rows, [0, 1, 2]) is None
    rows = [[fmpz(v) for v in row] for row in ([1, 2, 3], [2, 4, 5])]
    assert rational_echelon(rows, [0, 1]) is None
    assert rational_echelon(rows, [0, 2]) is not None


def test_a_prime_that_hides_a_pivot_is_passed_over() -> None:
    """2^61 - 1 divides the pivot: the next prime tells."""
    rows = [[fmpz(2) ** 61 - 1, fmpz(1)]]
    found = rational_echelon(rows, [0])
    assert found is not None
    assert found[1] == 2**61 - 1
