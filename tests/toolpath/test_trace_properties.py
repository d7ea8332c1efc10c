"""What holds of every tool path: on random arms and paths, the same every time."""

from __future__ import annotations

import random

import pytest
from paths_table import (
    backwards,
    closed_paths,
    partial_map,
    random_poses,
    three_joints,
)

from cuspaudit.robot.library import open_robot
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_arm import traced_arm


@pytest.mark.slow
def test_the_reverse_of_a_path_gives_the_inverse_map() -> None:
    """Twelve random paths of random arms of three joints, births counted too."""
    assert list(three_joints(12, random.Random(7))).count("inverse") >= 10


@pytest.mark.slow
def test_noncuspidal_arms_never_change_posture() -> None:
    """T6 on random closed paths of noncuspidal arms: sigma is the identity."""
    assert list(closed_paths(25, random.Random(3))).count("reached") == 25


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["ur5", "abb-gofa-5", "chablat-2022-5r", "adept-cobra-600"]
)
def test_other_arms_are_traced_there_and_back(name: str) -> None:
    """Six joints, five with a tool axis, four with an angle: the map is inverted."""
    arm = traced_arm(open_robot(name).chain)
    path = random_poses(arm, random.Random(5), 0.2)
    there = trace_path(arm, path, limited=False)
    back = trace_path(arm, backwards(path), limited=False)
    assert there.runs and there.first.complete
    assert all(run.proved for run in (*there.runs, *back.runs))
    assert {(b, a) for a, b in partial_map(back)} == partial_map(there)
