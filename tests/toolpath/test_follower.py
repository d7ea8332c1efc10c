"""The trace against a plain numeric follower, on the same paths in the same run."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from cuspaudit.toolpath.joint_pose import pose_of_joints
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.traced_path import Run, TracedPath
from cuspaudit.toolpath.waypoints import ToolPath
from tests.toolpath.traced_arms import crx, exact, fact, mirror, places

Array = NDArray[np.float64]

_STEP = 1e-3
_JUMP = 0.25


def follow(arm: TracedArm, path: ToolPath, start: Array) -> tuple[float, Array]:
    """Newton's method at every thousandth of a leg, as a simple controller does it.

    Returns:
        where it stops, and the coordinates there; it stops where it does not settle.
    """
    values = start.copy()
    for leg, (a, b) in enumerate(pairwise(path.poses)):
        system = arm.system(a, b)
        for s in np.arange(_STEP, 1 + _STEP / 2, _STEP):
            there = values.copy()
            for _ in range(12):
                value, slope = system.plain(np.append(there, s))
                there = there - np.linalg.lstsq(slope[:, :-1], value, rcond=1e-12)[0]
            if np.abs(system.plain(np.append(there, s))[0]).max() > 1e-9:
                return leg + float(s), values
            values = there
    return float(path.legs), values


def along(trace: TracedPath, run: Run, at: float) -> Array:
    """The coordinates of a run at a parameter, by interpolation."""
    assert run.free is not None
    rows = run.free.points
    return np.array([np.interp(at, rows[:, -1], column) for column in rows.T[:-1]])


def compare(trace: TracedPath) -> tuple[int, list[int]]:
    """How many runs the follower agrees with, and those where it jumps.

    A jump is a step of the follower after which it is far from the run it began in.
    """
    agreed, jumps = 0, []
    for number, run in enumerate(trace.runs):
        assert run.free is not None and run.proved
        stopped, last = follow(trace.arm, trace.path, run.free.first.at[:-1])
        if run.end == "reached" and stopped == trace.path.legs:
            gap = np.abs(np.sin((last - run.free.last.at[:-1]) / 2)).max()
            if gap < 1e-6:
                agreed += 1
                continue
        elif run.end == "singular" and abs(stopped - run.at) < 0.02:
            agreed += 1
            continue
        jumps.append(number)
    return agreed, jumps


def shown_to_jump(trace: TracedPath, number: int) -> bool:
    """Whether the follower leaves the run in one step, or lives on after its death."""
    run, path, arm = trace.runs[number], trace.path, trace.arm
    assert run.free is not None
    values = run.free.first.at[:-1].copy()
    for leg, (a, b) in enumerate(pairwise(path.poses)):
        system = arm.system(a, b)
        for s in np.arange(_STEP, 1 + _STEP / 2, _STEP):
            there = values.copy()
            for _ in range(12):
                value, slope = system.plain(np.append(there, s))
                there = there - np.linalg.lstsq(slope[:, :-1], value, rcond=1e-12)[0]
            if np.abs(np.sin((there - values) / 2)).max() > _JUMP / 2:
                return abs(leg + s - run.at) < 0.02 or run.end == "reached"
            values = there
    return False


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["feasible in none", "feasible in two of four", "changes posture"]
)
def test_a_plain_follower_agrees_but_where_it_jumps(name: str) -> None:
    """Every run agrees, or the follower is shown to leave it in one step."""
    trace = trace_path(mirror(), places(*fact(name)["path"]))
    agreed, jumps = compare(trace)
    assert agreed + len(jumps) == len(trace.runs)
    assert all(shown_to_jump(trace, number) for number in jumps)
    reached = [run for run in trace.runs if run.end == "reached"]
    assert agreed >= len(reached)


def test_a_path_close_to_a_singularity_is_traced_right() -> None:
    """Where the follower's step is coarse it changes branch; the run does not."""
    path = places((2, 0, 0), ("1.6609", 0, "0.0005"), (2, 0, 0))
    trace = trace_path(mirror(), path)
    for run in trace.runs:
        assert run.proved
    alive = [k for k, run in enumerate(trace.runs) if run.end == "reached"]
    assert trace.permutation is not None
    assert all(trace.permutation[k] == k for k in alive)


@pytest.mark.slow
def test_a_plain_follower_of_the_crx_agrees_but_where_it_jumps() -> None:
    """12 runs of the published line: those that reach the end agree."""
    known = fact("CRX-10iA/L straight line, 4 of 12 feasible")
    ends = (known["from_posture"], known["to_posture"])
    poses = [pose_of_joints(crx(), [exact(x) for x in q]) for q in ends]
    trace = trace_path(crx(), ToolPath(tuple(poses)))
    agreed, jumps = compare(trace)
    assert agreed >= 4
    assert all(trace.runs[k].end == "singular" for k in jumps)
    assert all(shown_to_jump(trace, number) for number in jumps)
