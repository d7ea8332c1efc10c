"""What the pages of a traced tool path and of a list of postures draw, as data."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.frames import angle_value, frames
from cuspaudit.toolpath.postures import PostureList
from cuspaudit.toolpath.traced_path import Run, TracedPath

__all__ = ["MOST_RUNS", "postures_drawing", "trace_drawing"]

Array = NDArray[np.float64]

MOST_RUNS = 24
_SAMPLES = 61


def trace_drawing(trace: TracedPath) -> dict[str, Any]:
    """The runs sampled for drawing, floating point: at most the first `MOST_RUNS`.

    Returns:
        ``runs``: for each its parameters ``s``, joint ``values`` and the ``points`` of
        the arm, base to tip; ``joints``: names, kinds and limits; ``legs``; and the
        ``path`` of the tip.
    """
    chain = trace.arm.robot_chain
    runs = [_sampled(trace, run) for run in trace.runs[:MOST_RUNS]]
    return {
        "joints": joint_rows(chain),
        "legs": trace.path.legs,
        "runs": runs,
        "path": [[float(x) for x in pose.position] for pose in trace.path.poses[:500]],
        "left_out": max(0, len(trace.runs) - MOST_RUNS),
    }


def postures_drawing(found: PostureList) -> dict[str, Any]:
    """The ``points`` of the arm in every posture, base to tip."""
    chain = found.arm.robot_chain
    return {
        "joints": joint_rows(chain),
        "postures": [stick(chain, posture.values) for posture in found.postures],
    }


def joint_rows(chain: Chain) -> list[dict[str, Any]]:
    """Name, kind and limits of each joint."""
    rows = []
    for joint in chain.joints:
        limits = None
        if joint.limits is not None:
            limits = [
                angle_value(limit) if isinstance(limit, Angle) else float(limit)
                for limit in joint.limits
            ]
        rows.append({"name": joint.name, "kind": joint.kind, "limits": limits})
    return rows


def stick(chain: Chain, values: Sequence[float] | Array) -> list[list[float]]:
    """The base, the origins of the joints, and the tip."""
    placed = frames(chain, values)[:, :3, 3]
    return [[0.0, 0.0, 0.0], *([round(float(x), 5) for x in p] for p in placed)]


def _sampled(trace: TracedPath, run: Run) -> dict[str, Any]:
    """A run at equal steps of the parameter, its ends kept."""
    rows = run.points(trace.arm.scales)
    rows = rows[np.argsort(rows[:, -1], kind="stable")]
    s = np.linspace(rows[0, -1], rows[-1, -1], _SAMPLES if len(rows) > 1 else 1)
    values = np.column_stack([np.interp(s, rows[:, -1], col) for col in rows.T[:-1]])
    return {
        "s": [round(float(x), 6) for x in s],
        "values": [[round(float(x), 6) for x in row] for row in values],
        "points": [stick(trace.arm.robot_chain, row) for row in values],
    }
