from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from certified_arms import X, Z, from_dh, kinematics, translate
from hypothesis import given
from hypothesis import strategies as st
from structured_arms import (
    CORNERS,
    ELBOW,
    WRIST,
    Y,
    by_other_words,
    palletizer,
    puma,
    relation,
    scara,
    some_structures,
    structure,
)

from cuspaudit.certificate import (
    CertifiedJoint,
    Relation,
    Rotate,
    StructureCertificate,
    Translate,
    certificate_from_text,
    check_certificate,
    text_from_certificate,
    verify,
)
from cuspaudit.certificate.structure.theorems import THEOREMS
from cuspaudit.errors import InvalidCertificateError

TRUE = some_structures()


def reason_against(claim: StructureCertificate) -> str:
    """Why the certificate is refused."""
    result = verify(claim)
    assert not result.accepted
    assert result.smallest is None
    return result.reason


@pytest.mark.parametrize("name", TRUE)
def test_true_structures_are_accepted(name: str) -> None:
    """An arm of every theorem, also after a way through its file."""
    claim = certificate_from_text(text_from_certificate(TRUE[name]))
    assert claim == TRUE[name]
    result = verify(claim)
    assert result.accepted, result.reason
    assert result.claim == "noncuspidal"
    assert result.smallest is not None and result.smallest > 1e-4
    assert result.reason.startswith("noncuspidal: ax")


def test_every_theorem_is_met() -> None:
    """The arms of these tests have all theorems among them."""
    assert {claim.theorem for claim in TRUE.values()} == set(THEOREMS)


@pytest.mark.parametrize("name", TRUE)
def test_a_hair_breaks_every_relation(name: str) -> None:
    """Turned or moved by 1e-30 somewhere, the arm has lost its relation."""
    claim, hair = TRUE[name], Fraction(1, 10**30)
    turn = Rotate((Fraction(1), Fraction(2), Fraction(2)), radians=hair)
    step = Translate((hair, 3 * hair, 2 * hair))
    refused = 0
    for index in range(1, len(claim.joints)):
        for motion in (turn, step):
            joints = list(claim.joints)
            before = (motion, *joints[index].before)
            joints[index] = replace(joints[index], before=before)
            result = verify(replace(claim, joints=tuple(joints)))
            refused += not result.accepted
            assert result.accepted or "not proved" in result.reason
    assert refused >= 1


@pytest.mark.parametrize("name", TRUE)
def test_relations_must_be_those_of_the_theorem(name: str) -> None:
    """One missing, one doubled, one more that holds: the theorem is not applied."""
    claim = TRUE[name]
    extra = relation("square", 1, 2)
    for relations in (
        claim.relations[1:],
        (*claim.relations, claim.relations[0]),
        (*claim.relations, extra, extra),
    ):
        reason = reason_against(replace(claim, relations=relations))
        assert "not those that the theorem needs" in reason


@pytest.mark.parametrize("theorem", THEOREMS)
def test_no_theorem_takes_the_relations_of_another(theorem: str) -> None:
    """The relations of others do not do, but for a point and a pair that two share."""
    shared = ("wrist", "wrist by a pair", "shoulder", "cancelling turns")
    for name, claim in TRUE.items():
        if claim.theorem == theorem or name in shared:
            continue
        assert not verify(replace(claim, theorem=theorem)).accepted, name


def test_an_unknown_theorem_proves_nothing() -> None:
    """A name that is not in the list is not taken on trust."""
    reason = reason_against(replace(TRUE["wrist"], theorem="a new one"))
    assert "no theorem of this name" in reason


def test_a_pair_of_meeting_axes_is_not_parallel_and_not_the_reverse() -> None:
    """The word must be the right one: parallel axes do not meet."""
    claim = structure(puma(), "spherical wrist", WRIST, relation("meeting", 2, 3))
    assert "axes 2 and 3 meet" in reason_against(claim)
    level = replace(TRUE["crossing"], relations=(relation("parallel", 1, 2),))
    assert "axes 1 and 2 are parallel" in reason_against(level)


def test_a_wrist_whose_axes_meet_in_two_points_is_refused() -> None:
    """Axes 4 and 5 meet, 5 and 6 meet, a millimetre apart on axis 5."""
    joints, tool = puma()
    apart = (translate(0, 0, 0.001), *joints[5].before)
    joints = (*joints[:5], replace(joints[5], before=apart))
    claim = structure((joints, tool), "spherical wrist", WRIST, ELBOW)
    assert "axes 4, 5 and 6 meet" in reason_against(claim)


def test_turns_about_one_axis_cancel_only_when_they_do() -> None:
    """0.6 - 0.3 - 0.3 leaves parallel axes, 0.6 - 0.3 - 0.3000001 does not."""
    step = translate(0.4, 0, 0)

    def arm(last: str) -> StructureCertificate:
        turns = [Rotate(X, radians=Fraction(r)) for r in ("0.6", "-0.3", last)]
        robot = by_other_words(turns[0], step, *turns[1:])
        return structure(robot, "spherical wrist", WRIST, ELBOW)

    assert verify(arm("-0.3")).accepted
    assert "parallel" in reason_against(arm("-0.3000001"))


def test_half_angles_of_any_size_cancel() -> None:
    """Pi/7 is no angle of the field of the proof, and still undoes itself."""
    turns = [Rotate(Y, Fraction(k, 7)) for k in (1, 1, -2)]
    robot = by_other_words(turns[0], translate(0.4, 0, 0), *turns[1:])
    assert verify(structure(robot, "spherical wrist", WRIST, ELBOW)).accepted


def test_skew_rotation_axes_of_irrational_length() -> None:
    """The root of 3 is exact; of 5 it is not, but a half turn needs none."""
    for vector, half_turns, accepted in (
        ((1, 1, 1), "2/3", True),
        ((1, 1, 0), "1", True),
        ((1, 2, 0), "1", True),
        ((1, 2, 0), "1/2", False),
    ):
        x, y, z = map(Fraction, vector)
        there = Rotate((x, y, z), Fraction(half_turns))
        back = Rotate((x, y, z), -Fraction(half_turns))
        robot = by_other_words(there, translate(0.4, 0, 0), back)
        claim = structure(robot, "spherical wrist", WRIST, ELBOW)
        assert verify(claim).accepted == accepted, vector
        if not accepted:
            assert "root" in reason_against(claim)


def test_an_arm_that_is_singular_everywhere_has_no_theorem() -> None:
    """Axes 5 and 6 are one line: no posture is regular, whichever is named."""
    robot = from_dh([0, 1, 0, 0, 0, 0], [0, 0, 0, 1, 0, 0], [90, 0, 90, 90, 0, 0])
    claim = structure(robot, "triple and pair", ELBOW, relation("meeting", 4, 5, 6))
    assert not verify(claim).accepted
    claim = structure(
        robot,
        "triple and pair",
        relation("parallel", 5, 6),
        relation("parallel", 2, 3, 4),
    )
    assert not verify(claim).accepted
    singular = replace(TRUE["wrist"], regular=(Fraction(0),) * 6)
    assert "regular posture" in reason_against(singular)


def test_slides_are_no_axes_of_a_theorem() -> None:
    """A slide in the wrist, or in the pair, refuses the theorem."""
    for index in (1, 4):
        joints, tool = puma()
        slide = replace(joints[index], kind="prismatic")
        joints = (*joints[:index], slide, *joints[index + 1 :])
        claim = structure((joints, tool), "spherical wrist", WRIST, ELBOW)
        assert "relations" in reason_against(claim)


@pytest.mark.parametrize("robot", [scara(), palletizer()])
def test_four_joints_have_the_determinant_of_position_and_angle(robot: Any) -> None:
    """The bound at the regular posture is that of floats."""
    claim = next(c for c in TRUE.values() if c.joints == robot[0])
    J = kinematics(claim, claim.regular)[1]  # type: ignore[arg-type]
    turning = [k for k, j in enumerate(claim.joints) if j.kind == "revolute"]
    along = J[3:, turning[-1]]
    expected = np.linalg.det(np.vstack([J[:3], along @ J[3:]]))
    assert verify(claim).smallest == pytest.approx(abs(expected), rel=1e-9)


@given(st.permutations(range(7)))
def test_the_order_of_relations_is_free(order: Sequence[int]) -> None:
    """A list of relations is a set."""
    claim = TRUE["universal"]
    relations = tuple(claim.relations[k] for k in order)
    assert verify(replace(claim, relations=relations)).accepted


@pytest.mark.parametrize(
    "relations",
    [
        (Relation((), "parallel"),),
        (Relation((0, 1), "parallel"),),
        (Relation((6, 7), "parallel"),),
        (Relation((3, 2), "parallel"),),
        (Relation((2, 2), "parallel"),),
        (Relation((2, 3), "crossing"),),  # type: ignore[arg-type]
    ],
)
def test_relations_are_held_to_their_form(relations: Any) -> None:
    """Numbers of axes that are there, increasing, and one of three words."""
    with pytest.raises(InvalidCertificateError, match=r"relations\[0\]"):
        check_certificate(replace(TRUE["wrist"], relations=relations))


def test_a_path_is_of_another_task_than_position_and_angle(arm3: Any) -> None:
    """No path certificate of four joints is read."""
    fourth = CertifiedJoint("fourth", "revolute", Z, ())
    first = (*arm3.postures[0], Fraction(0))
    claim = replace(
        arm3,
        task="position-and-angle",
        joints=(*arm3.joints, fourth),
        postures=(first, first),
        path=(first, first),
    )
    with pytest.raises(InvalidCertificateError, match="another task"):
        check_certificate(claim)


def test_corners_are_all_needed() -> None:
    """Each of the UR pattern's six relations at corners is asked for."""
    for left_out in CORNERS:
        rest = tuple(r for r in TRUE["universal"].relations if r != left_out)
        reason = reason_against(replace(TRUE["universal"], relations=rest))
        assert "needs" in reason
