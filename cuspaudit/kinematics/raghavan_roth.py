"""Elimination in the closed loop of a six-joint arm, down to one joint [Raghavan-Roth].

With the tip held at a pose T the arm is a loop of six revolute joints. It is cut so
that the link from joint 6 to joint 1, which holds the pose, belongs to two joints that
drop out linearly; numbered along the loop from joint 6, the joints are 6, 1, 2, 3, 4, 5
and the loop closes when

    X(theta2, theta3, theta4) = Y(theta6, theta1)

as motions that carry the line of axis 5: its point p and its direction l. The 14
numbers p, l, p.p, p.l, p x l, (p.p) l - 2 (p.l) p are trilinear in (1, c, s) of joints
2, 3, 4 on the left side and bilinear in those of 6 and 1 on the right side. Linear
combinations that cancel the eight nonconstant products of 6 and 1 leave equations
trilinear in joints 2, 3, 4; multiplied by 1 and by z_3 = e^(i theta_3) they are linear
in the twelve products z_3^a z_4^b, 0 <= a <= 3, 0 <= b <= 2, with coefficients in
1/z_2, 1, z_2. So at a posture the matrix M(z_2) of twelve of them is singular.

Numbers may be of any type that numpy can add and multiply: doubles, or exact ones in
arrays of objects. Every function takes a stack of arms or poses in leading axes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Arm",
    "closed",
    "fifth_axis",
    "first_side",
    "reversed_arm",
    "rigid_inverse",
    "turned",
]

Array = NDArray[Any]

NODES = ((1, 0), (0, 1), (-1, 0))
"""(cos, sin) at 0, 90 and 180 degrees: they determine a + b cos + c sin."""
_CROSS = np.array(
    [
        [[0, 0, 0], [0, 0, -1], [0, 1, 0]],
        [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
        [[0, -1, 0], [1, 0, 0], [0, 0, 0]],
    ]
)
"""[axis]_x is the sum of these matrices, axis the coefficients."""


@dataclass(frozen=True, eq=False)
class Arm:
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


def closed(arm: Arm, pose: Array) -> Array:
    """The link from joint 6 round to joint 1 when the tip is held at ``pose``."""
    return arm.tool @ rigid_inverse(pose) @ arm.before[0]


def reversed_arm(arm: Arm) -> Arm:
    """The arm from tip to base, whose pose is the inverse.

    Its joint k is joint 7 - k of ``arm``, with the same angle.
    """
    tool, *before = (rigid_inverse(step) for step in (*arm.before, arm.tool))
    axes = [-axis for axis in reversed(arm.axes)]
    return Arm(before[::-1], axes, tool, arm.half)


def fifth_axis(arm: Arm) -> Array:
    """X: the 14 numbers as coefficients, (14, 3, 3, 3) in (1, c, s) of joints 2, 3, 4.

    It depends on the arm alone.
    """
    second, third, fourth = (_at_nodes(arm.axes[k]) for k in (1, 2, 3))
    reach = fourth @ arm.before[4]
    reach = third[:, None] @ (arm.before[3] @ reach)
    reach = second[:, None, None] @ (arm.before[2] @ reach)
    return _coefficients(arm, _numbers(reach, arm.axes[4]), 3)


def first_side(arm: Arm, link: Array) -> Array:
    """Y: the 14 numbers as coefficients, (..., 14, 3, 3) in (1, c, s) of joints 6, 1.

    Args:
        arm: its joints 5 and 6 and link 1-2 are used.
        link: from `closed`, (..., 4, 4).
    """
    sixth, first = _at_nodes(arm.axes[5]), _at_nodes(arm.axes[0])
    ahead = arm.before[5] @ sixth
    step = ahead[:, None] @ link[..., None, None, :, :] @ first @ arm.before[1]
    return _coefficients(arm, _numbers(rigid_inverse(step), arm.axes[4]), 2)


def _at_nodes(axis: Array) -> Array:
    c, s = np.array(NODES).T
    return turned(axis, c, s)


def _numbers(motion: Array, axis: Array) -> Array:
    """The 14 numbers of the line of ``axis`` through the origin, moved: (..., 14)."""
    p, l = motion[..., :3, 3], motion[..., :3, :3] @ axis  # noqa: E741 - the paper's
    square = (p * p).sum(-1, keepdims=True)
    along = (p * l).sum(-1, keepdims=True)
    moment = np.roll(p, -1, -1) * np.roll(l, -2, -1)
    moment = moment - np.roll(p, -2, -1) * np.roll(l, -1, -1)
    inverted = square * l - 2 * along * p
    return np.concatenate([p, l, square, along, moment, inverted], axis=-1)


def _coefficients(arm: Arm, values: Array, joints: int) -> Array:
    """Values at the nodes, (..., 3, ..., 3, 14), to coefficients, (..., 14, 3, ...)."""
    for axis in range(-1 - joints, -1):
        first, middle, last = (np.take(values, k, axis) for k in range(3))
        mean, cosine = (first + last) * arm.half, (first - last) * arm.half
        values = np.stack([mean, cosine, middle - mean], axis)
    return np.moveaxis(values, -1, -1 - joints)
