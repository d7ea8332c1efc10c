"""How much must be cut: bracketed, each end proved."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from joint_boxes import within
from short_tables import arm, degrees, with_wrist

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.limits.limit_cuts import cuts_of, limit_cuts
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.robot import Robot
from cuspaudit.runtime.clock import Clock

ISSAC = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))


def limited(low: int, high: int) -> Chain:
    """The arm with a range of joint 2."""
    joints = list(ISSAC.joints)
    joints[1] = replace(joints[1], limits=(degrees(low), degrees(high)))
    return ISSAC.with_joints(joints)


@pytest.mark.slow
def test_the_bracket_holds_by_another_question() -> None:
    """Both ends are what the box decision says of the range that they stand for."""
    [cut] = limit_cuts(exact_model(limited(-150, 170)), 0, Clock())
    assert cut.joint == "joint_2"
    assert cut.noncuspidal_to is not None
    assert 0 < cut.noncuspidal_to < cut.cuspidal_from < 1
    for scale, verdict in (
        (cut.noncuspidal_to, Verdict.NONCUSPIDAL),
        (cut.cuspidal_from, Verdict.CUSPIDAL),
    ):
        half = 160 * Fraction(scale)
        ends = (None, (10 - half, 10 + half), None)
        assert within(ISSAC, ends).verdict is verdict


def test_only_cuspidal_arms_are_cut() -> None:
    """A noncuspidal box has nothing to cut, nor has an arm without limits."""
    small = Robot("arm", "arm.yaml", limited(-20, 20))
    assert cuts_of(audit(small)) is None
    assert cuts_of(audit(Robot("arm", "arm.yaml", ISSAC))) is None


@pytest.mark.slow
def test_a_wrist_proves_the_lower_end() -> None:
    """Six joints: a cusp from above, the three joints before the wrist from below."""
    six = with_wrist(ISSAC)
    joints = list(six.joints)
    joints[1] = replace(joints[1], limits=(degrees(-150), degrees(170)))
    [cut] = limit_cuts(exact_model(six.with_joints(joints)), 0, Clock())
    assert cut.joint == "joint_2"
    assert cut.noncuspidal_to is not None
    assert 0 < cut.noncuspidal_to < cut.cuspidal_from < 1
