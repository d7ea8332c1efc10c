"""Forward kinematics of a chain in floating point, for searching and drawing.

Nothing decided here reaches a verdict: a search uses these frames to look for a path,
and the path is then proved in ball arithmetic by `cuspaudit.certificate`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Angle, Chain, Motion, Translation, Vector
from cuspaudit.robot.virtual_joint import TOOL_AXES

__all__ = ["angle_value", "frames", "jacobian", "transform"]

Matrix = NDArray[np.float64]


def angle_value(angle: Angle) -> float:
    """The angle in rad, correct to a few units in the last place."""
    return float(angle.half_turns) * math.pi + float(angle.radians)


def transform(motions: Sequence[Motion]) -> Matrix:
    """The product of ``motions``, left to right, as a (4, 4) homogeneous matrix."""
    result = np.eye(4)
    for motion in motions:
        if isinstance(motion, Translation):
            result = result @ _translation(_floats(motion.vector))
        else:
            result = result @ _rotation(motion.axis, angle_value(motion.angle))
    return result


def frames(chain: Chain, posture: Sequence[float] | Matrix) -> Matrix:
    """The frames of the joints, moved, and of the tip at ``posture``.

    Args:
        chain: a chain of n joints.
        posture: (n,) joint values, rad or the chain's unit.

    Returns:
        (n + 1, 4, 4): frame i is that of joint i after its motion, in base
        coordinates, its origin on the joint's axis; the last one is the tip.
    """
    result = []
    current = np.eye(4)
    for joint, value in zip(chain.joints, posture, strict=True):
        current = current @ _fixed(joint.before)
        if joint.kind == "revolute":
            current = current @ _rotation(joint.axis, float(value))
        else:
            current = current @ _translation(_unit(joint.axis) * float(value))
        result.append(current)
    result.append(current @ _fixed(chain.tool))
    return np.array(result)


def jacobian(chain: Chain, posture: Sequence[float] | Matrix) -> Matrix:
    """The geometric Jacobian at ``posture``, one row a dimension of the task.

    Rows are the linear velocity of the tip's origin, in base coordinates, then for a
    pose the angular velocity, for a tool axis its parts along the two other axes of the
    tip's frame, for an angle its part along the last axis that turns.
    """
    placed = frames(chain, posture)
    point = placed[-1, :3, 3]
    columns = []
    for joint, frame in zip(chain.joints, placed, strict=False):
        axis = frame[:3, :3] @ _unit(joint.axis)
        if joint.kind == "revolute":
            columns.append(np.r_[np.cross(axis, point - frame[:3, 3]), axis])
        else:
            columns.append(np.r_[axis, np.zeros(3)])
    full = np.array(columns).T
    if chain.task == "position":
        return full[:3]
    if chain.task == "position-and-angle":
        axis = full[3:, [kind == "revolute" for kind in chain.kinds]][:, -1]
        return np.vstack([full[:3], axis @ full[3:]])
    if chain.task in TOOL_AXES:
        x = TOOL_AXES[chain.task].index(1)
        others = placed[-1][:3, [(x + 1) % 3, (x + 2) % 3]]
        return np.vstack([full[:3], others.T @ full[3:]])
    return full


@lru_cache(maxsize=512)
def _fixed(motions: tuple[Motion, ...]) -> Matrix:
    return transform(motions)


def _floats(vector: Vector) -> Matrix:
    return np.array([float(x) for x in vector])


@lru_cache(maxsize=512)
def _unit(axis: Vector) -> Matrix:
    direction = _floats(axis)
    return np.asarray(direction / np.linalg.norm(direction), dtype=np.float64)


def _rotation(axis: Vector, angle: float) -> Matrix:
    x, y, z = _unit(axis)
    c, s = math.cos(angle), math.sin(angle)
    k = 1.0 - c
    return np.array(
        [
            [c + x * x * k, x * y * k - z * s, x * z * k + y * s, 0.0],
            [y * x * k + z * s, c + y * y * k, y * z * k - x * s, 0.0],
            [z * x * k - y * s, z * y * k + x * s, c + z * z * k, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def _translation(vector: Matrix) -> Matrix:
    result = np.eye(4)
    result[:3, 3] = vector
    return result
