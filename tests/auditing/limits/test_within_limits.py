"""The verdict within joint limits: which ground is found, and what the record says."""

from __future__ import annotations

import json
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from short_tables import arm, degrees, with_wrist

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.proofs.certificates import certificate_text
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.certificate import certificate_from_text, verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.place import Place
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.task import check_limits

ISSAC = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
SCHEMA = json.loads(files("cuspaudit.auditing").joinpath("schema.json").read_text())
LONG = [pytest.param(ends, marks=pytest.mark.slow) for ends in [(-95, 95), (0, 800)]]
#: joints 2 and 3 of ISSAC: with a cusp inside, and without any couple
CUSP = ((-170, 170), (-170, 170), (-170, 170))
SMALL = ((-170, 170), (-20, 20), (-20, 20))


def limited(chain: Chain, limits: tuple[tuple[int, int] | None, ...]) -> Robot:
    """The chain as a robot, its first joints limited, in degrees."""
    joints = list(chain.joints)
    for k, pair in enumerate(limits):
        ends = None if pair is None else (degrees(pair[0]), degrees(pair[1]))
        joints[k] = replace(joints[k], limits=ends)
    return Robot(name="arm", chain=chain.with_joints(joints), file="arm.yaml")


def checked(found: FinishedAudit) -> dict[str, object]:
    """The key ``limits`` of its JSON, held to the schema."""
    record = json.loads(json.dumps(found.record(), allow_nan=False))
    jsonschema.validate(record, SCHEMA)
    limits: dict[str, object] = record["limits"]
    return limits


def test_an_arm_without_limits_has_no_verdict_within_them() -> None:
    """The key is null."""
    assert checked(audit(limited(ISSAC, (None, None, None)))) is None


def test_a_cusp_inside_makes_it_cuspidal() -> None:
    """With a path round it that keeps inside, and a certificate that says so."""
    found = audit(limited(ISSAC, CUSP))
    record = checked(found)
    assert (record["verdict"], record["aspects"]) == (
        "cuspidal",
        {"count": 5, "proved": True},
    )
    witness = record["witness"]
    assert isinstance(witness, dict)
    assert witness["slack"] > 0
    assert np.abs(witness["path"]).max() < np.radians(170)
    text = certificate_text(found, within=True)
    assert text is not None
    certificate = certificate_from_text(text)
    assert certificate.limits is not None
    assert verify(certificate).accepted


def test_a_small_box_is_noncuspidal_exactly() -> None:
    """The arm is cuspidal, its box is not: two verdicts side by side."""
    found = audit(limited(ISSAC, SMALL))
    record = checked(found)
    assert found.verdict is Verdict.CUSPIDAL
    assert record["verdict"] == "noncuspidal"
    assert record["proof"] == {
        "kind": "exact",
        "rests_on": ["FLINT resultants", "FLINT root isolation", "ball arithmetic"],
    }
    free = record["of_the_free_witness"]
    assert isinstance(free, dict)
    assert free["inside"] is False
    assert "joint_" in free["leaves"]
    assert "limit" in free["leaves"]


def test_monotony_settles_a_noncuspidal_arm() -> None:
    """Noncuspidal without limits is noncuspidal within any; aspects are counted."""
    found = audit(limited(arm((1, ".5", ".8"), (0, ".2", 0), (-90, 90, 0)), CUSP))
    record = checked(found)
    assert found.verdict is Verdict.NONCUSPIDAL
    assert record["verdict"] == "noncuspidal"
    assert isinstance(record["proof"], dict)
    assert record["proof"]["kind"] == "monotony"


@pytest.mark.slow
def test_a_wrist_follows_its_three_joints() -> None:
    """Noncuspidal within the limits of the first three joints: so is the arm."""
    found = audit(limited(with_wrist(ISSAC), SMALL))
    record = checked(found)
    assert found.verdict is Verdict.CUSPIDAL
    assert record["verdict"] == "noncuspidal"
    assert isinstance(record["proof"], dict)
    assert record["proof"]["kind"] == "reduction"


def test_a_second_joint_that_slides_is_decided_by_values() -> None:
    """Where pairs cannot be taken, sample values decide."""
    chain = arm((1, 1, 1), (0, 0, "1/2"), (-90, 60, 0), "RPR")
    joints = list(chain.joints)
    from fractions import Fraction

    joints[1] = replace(joints[1], limits=(Fraction(-1), Fraction(2)))
    joints[2] = replace(joints[2], limits=(degrees(-100), degrees(150)))
    robot = Robot(name="arm", chain=chain.with_joints(joints), file="arm.yaml")
    found = audit(robot)
    record = checked(found)
    if found.verdict is Verdict.NONCUSPIDAL:
        assert record["verdict"] == "noncuspidal"
    else:
        assert record["verdict"] in ("cuspidal", "noncuspidal")


def test_equal_limits_count_as_none(tmp_path: Path) -> None:
    """A placeholder takes no motion away."""
    assert checked(audit(limited(ISSAC, ((5, 5), None, (0, 0))))) is None


@pytest.mark.parametrize("ends", [(-1, 1), *LONG])
def test_limits_of_the_first_joint_alone_keep_a_cusp(ends: tuple[int, int]) -> None:
    """T2: whatever the range of joint 1, a cusp stays inside."""
    record = checked(audit(limited(ISSAC, (ends, None, None))))
    assert record["verdict"] == "cuspidal"


def test_one_range_for_all_joints_is_remarked() -> None:
    """Exporters fill in half a turn each way: the note says so, the verdict stands."""
    joints = [
        replace(joint, limits=(degrees(-180), degrees(180))) for joint in ISSAC.joints
    ]
    [note] = check_limits(ISSAC.with_joints(joints), Place("arm.urdf"))
    assert "exporter's default" in note
    joints[0] = replace(joints[0], limits=(degrees(-170), degrees(180)))
    assert check_limits(ISSAC.with_joints(joints), Place("arm.urdf")) == []


def test_a_direction_that_no_ball_holds_is_no_error() -> None:
    """Where a zero of det J has every angle at once, more bits are asked for."""
    record = audit(open_robot("finger_edu")).record()
    assert record["limits"]["verdict"] == record["verdict"] == "noncuspidal"
