"""Random tool paths: what must hold of every one of them, counted.

    python tests/paths_table.py [THREE] [SIX] [CLOSED] [--seed N]

THREE paths of random arms of three joints and SIX of six-joint arms are traced there
and back: the map of postures backwards is the inverse, and deaths are births. CLOSED
paths of noncuspidal arms that a run follows to the end are traced: no run changes its
posture (T6). A broken fact ends the script with an error.
"""

from __future__ import annotations

import argparse
import random
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

from cuspaudit.robot.chain import Angle
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot
from cuspaudit.toolpath.joint_pose import JointValue, pose_of_joints
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_arm import TracedArm, traced_arm
from cuspaudit.toolpath.traced_path import TracedPath
from cuspaudit.toolpath.waypoints import ToolPath
from tests.toolpath.traced_arms import crx, places, table_arm

_TWISTS = ("1/2", "-1/2", "1/2", "0")
#: noncuspidal: an elbow, one with a shoulder offset, two with meeting axes
_CALM = (
    ([0, 1, 1], [0, 0, 0], ["1/2", "0", "0"]),
    ([".3", 1, ".8"], [0, ".2", 0], ["1/2", "0", "0"]),
    ([1, 2, 1], [0, 0, 0], ["0", "1/2", "0"]),
    ([0, 1, 1], [0, ".3", 0], ["1/2", "1/2", "0"]),
)
_SIX = ("crx", "ur5", "abb-gofa-5", "puma-560")


def random_arm(rng: random.Random) -> TracedArm:
    """Three joints with right angles between their axes, or parallel ones."""
    lengths = [f"{rng.uniform(0.1, 2):.2f}" for _ in range(3)]
    offsets = ["0", *(f"{rng.choice([0, rng.uniform(-1, 1)]):.2f}" for _ in range(2))]
    twists = [rng.choice(_TWISTS), rng.choice(_TWISTS[:3]), "0"]
    return traced_arm(table_arm(lengths, offsets, twists))


def calm_arm(rng: random.Random) -> TracedArm:
    """A noncuspidal arm of three joints."""
    return traced_arm(table_arm(*rng.choice(_CALM)))


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


def random_poses(arm: TracedArm, rng: random.Random, spread: float) -> ToolPath:
    """Two poses of the tip, of joint vectors that are near each other."""
    start = [rng.uniform(-1.5, 1.5) for _ in range(arm.joints)]
    poses = []
    for _ in range(2):
        values: list[JointValue] = []
        for joint, x in zip(arm.robot_chain.joints, start, strict=True):
            exact = Fraction(f"{x + rng.uniform(-spread, spread):.3f}")
            slides = joint.kind == "prismatic"
            values.append(Fraction(1, 10) if slides else Angle(radians=exact))
        poses.append(pose_of_joints(arm, values))
    return ToolPath(tuple(poses))


def backwards(path: ToolPath) -> ToolPath:
    """The same poses, last to first."""
    return replace(path, poses=path.poses[::-1])


def partial_map(trace: TracedPath) -> set[tuple[int, int | None]]:
    """Where the runs that reach the end lead."""
    return {(r.posture, r.ends_in) for r in trace.runs if r.end == "reached"}


def check_reverse(arm: TracedArm, path: ToolPath, births: bool) -> str:
    """What was found there and back; an AssertionError where the two contradict.

    Args:
        arm: the arm.
        path: is traced without limits.
        births: whether the births there are to be the deaths back, where all of them
            are known; a path that begins or ends at a singular posture leaves some.
    """
    there = trace_path(arm, path, limited=False)
    back = trace_path(arm, backwards(path), limited=False)
    if not all(run.proved for run in (*there.runs, *back.runs)):
        return "undecided"
    assert {(b, a) for a, b in partial_map(back)} == partial_map(there)
    if births and not (there.births_complete and back.births_complete):
        return "inverse, births open"
    if births:
        ends = [r.at for r in back.runs if r.end == "singular" and r.sign != 0]
        born = [path.legs - b.at for b in there.born if b.end == "reached"]
        assert np.allclose(sorted(born), sorted(ends), atol=1e-6)
    return "inverse" if there.runs or back.runs else "no posture"


def check_calm(arm: TracedArm, path: ToolPath) -> str:
    """Whether a run reached the end; an AssertionError where one changed posture."""
    trace = trace_path(arm, ToolPath((*path.poses, path.poses[0])))
    assert trace.verdict_from_path is None and trace.permutation is not None
    met = 0
    for run, to in zip(trace.runs, trace.permutation, strict=True):
        if run.end == "reached":
            met += 1
            assert to is not None and trace.runs[to].posture == run.posture
    return "reached" if met else "none reached"


def three_joints(count: int, rng: random.Random) -> Iterator[str]:
    """The outcome of each path of three joints."""
    for _ in range(count):
        arm = random_arm(rng)
        path = random_places(arm, rng, 3.0, 3)
        yield check_reverse(arm, path, births=True)


def six_joints(count: int, rng: random.Random) -> Iterator[str]:
    """The outcome of each path of six joints."""
    for number in range(count):
        name = _SIX[number % len(_SIX)]
        arm = crx() if name == "crx" else traced_arm(open_robot(name).chain)
        path = random_poses(arm, rng, rng.choice([0.1, 0.3, 0.6]))
        yield check_reverse(arm, path, births=False)


def closed_paths(count: int, rng: random.Random) -> Iterator[str]:
    """The outcome of closed paths, until ``count`` of them had a run to the end."""
    met = 0
    while met < count:
        arm = calm_arm(rng)
        said = check_calm(arm, random_places(arm, rng, 0.5, 3))
        met += said == "reached"
        yield said


def main() -> None:
    """Print the counts of each kind."""
    parser = argparse.ArgumentParser()
    for name, count in (("three", 200), ("six", 40), ("closed", 500)):
        parser.add_argument(name, nargs="?", type=int, default=count)
    parser.add_argument("--seed", type=int, default=1)
    chosen = parser.parse_args()
    rng = random.Random(chosen.seed)
    for title, outcomes in (
        ("three joints, there and back", three_joints(chosen.three, rng)),
        ("six joints, there and back", six_joints(chosen.six, rng)),
        ("closed, noncuspidal", closed_paths(chosen.closed, rng)),
    ):
        counts = Counter(outcomes)
        said = ", ".join(f"{count} {name}" for name, count in counts.most_common())
        print(f"{title}: {sum(counts.values())}: {said}", flush=True)


if __name__ == "__main__":
    main()
