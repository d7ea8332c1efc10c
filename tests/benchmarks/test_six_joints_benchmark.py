"""How long a six-joint arm takes: its audit, its postures, and what others would take.

Run with ``pytest tests/benchmarks/test_six_joints_benchmark.py --benchmark-only``.
The baselines solve the same questions by numeric means in the same run: inverse
kinematics from many random starts, and a road map of sampled postures.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import fmpq

import cuspaudit
from cuspaudit.algebra.msolve import find_msolve, msolve_text, run_msolve
from cuspaudit.auditing.audit import Options, audit
from cuspaudit.auditing.search.torus_determinant import TorusDeterminant
from cuspaudit.auditing.search.torus_path import height_of
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.postures.exact import (
    arm_and_pose,
    exact_postures,
    real_postures,
)
from cuspaudit.kinematics.postures.loop_equations import loop_equations
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.kinematics.postures.raghavan_roth import closed, fifth_axis, first_side
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.library import open_robot

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"
CRX = "fanuc-crx-10ia-l"
TANGENTS = tuple(
    fmpq(a, b) for a, b in ((-1, 3), (4, 5), (2, 3), (5, 7), (-3, 2), (1, 4))
)
POSES = 20
SOLVED = (CRX, "puma-560", "kinova-jaco-gen2", "hyperplane-6r")


def solver_and_poses() -> tuple[PostureSolver, np.ndarray]:
    """The solver of the CRX and the poses of random postures."""
    solver = PostureSolver.of(read_robot(ROBOTS / f"{CRX}.yaml").chain)
    given = np.random.default_rng(4).uniform(-np.pi, np.pi, (POSES, 6))
    return solver, solver.poses(given)


def test_the_audit_of_the_crx(benchmark: Any) -> None:
    """Verdict, certificate and cross-check, five seeds: at most 15 s at the median."""
    seeds = iter(range(5))

    def run() -> str:
        return audit(open_robot(CRX), Options(seed=next(seeds))).verdict.value

    assert benchmark.pedantic(run, rounds=5) == "cuspidal"
    assert benchmark.stats.stats.median < 15


def test_all_postures_numerically(benchmark: Any) -> None:
    """Twenty poses of the CRX, all postures of each: at most 5 ms a pose."""
    solver, poses = solver_and_poses()
    found = benchmark.pedantic(solver.solve, args=(poses,), rounds=5, warmup_rounds=1)
    assert min(map(len, found)) >= 2
    assert benchmark.stats.stats.median < 0.005 * POSES


def test_baseline_many_random_starts(benchmark: Any) -> None:
    """Two of these poses by Newton's method from random starts, to equal success."""
    solver, poses = solver_and_poses()
    wanted = [len(found) for found in solver.solve(poses)]
    rng = np.random.default_rng(0)

    def run() -> None:
        for pose, count in zip(poses[:2], wanted[:2], strict=True):
            found = np.zeros((0, 6))
            while len(found) < count:
                starts = rng.uniform(-np.pi, np.pi, (200, 6))
                ends, error = solver._settle(starts, np.broadcast_to(pose, (200, 4, 4)))
                found = _distinct(np.vstack([found, ends[error < 1e-10]]))

    benchmark.pedantic(run, rounds=1)


@pytest.mark.parametrize("name", SOLVED)
def test_all_postures_exactly(benchmark: Any, name: str) -> None:
    """All complex postures of a rational pose, complete."""
    model = exact_model(open_robot(name).chain)
    found = benchmark.pedantic(exact_postures, args=(model, TANGENTS), rounds=5)
    assert len(real_postures(found)) >= 2


@pytest.mark.parametrize("name", SOLVED)
def test_the_same_pose_by_msolve(benchmark: Any, name: str) -> None:
    """The half-chain equations of the same pose, by msolve alone, not proved."""
    try:
        find_msolve()
    except UnableError:
        pytest.skip("msolve is not installed")
    field, arm, pose = arm_and_pose(exact_model(open_robot(name).chain), TANGENTS)
    fifth = field.reduced(fifth_axis(arm))
    side = field.reduced(first_side(arm, field.reduced(closed(arm, pose))))
    ring, equations = loop_equations(field, fifth, side)
    text = msolve_text(ring, [p for p in equations if p != 0])
    benchmark.pedantic(run_msolve, args=(text, ("-P", "2"), 120), rounds=5)


def test_baseline_sampled_road_map(benchmark: Any) -> None:
    """A road map of sampled postures, until it joins two postures of one pose.

    Its edges are looked at every 0.05 rad; this decides nothing, and says so of arms
    that are not cuspidal too.
    """
    solver, poses = solver_and_poses()
    h = TorusDeterminant.of(solver)
    postures = solver.solve(poses[:1])[0][:, 1:5]
    positive = postures[h(postures) > 0][:2]

    def run() -> bool:
        rng = np.random.default_rng(0)
        nodes = list(positive)
        reached = {0}
        for point in rng.uniform(-np.pi, np.pi, (4000, 4)):
            if h(point) > 0:
                nodes.append(point)
        frontier = [0]
        table = np.array(nodes)
        while frontier and 1 not in reached:
            k = frontier.pop(0)
            apart = np.remainder(table - table[k] + np.pi, 2 * np.pi) - np.pi
            for j in np.argsort(np.linalg.norm(apart, axis=1))[1:15]:
                way = np.array([table[k], table[k] + apart[j]])
                if int(j) not in reached and height_of(h, 1.0, way) > 0:
                    reached.add(int(j))
                    frontier.append(int(j))
        return 1 in reached

    assert benchmark.pedantic(run, rounds=1)


def _distinct(postures: np.ndarray) -> np.ndarray:
    kept: list[np.ndarray] = []
    for posture in postures:
        apart = (np.remainder(posture - k + np.pi, 2 * np.pi) - np.pi for k in kept)
        if all(np.abs(a).max() > 1e-6 for a in apart):
            kept.append(posture)
    return np.array(kept).reshape(-1, 6)
