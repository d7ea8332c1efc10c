"""Waypoints out of reach: which, and by how much.

That a waypoint has no posture is proved where the exact solver is complete. How far it
is from the nearest place that the tip can take is searched by least squares.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from flint import ctx
from numpy.typing import NDArray

from cuspaudit.toolpath.ball_arm import BITS
from cuspaudit.toolpath.following.starts import solve_pose
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.traced_path import TracedPath
from cuspaudit.toolpath.waypoints import Pose

__all__ = ["Unreachable", "first_unreachable", "out_of_reach"]

Array = NDArray[np.float64]

_STARTS, _STEPS = 16, 60
_CHECKED = 3
_MISSED = 1e-6


@dataclass(frozen=True)
class Unreachable:
    """A waypoint without a posture.

    Attributes:
        waypoint: its number, from 0.
        proved: whether it is proved to have none.
        distance: from there to the nearest place found of the tip, in the chain's unit;
            0 where only the orientation cannot be had.
        turn: by how much the orientation is missed at the right place, rad; None where
            the place is out of reach, or the task asks for no orientation.
    """

    waypoint: int
    proved: bool
    distance: float
    turn: float | None


def first_unreachable(trace: TracedPath) -> Unreachable | None:
    """The first waypoint without a posture, looked for where no run is alive."""
    free = [run.free for run in trace.runs if run.free is not None]
    alive = max((run.end.high for run in free), default=-1.0)
    poses, checked = trace.path.poses, 0
    for number, pose in enumerate(poses):
        if number <= alive and free:
            continue
        with ctx.workprec(BITS):
            solved = solve_pose(trace.arm, pose)
            if not (solved.postures or solved.whole_curves):
                distance, turn = out_of_reach(trace.arm, pose)
                if solved.complete or distance or (turn or 0.0) > _MISSED:
                    return Unreachable(number, solved.complete, distance, turn)
        checked += 1
        if checked == _CHECKED:
            break
    return None


def out_of_reach(
    arm: TracedArm, pose: Pose, seed: int = 0
) -> tuple[float, float | None]:
    """(distance, turn) of `Unreachable`, searched from random postures."""
    system = arm.system(pose, pose)
    rng = np.random.default_rng(seed)
    starts = rng.uniform(-np.pi, np.pi, (_STARTS, len(arm.turning)))

    def misses(values: Array, rows: slice) -> tuple[Array, Array]:
        value, slope = system.plain(np.append(values, 0.0))
        return value[rows], slope[rows, :-1]

    place = min(_least(misses, start, slice(0, 3)) for start in starts)
    if place > 1e-6 * arm.balls.reach:
        return place, None
    if arm.task == "position":
        return 0.0, None
    whole = min(_least(misses, start, slice(None)) for start in starts)
    return 0.0, float(np.arcsin(min(1.0, whole)))


def _least(misses: object, values: Array, rows: slice) -> float:
    """The length of what is left, by damped Gauss-Newton steps."""
    assert callable(misses)
    damping = 1e-2
    value, slope = misses(values, rows)
    for _ in range(_STEPS):
        square = slope.T @ slope + damping * np.eye(slope.shape[1])
        moved = values - np.linalg.solve(square, slope.T @ value)
        after, bent = misses(moved, rows)
        if after @ after < value @ value:
            values, value, slope, damping = moved, after, bent, damping / 3
        else:
            damping *= 4
        if damping > 1e8:
            break
    return float(np.sqrt(value @ value))
