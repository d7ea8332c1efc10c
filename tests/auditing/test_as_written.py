from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from reexport import reexported
from short_tables import arm

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.certificate import verify
from cuspaudit.robot.chain import Angle, Chain, Rotation
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snap_policy import NO_SNAPPING


def rounded(chain: Chain, decimals: int) -> Chain:
    """The chain with pi/2 printed with so many decimals."""
    printed = Angle(radians=Fraction(f"{1.5707963267948966:.{decimals}f}"))
    joints = []
    for joint in chain.joints:
        before = tuple(
            replace(m, angle=printed if m.angle.half_turns > 0 else -printed)
            if isinstance(m, Rotation) and m.angle.half_turns.denominator == 2
            else m
            for m in joint.before
        )
        joints.append(replace(joint, before=before))
    return chain.with_joints(joints)


def test_one_path_is_proved_for_both_models() -> None:
    """The paper's arm with pi/2 as 1.5708: its path is one of these numbers too."""
    chain = rounded(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)), 4)
    found = audit(Robot("rough", "rough.yaml", chain))
    record = found.record()
    assert record["models"] == {"literal": "cuspidal", "snapped": "cuspidal"}
    assert record["proof"]["model"] == "snapped"
    assert record["witness"]["model"] == "literal"
    assert record["literal_witness"] is None
    for witness in (found.as_written.witness, found.answer.witness):
        assert witness is not None and verify(witness.certificate).accepted
    assert found.as_written.witness is not None and found.answer.witness is not None
    assert found.as_written.witness.chain != found.answer.witness.chain


def test_a_certificate_of_the_file_is_no_proof_of_the_snapped_arm() -> None:
    """Axes 2 and 3 parallel but for a print of pi/2: cuspidal as written alone."""
    chain = rounded(arm(("1/20", 1, "9/10"), (0, "3/10", 0), (-90, 0, 0), "RRR"), 4)
    turn = Rotation(chain.joints[1].before[-1].axis, Angle(Fraction(-1, 2)))  # type: ignore[union-attr]
    back = Rotation(turn.axis, Angle(radians=Fraction("1.57")))
    third = chain.joints[2]
    joints = (*chain.joints[:2], replace(third, before=(*third.before, turn, back)))
    record = audit(Robot("hair", "hair.yaml", chain.with_joints(joints))).record()
    assert record["models"] == {"literal": "cuspidal", "snapped": "noncuspidal"}
    assert record["witness"] is None
    assert record["literal_witness"]["model"] == "literal"
    assert record["aspects"] == {"count": 4, "proved": True}


@pytest.mark.parametrize("digits", [17, 6])
def test_the_noise_of_doubles_is_not_searched(digits: int, tmp_path: Path) -> None:
    """At 17 digits no path is wide enough for a certificate; nothing is claimed."""
    chain = arm(("1/20", 1, "9/10"), (0, "3/10", 0), (-90, 0, 0), "RRR")
    other = reexported(chain, digits, 3, tmp_path)
    record = audit(Robot("cad", "cad.urdf", other)).record()
    assert record["verdict"] == "noncuspidal"
    assert record["proof"]["model"] == "snapped"
    assert record["robot"]["exact"] is True
    if digits == 17:
        assert record["models"]["literal"] == "undecided"


def test_without_snapping_the_numbers_stand_for_themselves(tmp_path: Path) -> None:
    """`--snap none` of a CAD file says nothing that its numbers do not carry."""
    chain = arm(("1/20", 1, "9/10"), (0, "3/10", 0), (-90, 0, 0), "RRR")
    other = reexported(chain, 17, 3, tmp_path)
    record = audit(Robot("cad", "c.urdf", other), Options(snap=NO_SNAPPING)).record()
    assert record["robot"]["snapped"] == []
    proved = [record["aspects"]["proved"], record["postures"]["proved"]]
    assert record["robot"]["exact"] or not any(proved)
    if record["verdict"] == "noncuspidal":
        assert record["proof"]["model"] == "near"
