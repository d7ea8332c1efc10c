"""Whether given angles close the loop of a six-joint arm, exactly.

The loop is T_1 ... T_6 tool = pose, T_k the step before joint k and its turn R_k. Cut
in halves, R_1 T_2 T_3 B_4 = B_1^-1 pose tool^-1 R_6^-1 B_6^-1 R_5^-1 B_5^-1 R_4^-1, B_k
the steps: three turns and three constants on each side, so that with (c, s) over one
common denominator both sides have the same one.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import Any

import numpy as np
from flint import fmpq_poly
from numpy.typing import NDArray

from cuspaudit.algebra.quadratic_matrix import QuadraticField
from cuspaudit.kinematics.postures.arm import ArmArrays, rigid_inverse, turned
from cuspaudit.kinematics.postures.raghavan_roth import NODES

__all__ = ["closes"]

Array = NDArray[Any]


def closes(
    field: QuadraticField,
    arm: ArmArrays,
    pose: Array,
    omega: fmpq_poly,
    rho: Sequence[fmpq_poly],
) -> bool:
    """Whether every root of omega is a posture.

    Args:
        field: K.
        arm: entries in K.
        pose: (4, 4), in K.
        omega: monic, square-free.
        rho: c_1, s_1, ..., c_6, s_6 are rho_i / omega' at the roots; over Q(sqrt m)
            sqrt m is too, with one more rho.
    """
    below = omega.derivative()
    surd = None
    angles = list(zip(rho[0:12:2], rho[1:12:2], strict=True))
    squares = [c * c + s * s - below * below for c, s in angles]
    if field.radicand is not None:
        surd = rho[12]
        squares.append(surd * surd - below * below * field.radicand)
    if any(square % omega != 0 for square in squares):
        return False

    def constant(motion: Array) -> Array:
        return _over(field.reduced(motion), below, surd)

    def turn(k: int, sense: int) -> Array:
        c, s = angles[k]
        parts = map(constant, _turn_parts(arm.axes[k], arm.half))
        weights = map(_scalar, (below, c, sense * s))
        return np.asarray(sum(p * w for p, w in zip(parts, weights, strict=True)))

    steps = arm.before
    middle = rigid_inverse(steps[0]) @ pose @ rigid_inverse(arm.tool)
    left = [turn(0, 1), constant(steps[1]), turn(1, 1), constant(steps[2])]
    left += [turn(2, 1), constant(steps[3])]
    right = [constant(middle), turn(5, -1), constant(rigid_inverse(steps[5]))]
    right += [turn(4, -1), constant(rigid_inverse(steps[4])), turn(3, -1)]
    gap = reduce(np.matmul, left) - reduce(np.matmul, right)
    return all(fmpq_poly([1]) * entry % omega == 0 for entry in gap.ravel())


def _turn_parts(axis: Array, half: Any) -> tuple[Array, Array, Array]:
    """The coefficients of 1, c, s in a turn about ``axis``."""
    c, s = np.array(NODES, dtype=object).T
    start, quarter, opposite = turned(axis, c, s)
    fixed = (start + opposite) * half
    return fixed, start - fixed, quarter - fixed


def _over(array: Array, below: fmpq_poly, surd: fmpq_poly | None) -> Array:
    """Elements a + b sqrt m as a omega' + b rho; as they are over Q."""
    if surd is None:
        return array
    result = np.empty(array.size, dtype=object)
    for k, entry in enumerate(array.ravel()):
        a = fmpq_poly([1]) * entry
        result[k] = a[0] * below + a[1] * surd
    return result.reshape(array.shape)


def _scalar(polynomial: fmpq_poly) -> Array:
    """An array that numpy does not take for a list of coefficients."""
    result = np.empty((), dtype=object)
    result[()] = polynomial
    return result
