"""Poses and Jacobians of many postures of a revolute chain at once, in doubles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cuspaudit.errors import UnableError
from cuspaudit.kinematics.postures.arm import ArmArrays, turned
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import transform

__all__ = ["gap", "moved", "scaled_arm"]

Array = NDArray[np.float64]


def scaled_arm(chain: Chain) -> tuple[ArmArrays, float]:
    """The arm in doubles, lengths divided by the longest, and that length.

    Raises:
        UnableError: a joint is prismatic.
    """
    if "prismatic" in chain.kinds:
        raise UnableError("postures", "only arms of revolute joints are moved")
    steps = [transform(joint.before) for joint in chain.joints]
    tool = transform(chain.tool)
    scale = max(float(np.abs(step[:3, 3]).max()) for step in [*steps, tool]) or 1.0
    for step in (*steps, tool):
        step[:3, 3] /= scale
    axes = [np.array([float(x) for x in joint.axis]) for joint in chain.joints]
    return ArmArrays(steps, [a / np.linalg.norm(a) for a in axes], tool), scale


def moved(arm: ArmArrays, postures: Array) -> tuple[Array, Array]:
    """Poses (..., 4, 4) and Jacobians (..., 6, n) at postures (..., n).

    Rows are the linear velocity of the tip's origin, then the angular velocity.
    """
    placed = np.eye(4)
    points, axes = [], []
    for k, axis in enumerate(arm.axes):
        c, s = np.cos(postures[..., k]), np.sin(postures[..., k])
        placed = placed @ arm.before[k] @ turned(axis, c, s)
        points.append(placed[..., :3, 3])
        axes.append(placed[..., :3, :3] @ axis)
    placed = placed @ arm.tool
    point, direction = np.stack(points, -2), np.stack(axes, -2)
    speed = np.cross(direction, placed[..., None, :3, 3] - point)
    return placed, np.swapaxes(np.concatenate([speed, direction], -1), -1, -2)


def gap(placed: Array, poses: Array) -> Array:
    """The motion still missing, (..., 6, 1): translation, then axis times sine."""
    turn = poses[..., :3, :3] @ np.swapaxes(placed[..., :3, :3], -1, -2)
    skew = (turn - np.swapaxes(turn, -1, -2)) / 2
    axis = np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], -1)
    step = np.concatenate([poses[..., :3, 3] - placed[..., :3, 3], axis], -1)
    return np.asarray(step[..., None])
