from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq

from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.postures.ball_count import posture_bound
from cuspaudit.kinematics.postures.exact import arm_and_pose
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.library import open_robot


def poses(chain: Chain, count: int) -> list[np.ndarray]:
    """Poses with rational numbers near those of random postures."""
    model = exact_model(chain)
    rng = np.random.default_rng(2)
    found = []
    for _ in range(count):
        tangents = [fmpq(int(x), 9) for x in rng.integers(-20, 21, 6)]
        found.append(arm_and_pose(model, tangents)[2])
    return found


@pytest.mark.parametrize("name", ["fanuc-crx-10ia-l", "abb-gofa-5", "ufactory-xarm6"])
def test_the_count_is_that_of_the_postures_met(name: str) -> None:
    """At least as many as floating point meets, where it is told; mostly as many."""
    chain = open_robot(name).chain
    solver, told, same = PostureSolver.of(chain), 0, 0
    for pose in poses(chain, 6):
        bound = posture_bound(chain, pose)
        place = pose.astype(float)
        place[:3, 3] /= solver.scale
        met = len(solver.solve(place[None])[0])
        if bound is not None:
            told += 1
            assert bound >= met
            same += bound == met
    assert told >= 2 and same >= told - 1


def test_twists_without_a_rational_cosine_are_counted() -> None:
    """The JACO 2 turns by 55 degrees: no exact model, and its postures are counted."""
    chain = open_robot("kinova-jaco-gen2").chain
    assert not exact_model(chain).is_exact
    pose = poses(chain, 1)[0]
    bound = posture_bound(chain, pose)
    solver, place = PostureSolver.of(chain), pose.astype(float)
    place[:3, 3] /= solver.scale
    assert bound == len(solver.solve(place[None])[0])


def test_a_pose_without_postures_has_none() -> None:
    """Far out of reach the resultant has no real root, or nothing is told."""
    chain = open_robot("fanuc-crx-10ia-l").chain
    pose = poses(chain, 1)[0].copy()
    pose[:3, 3] += fmpq(40)
    assert posture_bound(chain, pose) in (0, None)


def test_other_arms_have_no_count() -> None:
    """Slides, and wrists whose roots are double both ways, are not told."""
    stanford = open_robot("stanford-arm").chain
    pose = poses(open_robot("fanuc-crx-10ia-l").chain, 1)[0]
    assert posture_bound(stanford, pose) is None
