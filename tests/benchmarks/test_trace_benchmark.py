"""How long tool paths take: three joints and the CRX, on one core.

Run with ``pytest tests/benchmarks/test_trace_benchmark.py --benchmark-only``. Bounds
are of processor time.
"""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from cuspaudit.toolpath.joint_pose import pose_of_joints
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import ToolPath
from tests.toolpath.traced_arms import crx, exact, mirror, places


def timed(benchmark: Any, arm: TracedArm, path: ToolPath) -> float:
    """Seconds of processor time of a trace whose runs are all proved."""
    arm.model  # noqa: B018 - made once an arm
    start = time.process_time()
    trace = benchmark.pedantic(trace_path, args=(arm, path), rounds=1)
    seconds = time.process_time() - start
    assert all(run.proved for run in trace.runs)
    return seconds


def test_sixteen_waypoints_of_three_joints(benchmark: Any) -> None:
    """Under a second."""
    around = np.linspace(0, 2 * np.pi, 16)
    rows = [
        (
            f"{2.2 + np.cos(x):.3f}",
            f"{0.3 * np.sin(2 * x):.3f}",
            f"{0.5 + np.sin(x):.3f}",
        )
        for x in around
    ]
    assert timed(benchmark, mirror(), places(*rows)) < 1


def test_sixteen_waypoints_of_the_crx(benchmark: Any) -> None:
    """Under ten seconds, all twelve runs proved."""
    start = np.array([2.0323, 1.2241, -1.1492, 2.8288, -2.9252, -0.3849])
    poses = []
    for x in np.linspace(0, 2 * np.pi, 16):
        turn = [np.sin(x), np.cos(x) - 1, np.sin(2 * x), np.sin(x) / 2, 0.1, np.sin(x)]
        values = start + 0.25 * np.array(turn)
        poses.append(pose_of_joints(crx(), [exact(f"{v:.5f}") for v in values]))
    assert timed(benchmark, crx(), ToolPath(tuple(poses))) < 10


def test_a_thousand_waypoints_of_three_joints(benchmark: Any) -> None:
    """Under six seconds with four runs: ten thousand take under a minute."""
    around = np.linspace(0, 4 * np.pi, 1000)
    rows = [
        (
            f"{2 + 0.2 * np.cos(x):.6f}",
            f"{0.1 * np.sin(2 * x):.6f}",
            f"{0.2 * np.sin(x):.6f}",
        )
        for x in around
    ]
    assert timed(benchmark, mirror(), places(*rows)) < 6
