"""What holds of every tool path: on random arms and paths, the same every time."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cuspaudit.robot.chain import Angle
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot
from cuspaudit.toolpath.joint_pose import pose_of_joints
from cuspaudit.toolpath.trace import Trace, trace_path
from cuspaudit.toolpath.traced_arm import TracedArm, traced_arm
from cuspaudit.toolpath.waypoints import ToolPath
from tests.toolpath.traced_arms import places, table_arm

_TWISTS = ("1/2", "-1/2", "1/2", "0")
#: noncuspidal: an elbow, one with a shoulder offset, two with meeting axes
_CALM = (
    ([0, 1, 1], [0, 0, 0], ["1/2", "0", "0"]),
    ([".3", 1, ".8"], [0, ".2", 0], ["1/2", "0", "0"]),
    ([1, 2, 1], [0, 0, 0], ["0", "1/2", "0"]),
    ([0, 1, 1], [0, ".3", 0], ["1/2", "1/2", "0"]),
)


def random_arm(rng: random.Random) -> TracedArm:
    """Three joints with right angles between their axes, or parallel ones."""
    lengths = [f"{rng.uniform(0.1, 2):.2f}" for _ in range(3)]
    offsets = ["0", *(f"{rng.choice([0, rng.uniform(-1, 1)]):.2f}" for _ in range(2))]
    twists = [rng.choice(_TWISTS), rng.choice(_TWISTS[:3]), "0"]
    return traced_arm(table_arm(lengths, offsets, twists))


def random_places(
    arm: TracedArm, rng: random.Random, spread: float, count: int
) -> ToolPath:
    """Places of the tip, near each other where ``spread`` is small."""
    chain, start = arm.robot_chain, [rng.uniform(-3, 3) for _ in range(3)]
    rows = []
    for _ in range(count):
        values = [x + rng.uniform(-spread, spread) for x in start]
        point = frames(chain, values)[-1, :3, 3]
        rows.append([f"{float(x):.3f}" for x in point])
    return places(*rows)


def partial_map(trace: Trace) -> set[tuple[int, int | None]]:
    """Where the runs that reach the end lead."""
    return {(r.posture, r.ends_in) for r in trace.runs if r.end == "reached"}


def backwards(path: ToolPath) -> ToolPath:
    """The same poses, last to first."""
    return replace(path, poses=path.poses[::-1])


@pytest.mark.slow
def test_the_reverse_of_a_path_gives_the_inverse_map() -> None:
    """Twelve random paths of random arms of three joints, births counted too."""
    rng, decided = random.Random(7), 0
    for _ in range(12):
        arm = random_arm(rng)
        path = random_places(arm, rng, 3.0, 3)
        there, back = trace_path(arm, path), trace_path(arm, backwards(path))
        if all(run.proved for run in (*there.runs, *back.runs)):
            decided += 1
            assert {(b, a) for a, b in partial_map(back)} == partial_map(there)
            ends = [run.at for run in back.runs if run.end == "singular"]
            born = [path.legs - b.at for b in there.born if b.end == "reached"]
            assert np.allclose(sorted(born), sorted(ends), atol=1e-6)
    assert decided >= 10


@pytest.mark.slow
def test_noncuspidal_arms_never_change_posture() -> None:
    """T6 on random closed paths of noncuspidal arms: sigma is the identity."""
    rng, met = random.Random(3), 0
    for _ in range(25):
        arm = traced_arm(table_arm(*rng.choice(_CALM)))
        path = random_places(arm, rng, 0.5, 3)
        trace = trace_path(arm, ToolPath((*path.poses, path.poses[0])))
        assert trace.verdict_from_path is None and trace.permutation is not None
        for run, to in zip(trace.runs, trace.permutation, strict=True):
            if run.end == "reached":
                met += 1
                assert to is not None and trace.runs[to].posture == run.posture
    assert met > 40


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["ur5", "abb-gofa-5", "chablat-2022-5r", "adept-cobra-600"]
)
def test_other_arms_are_traced_there_and_back(name: str) -> None:
    """Six joints, five with a tool axis, four with an angle: the map is inverted."""
    rng = random.Random(5)
    arm = traced_arm(open_robot(name).chain)
    poses = []
    start = [rng.uniform(-1.5, 1.5) for _ in range(arm.joints)]
    for _ in range(2):
        values: list[Angle | Fraction] = []
        for joint, x in zip(arm.robot_chain.joints, start, strict=True):
            exact = Fraction(f"{x + rng.uniform(-0.2, 0.2):.3f}")
            slides = joint.kind == "prismatic"
            values.append(Fraction(1, 10) if slides else Angle(radians=exact))
        poses.append(pose_of_joints(arm, values))
    path = ToolPath(tuple(poses))
    there = trace_path(arm, path, limited=False)
    back = trace_path(arm, backwards(path), limited=False)
    assert there.runs and there.first.complete
    assert all(run.proved for run in (*there.runs, *back.runs))
    assert {(b, a) for a, b in partial_map(back)} == partial_map(there)
