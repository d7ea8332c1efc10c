"""From a path on the reduced surface to a path of all joints, in floating point.

The first joint closes the path: its turn (or slide) brings the tip back to where it
began. For a six-joint arm with a spherical wrist the last three joints then bring the
hand back to its first orientation, on one side of the wrist's singularity.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import shortest_turn
from cuspaudit.cuspidality.surface_path import SurfacePath
from cuspaudit.errors import RetryableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames, jacobian

__all__ = [
    "close",
    "lift_position",
    "lift_wrist",
    "wrist_at",
    "wrist_middle",
    "wrist_spread",
]

Array = NDArray[np.float64]
_DIGITS = 12
_NEWTON = 25
_STARTS = 12
_REACHED = 1e-9
_SETTLED = 1e-13
_TURNS = (0.0, *(k * math.pi / 6 for k in range(1, 12)))


def lift_position(model: ExactModel, path: SurfacePath) -> Array:
    """The path of all three joints, (m, 3), whose ends hold the tip in one place.

    Args:
        model: the three-joint model the path was found for.
        path: way points of joints 2 and 3, in the model's variables.
    """
    zeros = model.zeros
    rest = path.points - np.array(zeros[1:])
    first = np.zeros(len(rest))
    joints = np.column_stack([first, rest])
    length = np.r_[0.0, np.cumsum(np.abs(np.diff(rest, axis=0)).max(axis=1))]
    joints[:, 0] = _closing(model.chain, joints) * length / (length[-1] or 1.0)
    return joints


def lift_wrist(
    chain: Chain, regional: Array, tilts: Sequence[float] = (0.0, 0.5, -0.5)
) -> Array:
    """The path of six joints over a path of the first three, (m + 1, 6).

    The wrist keeps still, as far from singular as it can, while the first three
    joints move; then it turns to the first orientation. A wrist that does not reach
    all orientations is tried at several turns of joint 4.

    Raises:
        RetryableError: the wanted orientation is too near the wrist's singularity.
    """
    middle = wrist_middle(chain, regional[0])
    for turn in _TURNS:
        starts = [np.array([turn, middle + tilt, 0.0]) for tilt in tilts]
        lifted = (_lifted_wrist(chain, regional, start, middle) for start in starts)
        found = [pair for pair in lifted if pair is not None]
        if found:
            return max(found, key=lambda pair: pair[0])[1]
    raise RetryableError("the wrist cannot bring the hand back away from singular")


def _lifted_wrist(
    chain: Chain, regional: Array, start: Array, middle: float
) -> tuple[float, Array] | None:
    """The smaller wrist spread of the ends and the path with the wrist at ``start``."""
    first = np.r_[regional[0], start]
    wrist = wrist_at(chain, first, regional[-1], middle)
    if wrist is None:
        return None
    last = np.r_[regional[-1], wrist]
    spread = min(wrist_spread(p, middle) for p in (first, last))
    still = np.tile(start, (len(regional), 1))
    return spread, np.vstack([np.column_stack([regional, still]), last])


def close(chain: Chain, path: Array) -> Array:
    """The path with its first way point rounded and its last one moved to its pose.

    The first way point becomes a decimal of 12 digits, exact by definition; the last
    is corrected by Newton's method until it reaches the same pose to rounding.

    Raises:
        RetryableError: Newton's method does not settle.
    """
    path = np.round(path, _DIGITS)
    target = frames(chain, path[0])[-1]
    posture = path[-1].copy()
    best, smallest = posture, math.inf
    scale = 1.0 + float(np.abs(target[:3, 3]).max())
    for _ in range(_NEWTON):
        error = _pose_error(chain, posture, target)
        size = float(np.abs(error).max())
        if size >= smallest and smallest < _SETTLED * scale:
            break
        if size < smallest:
            best, smallest = posture.copy(), size
        step = np.linalg.lstsq(jacobian(chain, posture), error, rcond=None)[0]
        posture = posture + step
    if not smallest < _REACHED * scale:
        raise RetryableError("the second posture does not reach the pose of the first")
    return np.vstack([path[:-1], best])


def _closing(chain: Chain, joints: Array) -> float:
    """How far joint 1 must go for the last posture to reach the first tip position."""
    frame = frames(chain, joints[0])[0]
    axis = frame[:3, :3] @ np.array([float(x) for x in chain.joints[0].axis])
    axis = axis / np.linalg.norm(axis)
    here, there = (
        frames(chain, posture)[-1, :3, 3] - frame[:3, 3]
        for posture in (joints[-1], joints[0])
    )
    if chain.joints[0].kind == "prismatic":
        return float(axis @ (there - here))
    across = np.cross(axis, here)
    return math.atan2(float(there @ across), float(here @ there - (axis @ here) ** 2))


def wrist_middle(chain: Chain, regional: Array) -> float:
    """The fifth joint value at which a spherical wrist is farthest from singular.

    The triple product of axes 4, 5, 6 is a multiple of cos(theta5 - middle).
    """
    a, b = (
        float(np.linalg.det(_axes(chain, np.r_[regional, 0.0, angle, 0.0])[3:]))
        for angle in (0.0, math.pi / 2)
    )
    return math.atan2(b, a)


def wrist_spread(posture: Array, middle: float) -> float:
    """The sine between axes 4 and 6, positive on the side of ``middle``."""
    return math.cos(float(posture[4]) - middle)


def _pose_error(chain: Chain, posture: Array, target: Array) -> Array:
    placed = frames(chain, posture)[-1]
    error = target[:3, 3] - placed[:3, 3]
    if chain.task == "position":
        return np.asarray(error)
    return np.concatenate([error, _turn_between(placed, target)])


def _turn_between(placed: Array, target: Array) -> Array:
    """The axis of the rotation from one orientation to another, times its sine."""
    turn = target[:3, :3] @ placed[:3, :3].T
    skew = turn - turn.T
    return np.array([skew[2, 1], skew[0, 2], skew[1, 0]]) / 2


def _axes(chain: Chain, posture: Array) -> Array:
    """The unit axes of the joints in base coordinates, (n, 3)."""
    placed = frames(chain, posture)
    axes: list[Array] = [
        frame[:3, :3] @ np.array([float(x) for x in joint.axis])
        for joint, frame in zip(chain.joints, placed, strict=False)
    ]
    return np.array([axis / np.linalg.norm(axis) for axis in axes], dtype=np.float64)


def wrist_at(
    chain: Chain, first: Array, regional: Array, middle: float
) -> Array | None:
    """The wrist that gives ``first``'s orientation at ``regional``, near ``middle``."""
    target = frames(chain, first)[-1]
    center = np.array([0.0, middle, 0.0])
    rng = np.random.default_rng(0)
    for _ in range(_STARTS):
        wrist = center + rng.uniform(-1, 1, 3) * (3.0, 1.0, 3.0)
        for _ in range(_NEWTON):
            posture = np.r_[regional, wrist]
            error = _turn_between(frames(chain, posture)[-1], target)
            columns = _axes(chain, posture)[3:].T
            wrist = wrist + np.linalg.lstsq(columns, error, rcond=None)[0]
        wrist = center + shortest_turn(wrist - center)
        placed = frames(chain, np.r_[regional, wrist])[-1]
        reached = np.abs(placed[:3, :3] - target[:3, :3]).max() < _REACHED
        if reached and wrist_spread(np.r_[regional, wrist], middle) > 0:
            return np.asarray(wrist)
    return None
