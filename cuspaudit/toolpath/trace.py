"""The trace of a tool path: what becomes of every posture of its first pose.

The strands of the path give its runs without limits (`strands`, `runs`). Within limits
a run ends where it first leaves them, in each winding of its own. On a closed path the
runs that reach the end permute the postures, up to whole turns.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
from flint import ctx

from cuspaudit.runtime.clock import time_is_up, time_limit
from cuspaudit.toolpath.ball_arm import BITS
from cuspaudit.toolpath.bounded_runs import bounded_runs
from cuspaudit.toolpath.conservation import check_conservation
from cuspaudit.toolpath.following.births import complete_runs
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.starts import Solved, solve_pose
from cuspaudit.toolpath.following.strands import (
    Followed,
    follow_path,
    known_postures,
    turns_between,
)
from cuspaudit.toolpath.known import Known, known_posture
from cuspaudit.toolpath.limits import JointInterval, joint_ranges
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.traced_path import Birth, Run, TracedPath
from cuspaudit.toolpath.waypoints import ToolPath

__all__ = ["trace_path"]


def trace_path(
    arm: TracedArm,
    path: ToolPath,
    limited: bool = True,
    seed: int = 0,
    progress: Callable[[str], None] = lambda step: None,
    timeout: float | None = None,
) -> TracedPath:
    """Follow a tool path from every posture of its first pose.

    Args:
        arm: an arm with a square task.
        path: with what the task needs.
        limited: whether the limits of the joints count.
        seed: of the exact solvers.
        progress: called with the name of each step.
        timeout: seconds after which no run is followed further: what is not known by
            then is undecided.

    Raises:
        UnableError: there are too many windings.
        CrossCheckError: two complete lists contradict each other.
    """
    with ctx.workprec(BITS), time_limit(timeout):
        progress("postures")
        legs = [arm.system(a, b) for a, b in pairwise(path.poses)]
        first = solve_pose(arm, path.poses[0], seed)
        last = first if path.is_closed else solve_pose(arm, path.poses[-1], seed)
        starts = _starts(arm, path, legs, first)
        ends = known_postures(arm, legs[-1], last, 1.0)
        progress("runs")
        found = follow_path(arm, legs, starts, ends, progress)
        progress("births")
        complete, remarks = complete_runs(arm, path, legs, first, last, found)
        if complete and not _all_met(found, starts, ends):
            complete = False
            remarks.append("a posture of the first or last pose could not be followed")
        if time_is_up():
            complete = False
            remarks.append("the time was up: what is not known by then is undecided")
        else:
            check_conservation(arm, first, last, found, starts, ends)
        progress("limits")
        ranges = _ranges(arm, limited)
        runs = bounded_runs(arm, legs, starts, found, ranges)
        sigma, turns = _permutation(arm, path, runs, ranges)
        return TracedPath(
            arm,
            path,
            limited,
            tuple(runs),
            tuple(_births(arm, found)),
            first,
            last,
            sigma,
            turns,
            complete,
            tuple(remarks),
        )


def _starts(
    arm: TracedArm, path: ToolPath, legs: Sequence[LegSystem], solved: Solved
) -> list[Known]:
    """The postures of the first pose; at least the one that the path came from."""
    known = known_postures(arm, legs[0], solved, 0.0)
    if path.joints is not None and not solved.complete:
        extra = len(arm.chain.joints) - arm.joints
        own = known_posture(arm, legs[0], [*path.joints[0], *[0.0] * extra], 0.0)
        met = any(turns_between(arm, own.values, k.values) is not None for k in known)
        if own.knot is not None and not met:
            known.append(own)
    return known


def _all_met(found: Followed, starts: Sequence[Known], ends: Sequence[Known]) -> bool:
    """Whether each posture of the two outer poses has its run, or is singular."""
    pairs = [
        *zip(starts, found.starts, strict=True),
        *zip(ends, found.ends, strict=True),
    ]
    return all(known.sign == 0 or run is not None for known, run in pairs)


def _ranges(arm: TracedArm, limited: bool) -> list[JointInterval | None]:
    if not limited:
        return [None] * len(arm.chain.joints)
    return joint_ranges(arm.chain.joints, arm.scales)


def _births(arm: TracedArm, found: Followed) -> list[Birth]:
    result = []
    for run in found.runs:
        if run.begin.kind == "path" and run.begin.at == 0.0:
            continue
        middle = run.knots(run.links[len(run.links) // 2])[1]
        determinant = arm.determinant(middle.balls()[:-1])
        sign = int(determinant > 0) - int(determinant < 0) or None
        first = (run.first.at[:-1] * arm.scales)[: arm.joints]
        end = "reached" if run.end.kind == "path" else run.end.kind
        result.append(Birth(run.begin.at, sign, end, run.end.at, tuple(first.tolist())))
    return sorted(result, key=lambda birth: birth.at)


def _permutation(
    arm: TracedArm,
    path: ToolPath,
    runs: Sequence[Run],
    ranges: Sequence[JointInterval | None],
) -> tuple[tuple[int | None, ...] | None, tuple[tuple[int, ...] | None, ...] | None]:
    """For each run of a closed path the run it ends in, and the turns left over.

    Of the runs in windings of the posture that it ends in, the one that differs by the
    fewest turns, so by none on limited joints if it is among them.
    """
    if not path.is_closed:
        return None, None
    sigma: list[int | None] = []
    left: list[tuple[int, ...] | None] = []
    for run in runs:
        best: tuple[int, int] | None = None
        turns: tuple[int, ...] | None = None
        if run.end == "reached" and run.ends_in is not None:
            for k, other in enumerate(runs):
                if other.posture != run.ends_in or other.inside != run.inside:
                    continue
                gap = (np.array(run.last) - np.array(other.start)) / (2 * np.pi)
                whole = np.where(arm.turning[: arm.joints], np.round(gap), 0)
                size = int(np.abs(whole).sum())
                if best is None or size < best[0]:
                    best, turns = (size, k), tuple(int(x) for x in whole)
        sigma.append(None if best is None else best[1])
        left.append(turns)
    return tuple(sigma), tuple(left)
