"""A six-joint revolute arm as arrays, and the motions it is made of.

Numbers may be of any type that numpy can add and multiply: doubles, or exact ones in
arrays of objects.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["ArmArrays", "Array", "reversed_arm", "rigid_inverse", "turned"]

Array = NDArray[Any]

_CROSS = np.array(
    [
        [[0, 0, 0], [0, 0, -1], [0, 1, 0]],
        [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
        [[0, -1, 0], [1, 0, 0], [0, 0, 0]],
    ]
)
"""[axis]_x is the sum of these matrices, axis the coefficients."""


@dataclass(frozen=True, eq=False)
class ArmArrays:
    """A six-joint revolute arm as arrays.

    Attributes:
        before: six (4, 4) fixed transforms, each before its joint.
        axes: six unit vectors (3,), each in its joint's frame.
        tool: (4, 4) fixed transform after joint 6.
        half: one half, in the arithmetic of the entries.
    """

    before: Sequence[Array]
    axes: Sequence[Array]
    tool: Array
    half: Any = 0.5


def turned(axis: Array, c: Array, s: Array) -> Array:
    """The rotation about a unit ``axis`` by angles of cosine c and sine s, (..., 4, 4).

    Rodrigues: c 1 + (1 - c) axis axis^T + s [axis]_x.
    """
    c, s = np.asarray(c)[..., None, None], np.asarray(s)[..., None, None]
    beside = np.tensordot(axis, _CROSS, 1)
    along = np.multiply.outer(axis, axis)
    one = np.eye(3, dtype=int)
    result = np.zeros((*c.shape[:-2], 4, 4), dtype=np.result_type(along, c))
    result[..., :3, :3] = c * one + (1 - c) * along + s * beside
    result[..., 3, 3] = 1
    return result


def rigid_inverse(motion: Array) -> Array:
    """The inverse of rigid motions (..., 4, 4)."""
    result = np.zeros_like(motion)
    back = np.swapaxes(motion[..., :3, :3], -1, -2)
    result[..., :3, :3] = back
    result[..., :3, 3] = -(back @ motion[..., :3, 3, None])[..., 0]
    result[..., 3, 3] = 1
    return result


def reversed_arm(arm: ArmArrays) -> ArmArrays:
    """The arm from tip to base, whose pose is the inverse.

    Its joint k is joint 7 - k of ``arm``, with the same angle.
    """
    tool, *before = (rigid_inverse(step) for step in (*arm.before, arm.tool))
    axes = [-axis for axis in reversed(arm.axes)]
    return ArmArrays(before[::-1], axes, tool, arm.half)
