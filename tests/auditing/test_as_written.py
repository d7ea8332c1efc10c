from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from reexport import reexported
from short_tables import arm, with_wrist

from cuspaudit.auditing.as_written import as_written
from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.auditing.options import Options
from cuspaudit.certificate import verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Angle, Chain, Rotation
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snap_policy import NO_SNAPPING
from cuspaudit.robot.snapping import Snapped
from cuspaudit.runtime.clock import Clock


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


def hairy_wrist() -> Chain:
    """A six-joint arm whose wrist is spherical but for 3e-4 of its arm."""
    return arm(
        (1, 2, "3/2", 0, "3/10000", 0),
        (0, 1, 0, 1, 0, "1/5"),
        (-90, 90, 90, -90, 90, 0),
    )


def test_a_cusp_decides_where_no_path_is_wide_enough(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Numbers by a hair off a structure: without a path a proved cusp says cuspidal."""
    monkeypatch.setattr("cuspaudit.auditing.as_written._searched", lambda *_: None)
    literal = rounded(hairy_wrist(), 5)
    near = answer(exact_model(with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)))))
    near = replace(near, witness=None)
    far = [Snapped("joint_5 a", 3e-4, "0", -3e-4)]
    found = as_written(literal, near, far, 0, Clock())
    assert found.verdict is Verdict.CUSPIDAL
    assert found.witness is None
    assert found.cusp is not None
    assert verify(found.cusp.certificate).accepted
    assert found.cusp.chain == literal
    assert "by a cusp" in (found.cusp_sentence or "")
