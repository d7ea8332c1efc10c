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

import numpy as np

from cuspaudit.kinematics.postures.arm import ArmArrays, Array, rigid_inverse, turned

__all__ = ["closed", "fifth_axis", "first_side"]

NODES = ((1, 0), (0, 1), (-1, 0))
"""(cos, sin) at 0, 90 and 180 degrees: they determine a + b cos + c sin."""


def closed(arm: ArmArrays, pose: Array) -> Array:
    """The link from joint 6 round to joint 1 when the tip is held at ``pose``."""
    return arm.tool @ rigid_inverse(pose) @ arm.before[0]


def fifth_axis(arm: ArmArrays) -> Array:
    """X: the 14 numbers as coefficients, (14, 3, 3, 3) in (1, c, s) of joints 2, 3, 4.

    It depends on the arm alone.
    """
    second, third, fourth = (_at_nodes(arm.axes[k]) for k in (1, 2, 3))
    reach = fourth @ arm.before[4]
    reach = third[:, None] @ (arm.before[3] @ reach)
    reach = second[:, None, None] @ (arm.before[2] @ reach)
    return _coefficients(arm, _numbers(reach, arm.axes[4]), 3)


def first_side(arm: ArmArrays, link: Array) -> Array:
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


def _coefficients(arm: ArmArrays, values: Array, joints: int) -> Array:
    """Values at the nodes, (..., 3, ..., 3, 14), to coefficients, (..., 14, 3, ...)."""
    for axis in range(-1 - joints, -1):
        first, middle, last = (np.take(values, k, axis) for k in range(3))
        mean, cosine = (first + last) * arm.half, (first - last) * arm.half
        values = np.stack([mean, cosine, middle - mean], axis)
    return np.moveaxis(values, -1, -1 - joints)
