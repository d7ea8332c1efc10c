"""Jacobian matrices and determinants of polynomials."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from cuspaudit.algebra.ring import Polynomial, Ring

__all__ = ["determinant", "jacobian"]


def jacobian(ring: Ring, polynomials: Sequence[Polynomial]) -> list[list[Polynomial]]:
    """The matrix of d p_i / d x_j, rows in order, columns in the ring's order."""
    return [[p.derivative(name) for name in ring.variables] for p in polynomials]


def determinant(ring: Ring, matrix: Sequence[Sequence[Polynomial]]) -> Polynomial:
    """The determinant of a square matrix, reduced in the ring's field.

    Laplace expansion along the rows, each minor computed once: the matrices of this
    package are small and sparse, and the expansion divides by nothing.

    >>> ring = Ring(["x", "y"])
    >>> x, y = ring.gens
    >>> determinant(ring, [[x, y], [ring.constant(1), x]])
    x^2 - y
    """
    size = len(matrix)

    @cache
    def minor(row: int, columns: tuple[int, ...]) -> Polynomial:
        if row == size:
            return ring.constant(1)
        terms = []
        for position, column in enumerate(columns):
            entry = matrix[row][column]
            if entry != 0:
                rest = columns[:position] + columns[position + 1 :]
                terms.append(entry * minor(row + 1, rest) * (-1) ** position)
        return ring.reduce(ring.total(terms))

    return minor(0, tuple(range(size)))
