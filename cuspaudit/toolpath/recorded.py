"""A recorded motion against the runs of the tool path that it makes.

A path of joint vectors is itself a motion. It follows one of the runs as long as its
vectors are the run's at the waypoints, up to whole turns; where they are another
posture of the same pose, the motion has jumped, or passed a singularity.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.toolpath.traced_path import Run, TracedPath

__all__ = ["Recorded", "recorded_motion"]

Array = NDArray[np.float64]

_SAME = 1e-4


@dataclass(frozen=True)
class Recorded:
    """What a recorded motion does.

    Attributes:
        run: the number of the run it begins in, or None.
        leaves_after: the last waypoint, from 0, at which it still is in that run; None
            where it follows it to the end.
    """

    run: int | None
    leaves_after: int | None


def recorded_motion(trace: TracedPath) -> Recorded | None:
    """The run that the joint vectors of the path follow; None if it has none."""
    joints = trace.path.joints
    if joints is None:
        return None
    for number, run in enumerate(trace.runs):
        if not _is_same(trace, np.array(joints[0]), np.array(run.start)):
            continue
        for k, vector in enumerate(joints):
            own = _at_waypoint(trace, run, k)
            if own is None or not _is_same(trace, np.array(vector), own):
                return Recorded(number, max(0, k - 1))
        return Recorded(number, None)
    return Recorded(None, None)


def _at_waypoint(trace: TracedPath, run: Run, k: int) -> Array | None:
    """The joint values of a run at a waypoint; None where it has ended."""
    if run.free is None or k > run.at:
        return None
    rows = run.free.points
    at = int(np.argmin(np.abs(rows[:, -1] - k)))
    if rows[at, -1] != k:
        return None
    n = trace.arm.joints
    return np.asarray(rows[at, :n] * trace.arm.scales[:n])


def _is_same(trace: TracedPath, a: Array, b: Array) -> bool:
    turning = trace.arm.turning[: trace.arm.joints]
    gap = np.where(turning, 2 * np.sin((a - b) / 2), a - b)
    return bool(np.abs(gap).max() < _SAME)
