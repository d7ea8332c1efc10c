"""Turns of joints by (c, s) in any arithmetic, and the turn that closes the loop.

Numbers may be rationals, complex balls, or polynomials modulo another one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from flint import fmpq_poly
from numpy.typing import NDArray

from cuspaudit.kinematics.postures.arm import ArmArrays, rigid_inverse, turned

__all__ = ["arm_at", "closing_turn", "cos_sin", "elements_at", "turn"]

Array = NDArray[Any]
Pair = tuple[Any, Any]


def turn(arm: ArmArrays, k: int, c: Any, s: Any) -> Array:
    """The motion of joint k, counted from 0, by the angle of cosine c and sine s."""
    entries = np.empty(2, dtype=object)
    entries[:] = c, s
    return np.asarray(turned(arm.axes[k], entries[:1], entries[1:])[0])


def cos_sin(tangent: Any) -> Pair:
    """Cosine and sine of twice the angle with this tangent."""
    below = 1 / (1 + tangent * tangent)
    return (1 - tangent * tangent) * below, 2 * tangent * below


def elements_at(array: Array, surd: Any) -> Array:
    """Elements of K with a value for sqrt m; as they are over Q, where it is None."""
    if surd is None:
        return array
    result = np.empty(array.size, dtype=object)
    for k, entry in enumerate(array.ravel()):
        a = fmpq_poly([1]) * entry
        result[k] = surd * a[1] + a[0]
    return result.reshape(array.shape)


def arm_at(arm: ArmArrays, surd: Any) -> ArmArrays:
    """The arm with a value for sqrt m."""
    return ArmArrays(
        [elements_at(step, surd) for step in arm.before],
        [elements_at(axis, surd) for axis in arm.axes],
        elements_at(arm.tool, surd),
        arm.half,
    )


def closing_turn(arm: ArmArrays, pose: Array, pairs: Mapping[int, Pair]) -> Pair:
    """(c, s) of joint 5 when the others have (c, s) ``pairs`` and the loop closes.

    Args:
        arm: its numbers, and those of the pose, are of the kind of ``pairs``.
        pose: (4, 4).
        pairs: of joints 1, 2, 3, 4, 6, by their number.
    """
    ahead = np.eye(4, dtype=object)
    for k in range(4):
        ahead = ahead @ arm.before[k] @ turn(arm, k, *pairs[k + 1])
    back = arm.before[5] @ turn(arm, 5, *pairs[6]) @ arm.tool
    r = rigid_inverse(ahead @ arm.before[4]) @ pose @ rigid_inverse(back)
    # of a rotation about the axis: trace 1 + 2 c, skew part s [axis]_x
    skew = [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]
    s = sum(x * a for x, a in zip(skew, arm.axes[4], strict=True)) / 2
    return (r[0, 0] + r[1, 1] + r[2, 2] - 1) / 2, s
