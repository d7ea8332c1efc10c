"""The resultant of Raghavan and Roth over Q, and the null vectors at its roots.

In half-angle tangents t_i = tan(theta_i / 2) the matrix of `raghavan_roth` is a 12x12
matrix M(t_2), quadratic in t_2, with M(t_2) v = 0 for v = (t_3^a t_4^b), 0 <= a <= 3,
0 <= b <= 2, at every posture with finite t_2, t_3, t_4. So D = det M vanishes there.
Where D has a simple root the null space of M is a line, because the order of a root of
a determinant is at least the dimension of the null space; and D times the inverse of
M, the adjugate, has rank one there, its columns on that line.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mat, fmpq_poly
from numpy.typing import NDArray

from cuspaudit.errors import UnableError
from cuspaudit.kinematics.raghavan_roth import Arm, closed, fifth_axis, first_side

__all__ = ["DEGREE", "PosturePolynomial", "first_and_sixth", "posture_polynomial"]

Array = NDArray[Any]

_SIZE = 12
DEGREE = 2 * _SIZE
"""Of D, when no posture has t_2 infinite."""
_TO_TANGENT = np.array([[1, 1, 0], [0, 0, 2], [1, -1, 0]], dtype=object)
"""Coefficients of (1, c, s) to those of 1, t, t^2 over 1 + t^2."""


@dataclass(frozen=True, eq=False)
class PosturePolynomial:
    """D = det M and one column of the adjugate.

    Attributes:
        determinant: D, in t_2, not 0.
        null: twelve polynomials in t_2, index 3 a + b for t_3^a t_4^b.
        fifth: X of `raghavan_roth`, (14, 3, 3, 3).
        side: Y of `raghavan_roth`, (14, 9).
    """

    determinant: fmpq_poly
    null: tuple[fmpq_poly, ...]
    fifth: Array
    side: Array


def posture_polynomial(arm: Arm, pose: Array, seed: int) -> PosturePolynomial:
    """D and the null vectors of ``arm`` at ``pose``.

    Args:
        arm: entries rational (FLINT).
        pose: (4, 4), rational.
        seed: of the combination of columns.

    Raises:
        UnableError: D vanishes identically.
    """
    fifth = fifth_axis(arm)
    side = first_side(arm, closed(arm, pose)).reshape(14, 9)
    low, middle, high = _pencil(fifth, side)
    rng = np.random.default_rng(seed)
    column = fmpq_mat(_SIZE, 1, [int(x) for x in rng.integers(1, 1000, _SIZE)])
    points, determinants, vectors = [], [], []
    for k in range(3 * DEGREE):
        t = fmpq(k // 2 + 1) * (-1 if k % 2 else 1)
        matrix = fmpq_mat(_SIZE, _SIZE, list((low + t * middle + t * t * high).ravel()))
        determinant = matrix.det()
        if determinant == 0:
            continue
        points.append(t)
        determinants.append(determinant)
        vectors.append([x * determinant for x in matrix.solve(column).entries()])
        if len(points) == DEGREE + 1:
            break
    else:
        raise UnableError("exact postures", "the resultant vanishes identically")
    values = [[d, *v] for d, v in zip(determinants, vectors, strict=True)]
    resultant, *null = _interpolated(points, values)
    return PosturePolynomial(resultant, tuple(null), fifth, side)


def first_and_sixth(found: PosturePolynomial, right: Array) -> list[Any]:
    """(c1, s1, c6, s6) from the 14 numbers of the left side, linearly.

    Args:
        found: of the arm and pose.
        right: (14,) the numbers X at joints 2, 3, 4.
    """
    rows = _independent_rows(found.side)
    inverse = _array(_matrix(found.side[rows][:, 1:]).inv())
    products = inverse @ (right[rows] - found.side[rows][:, 0])
    return [products[0], products[1], products[2], products[5]]


def _pencil(fifth: Array, side: Array) -> tuple[Array, Array, Array]:
    """The (12, 12) coefficients of 1, t_2, t_2^2 in M."""
    rows = _independent_rows(side)
    others = [k for k in range(14) if k not in rows]
    share = side[others][:, 1:] @ _array(_matrix(side[rows][:, 1:]).inv())
    equations = fifth[others] - np.tensordot(share, fifth[rows], (1, 0))
    equations[:, 0, 0, 0] -= side[others][:, 0] - share @ side[rows][:, 0]
    for axis in (1, 2, 3):
        turned = np.tensordot(equations, _TO_TANGENT, (axis, 1))
        equations = np.moveaxis(turned, -1, axis)
    matrix = np.zeros((12, 3, 4, 3), dtype=object)
    matrix[:6, :, :3], matrix[6:, :, 1:] = equations, equations
    low, middle, high = np.moveaxis(matrix.reshape(12, 3, 12), 1, 0)
    return low, middle, high


def _independent_rows(side: Array) -> list[int]:
    """Eight rows on which the products of joints 6 and 1 are independent."""
    reduced, rank = _matrix(side[:, 1:].T).rref()
    if rank != 8:
        raise UnableError("exact postures", "the products of joints 6, 1 are dependent")
    return [next(j for j in range(14) if reduced[i, j] != 0) for i in range(8)]


def _interpolated(points: list[fmpq], values: list[list[fmpq]]) -> list[fmpq_poly]:
    """The polynomials of degree less than the number of points with these values."""
    size = len(points)
    powers = fmpq_mat(size, size, [t**k for t in points for k in range(size)])
    wide = fmpq_mat(size, len(values[0]), [x for row in values for x in row])
    solved = _array(powers.solve(wide))
    return [fmpq_poly(list(solved[:, j])) for j in range(solved.shape[1])]


def _matrix(array: Array) -> fmpq_mat:
    rows, columns = array.shape
    return fmpq_mat(rows, columns, list(array.ravel()))


def _array(matrix: fmpq_mat) -> Array:
    entries = np.array(matrix.entries(), dtype=object)
    return entries.reshape(matrix.nrows(), matrix.ncols())
