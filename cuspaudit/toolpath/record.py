"""The trace as a JSON record, schema ``cuspaudit/trace/1``."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from cuspaudit.toolpath.following.margins import (
    limit_margin,
    recommended,
    singular_margin,
)
from cuspaudit.toolpath.laps import laps_of
from cuspaudit.toolpath.reach import first_unreachable
from cuspaudit.toolpath.recorded import recorded_motion
from cuspaudit.toolpath.traced_path import Run, TracedPath

__all__ = ["SCHEMA", "exit_code", "trace_record"]

SCHEMA = "cuspaudit/trace/1"


def trace_record(
    trace: TracedPath, name: str, file: str, laps: int = 1
) -> dict[str, Any]:
    """The record of a trace: angles in rad, lengths in the robot's unit.

    Args:
        trace: the trace.
        name: of the robot.
        file: where it comes from.
        laps: how many laps of a closed path are followed.
    """
    arm, path = trace.arm, trace.path
    missed, motion = first_unreachable(trace), recorded_motion(trace)
    return {
        "schema": SCHEMA,
        "robot": {
            "name": name,
            "file": file,
            "joints": [joint.name for joint in arm.robot_chain.joints],
            "task": arm.robot_chain.task,
            "unit": arm.robot_chain.unit,
            "exact": arm.model.is_exact,
        },
        "path": {
            "file": path.file or None,
            "waypoints": len(path.poses),
            "from_joints": path.joints is not None,
            "orientation": _orientation(trace),
        },
        "limits": trace.limited,
        "runs": [_run(trace, run) for run in trace.runs],
        "born": [
            {
                "at": birth.at,
                "sign": birth.sign,
                "end": birth.end,
                "until": birth.until,
                "first": list(birth.first),
            }
            for birth in trace.born
        ],
        "closed": trace.closed,
        "permutation": None if trace.permutation is None else list(trace.permutation),
        "turns": None
        if trace.turns is None
        else [None if turn is None else list(turn) for turn in trace.turns],
        "laps": [
            {
                "kind": one.kind,
                "completed": one.completed,
                "repeats_after": one.repeats_after,
                "ends_in": list(one.ends_in),
            }
            for one in laps_of(trace, laps)
        ],
        "verdict_from_path": trace.verdict_from_path,
        "recommended": recommended(trace),
        "recorded": None if motion is None else asdict(motion),
        "unreachable": None
        if missed is None
        else {
            "waypoint": missed.waypoint,
            "proved": missed.proved,
            "distance": missed.distance,
            "turn": missed.turn,
        },
        "complete": {
            "postures": trace.first.complete,
            "births": trace.births_complete,
        },
        "rests_on": _grounds(trace),
        "remarks": list(trace.remarks),
    }


def exit_code(trace: TracedPath) -> int:
    """0 if every start posture reaches the end, and repeats on a closed path.

    1 if some do not, or there is no posture inside the limits at the first pose; 3 if
    that is not proved either way.
    """
    inside = [run for run in trace.runs if run.inside]
    dies = any(run.proved and run.end in ("singular", "limit") for run in inside)
    if dies or (not inside and (trace.first.complete or trace.runs)):
        return 1
    if any(not run.proved for run in inside) or not trace.first.complete:
        return 3
    if any(one.kind != "repeatable" for one in _of_inside(trace)):
        return 1
    return 0


def _of_inside(trace: TracedPath) -> list[Any]:
    every = laps_of(trace)
    return [one for one, run in zip(every, trace.runs, strict=False) if run.inside]


def _run(trace: TracedPath, run: Run) -> dict[str, Any]:
    return {
        "posture": run.posture,
        "start": list(run.start),
        "sign": run.sign,
        "inside": run.inside,
        "end": run.end,
        "at": run.at,
        "joint": run.joint,
        "last": list(run.last),
        "proved": run.proved,
        "ends_in": run.ends_in,
        "margin": {
            "singular": _finite(singular_margin(trace.arm, run)),
            "limit": limit_margin(trace.arm, run) if trace.limited else None,
        },
    }


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None


def _orientation(trace: TracedPath) -> str | None:
    if trace.arm.task == "position":
        return None
    return "about one axis at constant rate"


def _grounds(trace: TracedPath) -> list[str]:
    grounds = list(trace.first.grounds)
    for ground in ("Krawczyk tubes", "ball arithmetic"):
        if any(run.free is not None for run in trace.runs):
            grounds.append(ground)
    return grounds
