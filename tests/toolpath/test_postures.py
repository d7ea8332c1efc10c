from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from cuspaudit.errors import InvalidInputError
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.snapping import snap
from cuspaudit.toolpath.asked import asked_pose, joint_vector, quaternion_of_rpy
from cuspaudit.toolpath.postures import held_to, list_postures, postures_record
from cuspaudit.toolpath.traced_arm import traced_arm
from cuspaudit.toolpath.waypoints import Pose
from tests.toolpath.traced_arms import crx, mirror, table_arm


def test_all_postures_of_a_place_with_their_aspects() -> None:
    """Four postures in two aspects, two each: the arm is cuspidal."""
    pose = asked_pose(mirror(), None, "2.5,0,0.37", None, None)
    found = list_postures(mirror(), pose)
    assert found.complete and found.aspects == 2
    assert [posture.aspect for posture in found.postures] == [1, 1, 2, 2]
    assert [posture.sign for posture in found.postures] == [1, 1, -1, -1]
    for posture in found.postures:
        tip = frames(mirror().robot_chain, posture.values)[-1, :3, 3]
        assert np.abs(tip - [2.5, 0, 0.37]).max() < 1e-12
        assert posture.proved and posture.inside


def test_a_posture_at_the_wrist_is_as_near_to_singular_as_its_sine() -> None:
    """A UR5 with joint 5 at 0.4 rad is 0.4 rad from a singular one: joint 5 at 0."""
    arm = traced_arm(snap(open_robot("ur5_robot").chain)[0])
    pose = asked_pose(arm, "0.1,-1,1.2,0.3,0.4,0", None, None, None)
    found = list_postures(arm, pose)
    assert found.complete and len(found.postures) == 8
    assert {posture.aspect for posture in found.postures} == set(range(1, 9))
    assert found.postures[5].nearest_singular == pytest.approx(0.4, abs=1e-6)


def test_a_singular_pose_says_that_whole_curves_may_have_it() -> None:
    """With all joints of a UR5 at 0 the wrist turns on the spot: nothing is counted."""
    arm = traced_arm(snap(open_robot("ur5_robot").chain)[0])
    found = list_postures(arm, asked_pose(arm, "0,0,0,0,0,0", None, None, None))
    assert found.whole_curves and not found.complete
    record = postures_record(found, "ur5", "ur5.urdf")
    assert record["whole_curves"] and "infinitely many" in record["why"]


def test_a_place_out_of_reach_has_no_posture_proved() -> None:
    """An empty list is complete."""
    found = list_postures(mirror(), Pose((Fraction(50), Fraction(0), Fraction(0))))
    assert found.complete and found.postures == ()


def test_a_pose_has_an_even_number_of_postures_of_either_sign() -> None:
    """12 of the CRX: six of sign +, six of sign -."""
    text = "2.0323,1.2241,-1.1492,2.8288,-2.9252,-0.3849"
    found = list_postures(crx(), asked_pose(crx(), text, None, None, None))
    assert found.complete
    signs = [posture.sign for posture in found.postures]
    assert signs.count(1) == signs.count(-1) == 6


def test_windings_are_those_inside_the_limits() -> None:
    """Each joint of a UR5 may turn twice: but the elbow: 32 windings."""
    arm = traced_arm(snap(open_robot("ur5_robot").chain)[0])
    found = list_postures(
        arm, asked_pose(arm, "0.1,-1,1.2,0.3,0.4,1", None, None, None)
    )
    first = found.postures[0]
    assert len(first.windings) == len(set(first.windings)) == 32
    for turns in first.windings:
        values = np.array(first.values) + 2 * math.pi * np.array(turns)
        for value, joint in zip(values, arm.robot_chain.joints, strict=True):
            assert joint.limits is not None and abs(value) < 2 * math.pi


def test_roll_pitch_yaw_turn_about_the_fixed_axes() -> None:
    """As in URDF: yaw after pitch after roll; right angles are exact."""
    angles = joint_vector("90 deg,0,90 deg", mirror().robot_chain, "--rpy")
    pose = Pose((Fraction(0),) * 3, quaternion_of_rpy(list(angles)))  # type: ignore[arg-type]
    assert pose.rotation == ((0, 0, 1), (1, 0, 0), (0, 1, 0))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1,2", "2 joint values"),
        ("1,2,90", "90 rad is more than two turns; write 90 deg"),
        ("1,2,x", "j3"),
    ],
)
def test_joint_vectors_of_options_are_checked(text: str, words: str) -> None:
    """A number that is likely in degrees is refused, and the remedy works."""
    with pytest.raises(InvalidInputError, match=words):
        joint_vector(text, mirror().robot_chain, "--joints")
    assert joint_vector("1,2,90 deg", mirror().robot_chain, "--joints")


def test_postures_of_an_arm_with_a_slide_are_searched_and_not_called_complete() -> None:
    """The Stanford arm: the given one is found, each is proved, none is promised."""
    arm = traced_arm(open_robot("stanford-arm").chain)
    text = "0.1,0.2,0.3,0.4,0.5,0.6"
    found = list_postures(arm, asked_pose(arm, text, None, None, None))
    given = np.array([float(x) for x in text.split(",")])
    gaps = [
        np.abs(np.array(posture.values) - given).max() for posture in found.postures
    ]
    assert min(gaps) < 1e-9 and not found.complete
    assert all(posture.proved for posture in found.postures)


def test_the_distance_to_a_singular_posture_is_bounded_from_below() -> None:
    """What is proved is at most what is searched, and most of it for three joints."""
    found = list_postures(mirror(), asked_pose(mirror(), "0.1,-1,1.2", *[None] * 3))
    for posture in found.postures:
        assert posture.nonsingular_within is not None
        assert 0 < posture.nonsingular_within <= posture.nearest_singular


@pytest.mark.parametrize(
    "joints",
    [
        "0.1,-1,1.2,0.3,0,0",
        "0.1,-1,0,0.3,0.4,0",
        "1,-1,1.2,0.3,3.141592653,0",
        "2*pi,pi/3,-pi/3,0,0,3*pi/4",
    ],
)
def test_a_singular_joint_vector_is_no_posture_of_its_rounded_pose(joints: str) -> None:
    """A wrist that turns on the spot, or an elbow stretched: not called complete.

    The last one may be by chance within 1e-7 of a posture of the rounded pose.
    """
    arm = traced_arm(snap(open_robot("ur5_robot").chain)[0])
    found = list_postures(arm, asked_pose(arm, joints, None, None, None))
    held = held_to(found, joint_vector(joints, arm.robot_chain, "--joints"))
    assert not held.complete and held.why


def test_a_singular_joint_vector_of_a_rational_pose_is_one_of_its_postures() -> None:
    """An elbow stretched along x: its two postures are proved singular, and all."""
    arm = traced_arm(table_arm([0, 1, 1], [0, 0, 0], ["1/2", "0", "0"]))
    found = list_postures(arm, asked_pose(arm, "0,0,0", None, None, None))
    held = held_to(found, joint_vector("0,0,0", arm.robot_chain, "--joints"))
    assert held is found and held.complete
    assert [posture.sign for posture in held.postures] == [0, 0]


def test_a_regular_joint_vector_is_a_posture_of_its_pose() -> None:
    """The list is the same, and stays complete."""
    arm = traced_arm(snap(open_robot("ur5_robot").chain)[0])
    joints = "0.1,-1,1.2,0.3,0.4,7"
    found = list_postures(arm, asked_pose(arm, joints, None, None, None))
    held = held_to(found, joint_vector(joints, arm.robot_chain, "--joints"))
    assert held is found and held.complete


@pytest.mark.parametrize("name", ["kinova-jaco-gen2", "raghavan-roth"])
def test_an_arm_without_an_exact_model_has_a_complete_list(name: str) -> None:
    """Its postures are as many as a count in balls allows, each proved."""
    arm = traced_arm(snap(open_robot(name).chain)[0])
    assert not arm.model.is_exact or name != "kinova-jaco-gen2"
    found = list_postures(
        arm, asked_pose(arm, "0.3,-1,1.2,0.3,0.4,0.2", None, None, None)
    )
    assert found.complete and found.why == ""
    assert all(posture.proved and posture.sign for posture in found.postures)
    signs = [posture.sign for posture in found.postures]
    assert signs.count(1) == signs.count(-1)
    for posture in found.postures:
        tip = frames(arm.robot_chain, posture.values)[-1]
        target = frames(arm.robot_chain, [0.3, -1, 1.2, 0.3, 0.4, 0.2])[-1]
        assert np.abs(tip - target).max() < 1e-9 * (1 + np.abs(target).max())
