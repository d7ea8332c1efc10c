from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest

import cuspaudit
from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.auditing.free_joint.free_joint import free_joint, lockable
from cuspaudit.auditing.free_joint.stretch import FreeJoint, Stretch, joined
from cuspaudit.auditing.options import Options
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, InvalidRobotError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.locked.span import WHOLE_CIRCLE
from cuspaudit.robot.chain import Angle, Chain, Joint, Rotation, Translation
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.task import lock

FOLDER = Path(cuspaudit.__file__).parents[1] / "robots" / "seven-joints"


def robot(name: str) -> Robot:
    """A robot of seven joints."""
    return read_robot(FOLDER / f"{name}.yaml")


def covers(stretches: tuple[Stretch, ...]) -> bool:
    """Whether stretches follow each other round the circle."""
    ends = [each.span for each in stretches]
    meets = all(a.upper == b.lower for a, b in pairwise(ends))
    return meets and ends[0].lower == WHOLE_CIRCLE.lower


@pytest.mark.parametrize(
    "name", ["kuka-lbr-iiwa-14", "barrett-wam", "motoman-sia5d", "motoman-sia50d"]
)
def test_published_noncuspidal_arms(name: str) -> None:
    """With joint 3 locked at any value these are noncuspidal: the whole circle."""
    found = free_joint(robot(name), "joint_3")
    assert found.verdict is Verdict.NONCUSPIDAL
    assert found.degrees[Verdict.NONCUSPIDAL] == pytest.approx(360)
    assert [each.kind for each in found.stretches] == ["structure"]


def test_exceptional_values_are_single() -> None:
    """Joint 2 of an iiwa: noncuspidal but where axes 1 and 3 are one line."""
    found = free_joint(robot("kuka-lbr-iiwa-14"), "joint_2", Options(timeout=5))
    assert found.verdict is Verdict.NONCUSPIDAL
    assert covers(found.stretches)
    for value in (0.0, 3.141592653589793):
        stretch = found.at(value)
        assert stretch is not None
        assert stretch.verdict is Verdict.UNDECIDED
        assert stretch.span.degrees < 0.02


def test_structured_values_agree_with_the_deciders() -> None:
    """At values of joint 2 of a WAM the ordinary deciders say what the stretch says."""
    found = free_joint(robot("barrett-wam"), "joint_2", Options(timeout=5))
    for sixths in (1, 3, -4, -5):
        value = Angle(Fraction(sixths, 6))
        stretch = found.at(angle_value(value))
        assert stretch is not None
        held = lock(found.chain, {"joint_2": value})
        if stretch.verdict is not Verdict.UNDECIDED:
            assert answer(exact_model(held)).verdict is stretch.verdict


def test_a_lock_of_the_last_joint_moves_the_tool_alone() -> None:
    """Joint 7 of a Panda: one decision is that of every value."""
    found = free_joint(robot("franka-panda"), "joint_7")
    [stretch] = found.stretches
    assert (stretch.kind, stretch.verdict) == ("idle", Verdict.NONCUSPIDAL)


def test_an_idle_joint_keeps_the_limits_of_the_others() -> None:
    """A cuspidal arm on a turntable is noncuspidal in a small box, cuspidal in none."""
    given = read_robot(FOLDER.parent / "wenger-2007-8-cusps.yaml")
    small = Fraction(1, 10), Fraction(1, 5)
    first, *others = (replace(j, limits=small) for j in given.chain.joints)
    before = (
        Translation((Fraction(1), Fraction(0), Fraction(0))),
        Rotation((Fraction(1), Fraction(0), Fraction(0)), Angle(Fraction(1, 2))),
    )
    joints = (Joint("table", "revolute"), replace(first, before=before), *others)
    spare = replace(given, chain=replace(given.chain, joints=joints))
    for within, verdict in ((False, Verdict.CUSPIDAL), (True, Verdict.NONCUSPIDAL)):
        found = free_joint(spare, "table", Options(timeout=20), within)
        assert [(each.kind, each.verdict) for each in found.stretches] == [
            ("idle", verdict)
        ]


def test_shares_do_not_hang_on_frames() -> None:
    """Another base, tool and frames of the links leave every share as it is."""
    given = robot("barrett-wam")
    there = Rotation((Fraction(3), Fraction(0), Fraction(4)), Angle(Fraction(1, 2)))
    off = Translation((Fraction(1, 3), Fraction(-2), Fraction(1, 7)))
    turn = Rotation((Fraction(0), Fraction(0), Fraction(1)), Angle(Fraction(1, 4)))
    joints = []
    for number, joint in enumerate(given.chain.joints):
        # a turn about the joint's own axis, put before it and taken back after it
        before = (*((off, there) if number == 0 else ()), *joint.before)
        joints.append(replace(joint, before=(*before, turn)))
    moved = replace(given.chain, joints=tuple(joints), tool=(there, off))
    other = free_joint(replace(given, chain=moved), "joint_2", Options(timeout=5))
    same = free_joint(given, "joint_2", Options(timeout=5))
    for verdict in Verdict:
        assert other.degrees[verdict] == pytest.approx(same.degrees[verdict], abs=0.05)


def test_a_locked_elbow_is_refused() -> None:
    """Joint 4 of an iiwa leaves an arm that is singular everywhere: one line."""
    with pytest.raises(DegenerateMapError, match="whatever the value of joint_4"):
        free_joint(robot("kuka-lbr-iiwa-14"), "joint_4")


def test_what_cannot_be_locked_is_refused() -> None:
    """No such joint, a joint that slides, and no joint to spare: one line each."""
    given = robot("barrett-wam")
    with pytest.raises(InvalidRobotError, match='no joint is named "j9"'):
        free_joint(given, "j9")
    six = replace(given, chain=lock(given.chain, {"joint_3": Angle()}))
    with pytest.raises(InvalidRobotError, match="6 joints for the task pose"):
        free_joint(six, "joint_1")
    assert lockable(six) == []
    assert len(lockable(given)) == 7
    slides = (replace(given.chain.joints[0], kind="prismatic"), *given.chain.joints[1:])
    sliding = replace(given, chain=given.chain.with_joints(slides))
    with pytest.raises(InvalidRobotError, match="slides"):
        free_joint(sliding, "joint_1")


def test_time_leaves_the_rest_open() -> None:
    """With no time the circle is open, and the result says why."""
    found = free_joint(robot("franka-panda"), "joint_3", Options(timeout=0.2))
    assert found.verdict in (Verdict.UNDECIDED, Verdict.CUSPIDAL)
    assert found.stopped is not None
    assert covers(found.stretches)
    assert sum(found.degrees.values()) == pytest.approx(360)


def test_a_position_has_structures_too() -> None:
    """Four joints for a position, two of them always parallel: noncuspidal."""
    one = Translation((Fraction(1), Fraction(0), Fraction(0)))
    square = Rotation((Fraction(1), Fraction(0), Fraction(0)), Angle(Fraction(1, 2)))
    joints = (
        Joint("a", "revolute"),
        Joint("b", "revolute", (one, square)),
        Joint("c", "revolute", (one,)),
        Joint("d", "revolute", (one, square)),
    )
    given = replace(robot("barrett-wam"), chain=Chain("four", joints, (one,)))
    found = free_joint(given, "d", Options(timeout=10))
    assert found.verdict is Verdict.NONCUSPIDAL


def test_alike_neighbours_are_joined() -> None:
    """Stretches of one verdict and one reason become one; a witness stays alone."""
    parts = WHOLE_CIRCLE.parts(4)
    rows = [Stretch(p, Verdict.NONCUSPIDAL, "structure", "same") for p in parts[:3]]
    rows.append(Stretch(parts[3], Verdict.UNDECIDED, "none", "open"))
    first, last = joined(rows)
    assert first.span.degrees == pytest.approx(270)
    assert last.verdict is Verdict.UNDECIDED


def limited(given: Robot, reach: Fraction) -> Robot:
    """The robot with limits of so many half turns to each side, for every joint."""
    pair = (Angle(-reach), Angle(reach))
    joints = [replace(joint, limits=pair) for joint in given.chain.joints]
    return replace(given, chain=given.chain.with_joints(joints))


def test_within_limits_the_range_is_covered() -> None:
    """Within limits the domain is the joint's range; noncuspidal stays noncuspidal."""
    given = limited(robot("barrett-wam"), Fraction(1, 2))
    found = free_joint(given, "joint_3", within=True)
    assert found.domain.degrees == pytest.approx(180)
    assert found.verdict is Verdict.NONCUSPIDAL


@pytest.mark.slow
def test_an_idle_lock_is_cuspidal_within_limits_only_inside_them() -> None:
    """Joint 1 of a Panda: cuspidal, and not proved so where joints turn by 1 deg."""
    tight = limited(robot("franka-panda"), Fraction(1, 180))
    [free] = free_joint(tight, "joint_1", Options(timeout=20)).stretches
    [inside] = free_joint(tight, "joint_1", Options(timeout=20), within=True).stretches
    assert free.verdict is Verdict.CUSPIDAL
    assert inside.verdict is not Verdict.CUSPIDAL


@pytest.mark.slow
def test_a_panda_is_cuspidal_at_every_value_of_joint_3() -> None:
    """The whole circle, as published; audits of single values agree."""
    given = robot("franka-panda")
    found = free_joint(given, "joint_3")
    assert found.verdict is Verdict.CUSPIDAL
    assert found.degrees[Verdict.CUSPIDAL] >= 342
    assert covers(found.stretches)
    agree(given, found, 2)


@pytest.mark.slow
def test_the_public_xarm7_is_cuspidal_and_without_its_wrist_offset_is_not() -> None:
    """Axes 6 and 7 stand 76 mm apart; where they meet it is as published."""
    given = robot("ufactory-xarm7")
    found = free_joint(given, "joint_3")
    assert found.verdict is Verdict.CUSPIDAL
    assert found.degrees[Verdict.CUSPIDAL] >= 342
    last = given.chain.joints[-1]
    still = tuple(m for m in last.before if not isinstance(m, Translation))
    joints = (*given.chain.joints[:-1], replace(last, before=still))
    other = replace(given, chain=given.chain.with_joints(joints))
    assert free_joint(other, "joint_3").verdict is Verdict.NONCUSPIDAL


def agree(given: Robot, found: FreeJoint, count: int) -> None:
    """Hold stretches to the ordinary audit of the arm locked at random values."""
    rng = random.Random(1)
    for _ in range(count):
        value = Fraction(rng.randrange(-3100, 3100), 1000)
        stretch = found.at(float(value))
        assert stretch is not None
        held = lock(given.chain, {found.joint: Angle(radians=value)})
        audited = audit(replace(given, chain=held), Options(timeout=30))
        if stretch.verdict is not Verdict.UNDECIDED:
            assert audited.answer.verdict is stretch.verdict
