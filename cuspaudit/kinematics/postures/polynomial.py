"""The resultant of Raghavan and Roth, exact, and the null vectors at its roots.

In half-angle tangents t_i = tan(theta_i / 2) the matrix of `raghavan_roth` is a 12x12
matrix M(t_2), quadratic in t_2, with M(t_2) v = 0 for v = (t_3^a t_4^b), 0 <= a <= 3,
0 <= b <= 2, at every posture with finite t_2, t_3, t_4. So det M vanishes there. The
adjugate of a singular matrix is 0 when its null space is no line, and has that line
for its columns otherwise.

Over K = Q(sqrt m) the 24x24 matrix of M over Q (`algebra.quadratic_matrix`) takes its
place. Over C it is M and its conjugate side by side, (sqrt m, 1) and (-sqrt m, 1) being
the eigenvectors of sqrt m: its determinant D is the norm of det M, and at a root of
det M the null vector is v times (sqrt m, 1). So the ratio of the two entries that
belong to one entry of v is sqrt m at a root of det M, -sqrt m at one of the conjugate.
There D is a polynomial in u = t_2 - sqrt m, because a rational posture belongs to the
conjugate arm as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mat, fmpq_poly
from numpy.typing import NDArray

from cuspaudit.algebra.quadratic_matrix import QuadraticField
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.postures.arm import ArmArrays
from cuspaudit.kinematics.postures.raghavan_roth import closed, fifth_axis, first_side

__all__ = ["PosturePolynomial", "posture_polynomial"]

Array = NDArray[Any]

_SIZE = 12
_TO_TANGENT = np.array([[1, 1, 0], [0, 0, 2], [1, -1, 0]], dtype=object)
"""Coefficients of (1, c, s) to those of 1, t, t^2 over 1 + t^2."""


@dataclass(frozen=True, eq=False)
class PosturePolynomial:
    """D = det M, or its norm, and one column of the adjugate.

    Attributes:
        determinant: D, in u = t_2, or t_2 - sqrt m; not 0.
        full: the degree of D when no posture has t_2 infinite.
        circle: 1 + t_2^2, or its norm, in u.
        null: (12, d) polynomials in u, d the degree of K, row 3 a + b for t_3^a t_4^b.
        fifth: X of `raghavan_roth`, (14, 3, 3, 3).
        side: Y of `raghavan_roth`, (14, 9).
        outer: (4, 15), gives (c_1, s_1, c_6, s_6) of a posture from 1 and the 14
            numbers of X.
    """

    determinant: fmpq_poly
    full: int
    circle: fmpq_poly
    null: Array
    fifth: Array
    side: Array
    outer: Array


def posture_polynomial(
    field: QuadraticField, arm: ArmArrays, pose: Array, seed: int
) -> PosturePolynomial:
    """D and the null vectors of ``arm`` at ``pose``.

    Args:
        field: K.
        arm: entries in K.
        pose: (4, 4), in K.
        seed: of the combination of columns.

    Raises:
        UnableError: D vanishes identically, or joints 6 and 1 do not drop out.
    """
    fifth = field.reduced(fifth_axis(arm))
    side = field.reduced(first_side(arm, field.reduced(closed(arm, pose))))
    side = side.reshape(14, 9)
    rows = _independent_rows(field, side)
    inverse = field.array(field.matrix(side[rows][:, 1:]).inv())
    pencil = map(field.matrix, _pencil(field, fifth, side, rows, inverse))
    low, middle, high = _slanted(field, *pencil)
    size = _SIZE * field.degree
    rng = np.random.default_rng(seed)
    column = fmpq_mat(size, 1, [int(x) for x in rng.integers(1, 1000, size)])
    points, values = [], []
    for k in range(6 * size):
        t = fmpq(k // 2 + 1) * (-1 if k % 2 else 1)
        matrix = low + middle * t + high * (t * t)
        determinant = matrix.det()
        if determinant == 0:
            continue
        points.append(t)
        vector = (matrix.solve(column) * determinant).entries()
        values.append([determinant, *vector])
        if len(points) == 2 * size + 1:
            break
    else:
        raise UnableError("exact postures", "the resultant vanishes identically")
    resultant, *null = _interpolated(points, values)
    shape = np.empty(size, dtype=object)
    shape[:] = null
    outer = _outer(side, rows, inverse)
    null_vectors = shape.reshape(_SIZE, field.degree)
    return PosturePolynomial(
        resultant,
        2 * size,
        _circle(field),
        null_vectors,
        fifth,
        side,
        field.reduced(outer),
    )


def _circle(field: QuadraticField) -> fmpq_poly:
    """1 + t_2^2, or its norm (1 + m + u^2)^2 - 4 m u^2."""
    m = field.radicand
    if m is None:
        return fmpq_poly([1, 0, 1])
    return fmpq_poly([1 + m, 0, 1]) ** 2 - fmpq_poly([0, 0, 4 * m])


def _slanted(
    field: QuadraticField, low: fmpq_mat, middle: fmpq_mat, high: fmpq_mat
) -> tuple[fmpq_mat, fmpq_mat, fmpq_mat]:
    """The coefficients of 1, u, u^2 from those of 1, t_2, t_2^2."""
    if field.radicand is None:
        return low, middle, high
    times_surd = field.surd_matrix(_SIZE)
    low = low + times_surd * (middle + times_surd * high)
    return low, middle + times_surd * high * 2, high


def _outer(side: Array, rows: list[int], inverse: Array) -> Array:
    """(c_1, s_1, c_6, s_6) from (1, X): products 1, 2, 3, 6 of joints 6 and 1."""
    chosen = inverse[[0, 1, 2, 5]]
    result = np.full((4, 15), 0, dtype=object)
    result[:, 0] = -(chosen @ side[rows][:, 0])
    result[:, [1 + row for row in rows]] = chosen
    return result


def _pencil(
    field: QuadraticField, fifth: Array, side: Array, rows: list[int], inverse: Array
) -> tuple[Array, Array, Array]:
    """The (12, 12) coefficients of 1, t_2, t_2^2 in M."""
    others = [k for k in range(14) if k not in rows]
    share = field.reduced(side[others][:, 1:] @ inverse)
    equations = fifth[others] - np.tensordot(share, fifth[rows], (1, 0))
    equations[:, 0, 0, 0] -= side[others][:, 0] - share @ side[rows][:, 0]
    for axis in (1, 2, 3):
        turned = np.tensordot(equations, _TO_TANGENT, (axis, 1))
        equations = np.moveaxis(turned, -1, axis)
    equations = field.reduced(equations)
    matrix = np.full((12, 3, 4, 3), 0, dtype=object)
    matrix[:6, :, :3], matrix[6:, :, 1:] = equations, equations
    low, middle, high = np.moveaxis(matrix.reshape(12, 3, 12), 1, 0)
    return low, middle, high


def _independent_rows(field: QuadraticField, side: Array) -> list[int]:
    """Eight rows on which the products of joints 6 and 1 are independent."""
    d = field.degree
    reduced, rank = field.matrix(side[:, 1:].T).rref()
    if rank != 8 * d:
        raise UnableError("exact postures", "the products of joints 6, 1 are dependent")
    pivots = (
        next(j for j in range(14 * d) if reduced[i, j] != 0) for i in range(0, 8 * d, d)
    )
    return [j // d for j in pivots]


def _interpolated(points: list[fmpq], values: list[list[fmpq]]) -> list[fmpq_poly]:
    """The polynomials of degree less than the number of points with these values."""
    size = len(points)
    powers = fmpq_mat(size, size, [t**k for t in points for k in range(size)])
    wide = fmpq_mat(size, len(values[0]), [x for row in values for x in row])
    solved = np.array(powers.solve(wide).entries(), dtype=object).reshape(size, -1)
    return [fmpq_poly(list(solved[:, j])) for j in range(solved.shape[1])]
