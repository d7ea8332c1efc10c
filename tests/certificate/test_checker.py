from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from certified_arms import (
    ARMS,
    certify,
    crx,
    det,
    divided,
    excursion,
    from_dh,
    issac,
    middle,
    moved,
    rebuilt,
    sliding,
    through,
    with_offset,
)
from hypothesis import given, settings
from hypothesis import strategies as st

from cuspaudit.certificate import (
    CertifiedJoint,
    Motion,
    PathCertificate,
    Rotate,
    Translate,
    verify,
)

TWO_PI = Fraction("6.28318530717958647692528676655900576839433879875021164194989")
tenths = st.integers(-30, 30).map(lambda n: Fraction(n, 10))
vectors = st.tuples(tenths, tenths, tenths)
rotations = st.builds(Rotate, vectors.filter(any), tenths, tenths)
motions = st.one_of(st.builds(Translate, vectors), rotations)


def reason_against(arm: PathCertificate) -> str:
    """Why the certificate is refused."""
    result = verify(arm)
    assert not result.accepted
    assert result.smallest is None
    assert "\n" not in result.reason
    return result.reason


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("pieces", [1, 20])
def test_true_certificates_are_accepted(
    name: str, pieces: int, certified: dict[str, PathCertificate]
) -> None:
    """The nonsingular couples of the literature are proved, as one segment or many."""
    arm = certified[name]
    result = verify(divided(arm, pieces))
    assert result.accepted, result.reason
    assert result.bits == 128
    assert result.boxes >= pieces
    assert result.radius is not None and result.radius < 1e-12
    assert result.smallest is not None
    assert 0 < result.smallest < arm.sign * det(arm, arm.postures[0])
    assert f"{pieces} segment" in result.reason


# --- each falsification


@pytest.mark.parametrize("make", [issac, sliding, crx])
def test_the_other_sign_is_refused(make: Any) -> None:
    """Det J has the sign that it has."""
    arm = make()
    reason = reason_against(replace(arm, sign=-arm.sign))
    assert "opposite sign" in reason


@pytest.mark.parametrize(
    ("make", "seed"),
    [*((make, seed) for make in (issac, sliding) for seed in range(4)), (crx, 0)],
)
def test_an_excursion_across_a_singularity_is_refused_however_short(
    make: Any, seed: int
) -> None:
    """1e-9 before the singularity the way point is proved, 1e-9 beyond it refused."""
    arm, hair = make(), Fraction(1, 10**9)
    direction = np.random.default_rng(seed).normal(size=len(arm.joints))
    before = verify(excursion(arm, direction, -hair))
    assert before.accepted, before.reason
    assert before.smallest is not None and before.smallest < 1e-7
    reason = reason_against(excursion(arm, direction, hair))
    assert "opposite sign at s = " in reason
    assert "segment 2 of 4" in reason or "segment 3 of 4" in reason


@pytest.mark.parametrize("make", [issac, sliding, crx])
def test_a_way_through_the_other_aspect_is_refused(make: Any) -> None:
    """Straight to a posture of the opposite sign and straight back is no path."""
    arm = make()
    rng = np.random.default_rng(0)
    while True:
        there = rng.uniform(-2, 2, len(arm.joints))
        if arm.sign * det(arm, there) < -1e-4:
            break
    reason = reason_against(through(arm, [Fraction(x) for x in there]))
    assert "opposite sign" in reason


def test_a_jump_over_a_singularity_between_two_way_points_is_refused() -> None:
    """Both ends of each segment are fine, what lies between them is not."""
    arm = issac()
    first = arm.postures[0]
    round_trip = through(arm, (first[0], first[1], first[2] + TWO_PI), first)
    assert det(arm, round_trip.path[1]) * det(arm, first) > 0
    assert "segment 1 of 3" in reason_against(round_trip)


def test_a_path_that_touches_a_singularity_is_refused() -> None:
    """The same arm and couple, but a detour that touches {det J = 0} in one point."""
    arm = with_offset()
    turn = TWO_PI / 4
    postures = tuple((a, b - turn, c) for a, b, c in arm.postures)
    arm = replace(arm, postures=postures, path=postures)
    assert verify(arm).accepted
    here = (Fraction(0), Fraction(-1, 10), Fraction(1, 10))
    there = (Fraction(0), Fraction(3, 10), Fraction(-3, 10))
    reason = reason_against(through(arm, middle(arm), here, there))
    assert "segment" in reason


@pytest.mark.parametrize("make", [issac, sliding, crx])
@pytest.mark.parametrize("index", [0, 1])
@pytest.mark.parametrize("joint", range(3))
def test_a_posture_moved_by_a_thousandth_is_refused(
    make: Any, index: int, joint: int
) -> None:
    """With the path's end moved along, or without, in every joint."""
    arm = make()
    with_path = moved(arm, index, joint, Fraction(1, 1000))
    assert "no true posture" in reason_against(with_path)
    without = replace(with_path, path=arm.path)
    assert "the path does not" in reason_against(without)


@pytest.mark.parametrize("name", ["issac", "sliding", "jaco_gen2", "raghavan_roth"])
def test_a_robot_altered_in_the_sixth_digit_is_refused(
    name: str, certified: dict[str, PathCertificate]
) -> None:
    """Every length and twist that matters, changed by 1 in its sixth digit."""
    arm = certified[name]
    changes = 0
    for index, joint in enumerate(arm.joints):
        for place, motion in enumerate(joint.before):
            if index == 1 and place < len(joint.before) - 2 and name != "sliding":
                continue  # along the first axis: d1 alters no difference of poses
            altered = _altered(motion)
            if altered is not None:
                changes += 1
                reason = reason_against(rebuilt(arm, index, place, altered))
                assert "no true posture" in reason
    assert changes >= 5


def _altered(motion: Motion) -> Motion | None:
    """The motion with its number changed in the sixth digit; None if it is 0."""
    more = 1 + Fraction(1, 10**5)
    if isinstance(motion, Translate):
        if not any(motion.vector):
            return None
        x, y, z = (entry * more for entry in motion.vector)
        return Translate((x, y, z))
    if not motion.half_turns:
        return None
    return replace(motion, half_turns=motion.half_turns * more)


@pytest.mark.parametrize("make", [issac, sliding, crx])
def test_equal_postures_are_refused(make: Any) -> None:
    """One posture twice is no couple, nor are two postures that differ by turns."""
    arm = make()
    first = arm.postures[0]
    same = replace(arm, postures=(first, first), path=(first, first))
    assert "the same" in reason_against(same)
    for joint in (0, 2):
        if arm.joints[joint].kind == "revolute":
            for turns in (1, -3):
                turned = moved(same, 1, joint, turns * TWO_PI)
                assert "the same" in reason_against(turned)


def test_a_slide_by_two_pi_is_no_full_turn() -> None:
    """For a sliding joint only equal values are the same."""
    arm = sliding()
    assert "no true posture" in reason_against(
        moved(replace(arm, postures=arm.postures[:1] * 2), 1, 1, TWO_PI)
    )


@pytest.mark.parametrize("make", [issac, crx])
def test_a_wrong_winding_is_refused(make: Any) -> None:
    """A path that ends a full turn away from the second posture ends elsewhere."""
    arm = make()
    second = arm.postures[1]
    for joint in range(len(second)):
        last = list(second)
        last[joint] += TWO_PI
        reason = reason_against(replace(arm, path=(arm.path[0], tuple(last))))
        assert "does not end at the second posture" in reason


def test_the_straight_way_to_another_turn_is_another_way() -> None:
    """The same couple a turn of joint 3 apart: the straight segment is singular."""
    arm = issac()
    assert "opposite sign" in reason_against(moved(arm, 1, 2, TWO_PI))


def test_a_couple_of_opposite_signs_is_refused() -> None:
    """Two true postures of one pose in different aspects prove nothing."""
    robot = from_dh([1, 2, 1.5], [0, 1, 0], [-90, 90, 0])
    arm = certify(
        "issac",
        robot,
        [-2.8852048972, -2.9963502969, -0.2465089356],
        [-1.7799857728, -2.8236320365, 1.8411895544],
    )
    assert "opposite sign at the second posture" in reason_against(arm)


def test_a_slide_makes_postures_distinct() -> None:
    """Two postures may differ in a sliding joint: step 3 holds, step 5 does not."""
    one, zero = Fraction(1), Fraction(0)
    axes = {"lift": (zero, zero, one), "slide": (one, zero, zero)}
    joints = [CertifiedJoint(name, "prismatic", axis) for name, axis in axes.items()]
    joints.append(CertifiedJoint("turn", "revolute", (zero, zero, one)))
    tool = (Translate((one, zero, zero)),)
    angle = math.pi / 3
    first, second = [0, 0, angle], [0, 2 * math.cos(angle), math.pi - angle]
    arm = certify("gantry", (tuple(joints), tool), first, second)
    assert "opposite sign at the second posture" in reason_against(arm)


def test_numbers_out_of_all_proportion_are_refused(arm3: PathCertificate) -> None:
    """A value of 300 digits costs no more than some precision."""
    far = moved(arm3, 1, 1, Fraction(10) ** 300)
    assert "no true posture" in reason_against(far)
    large = through(arm3, (Fraction(0), Fraction(10) ** 390, Fraction(0)))
    assert "segment 1 of 2" in reason_against(large)


# --- what changes nothing


@settings(max_examples=10, deadline=None)
@given(st.sampled_from([issac, sliding, crx]), st.lists(motions, max_size=3))
def test_where_the_base_stands_changes_nothing(make: Any, base: list[Motion]) -> None:
    """A transform before the first joint keeps the acceptance."""
    arm = make()
    first, *others = arm.joints
    first = replace(first, before=(*base, *first.before))
    assert verify(replace(arm, joints=(first, *others))).accepted


@settings(max_examples=10, deadline=None)
@given(st.sampled_from([issac, sliding]), rotations)
def test_turning_the_tool_changes_no_position(make: Any, tool: Rotate) -> None:
    """The task is the position of the tip, so its orientation plays no part."""
    arm = make()
    assert verify(replace(arm, tool=(*arm.tool, tool))).accepted


@settings(max_examples=10, deadline=None)
@given(st.lists(motions, max_size=3))
def test_the_tool_changes_no_pose(tool: list[Motion]) -> None:
    """For the pose task any tool will do."""
    arm = crx()
    assert verify(replace(arm, tool=(*arm.tool, *tool))).accepted


@settings(max_examples=10, deadline=None)
@given(
    st.sampled_from([issac, crx]), st.fractions(Fraction(1, 1000), 1000), st.booleans()
)
def test_the_unit_of_length_changes_nothing(
    make: Any, factor: Fraction, mirrored: bool
) -> None:
    """All lengths scaled, and the angles' sense reversed: accepted, det J scaled."""
    arm = make()
    scaled = replace(
        arm,
        joints=tuple(
            replace(joint, before=_scaled(joint.before, factor)) for joint in arm.joints
        ),
        tool=_scaled(arm.tool, factor),
    )
    if mirrored:  # turn about the opposite axes by the opposite angles
        negated = [tuple(-x for x in row) for row in scaled.postures]
        scaled = replace(
            scaled,
            joints=tuple(
                replace(joint, axis=tuple(-x for x in joint.axis))
                for joint in scaled.joints
            ),
            sign=arm.sign * (-1) ** len(arm.joints),
            postures=tuple(negated),
            path=tuple(negated),
        )
    result = verify(scaled)
    assert result.accepted, result.reason
    assert result.smallest == pytest.approx(
        verify(arm).smallest * float(factor) ** 3, rel=1e-6
    )


def _scaled(motions: tuple[Motion, ...], factor: Fraction) -> tuple[Motion, ...]:
    return tuple(
        Translate(tuple(factor * x for x in motion.vector))
        if isinstance(motion, Translate)
        else motion
        for motion in motions
    )
