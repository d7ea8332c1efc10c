from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import jsonschema
import pytest

import cuspaudit
from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.certificate import certificate_from_text, text_from_certificate, verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, InvalidCertificateError
from cuspaudit.pictures.page import page_text
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot


@pytest.fixture(scope="module")
def five() -> FinishedAudit:
    """The ISSAC arm with a symmetric tool on two more joints, audited."""
    return audit(open_robot("chablat-2022-5r"))


def test_the_record_speaks_of_the_robots_own_joints(five: FinishedAudit) -> None:
    """Five joints; both postures hold the tip in one place, its z axis the same way."""
    record = five.record()
    schema = Path(cuspaudit.__file__).parent / "auditing" / "schema.json"
    jsonschema.validate(record, json.loads(schema.read_text()))
    assert record["robot"]["joints"] == len(record["robot"]["joint_names"]) == 5
    assert record["robot"]["task"] == "position-and-z-axis"
    assert {len(row) for row in record["witness"]["path"]} == {5}
    first, second = (
        frames(five.robot.chain, posture)[-1]
        for posture in record["witness"]["postures"]
    )
    assert first[:3, 2:] == pytest.approx(second[:3, 2:], abs=1e-9)
    assert first[:3, 0] != pytest.approx(second[:3, 0], abs=1e-3)


def test_the_page_shows_the_robots_own_joints(five: FinishedAudit) -> None:
    """The virtual joint is not drawn; what is claimed of the tool is said."""
    page = page_text(five.record(), five)
    assert "position with its z axis in the same direction" in page
    assert "joint_5" in page
    assert "joint_6" not in page


def test_the_certificate_names_its_virtual_joint(five: FinishedAudit) -> None:
    """It is proved from its text alone, and refused with a tool beyond that joint."""
    assert five.witness is not None
    claim = certificate_from_text(text_from_certificate(five.witness.certificate))
    result = verify(claim)
    assert result.accepted
    assert "the last joint, tool axis, is virtual" in result.reason
    for broken, said in (
        (replace(claim, tool=claim.joints[0].before or claim.joints[1].before), "tool"),
        (replace(claim, joints=claim.joints[:5]), "takes 6"),
        (
            replace(
                claim,
                joints=(*claim.joints[:5], replace(claim.joints[5], kind="prismatic")),
            ),
            "turns about",
        ),
    ):
        with pytest.raises(InvalidCertificateError, match=said):
            verify(broken)


def test_a_last_joint_that_is_the_tool_axis_is_told(five: FinishedAudit) -> None:
    """A joint that turns about the tool axis moves nothing of the task."""
    robot = five.robot
    with pytest.raises(DegenerateMapError, match="joint_5 turns about the tool axis"):
        audit(replace(robot, chain=replace(robot.chain, tool=())))


@pytest.mark.slow
def test_a_cobot_with_a_symmetric_tool_stays_cuspidal() -> None:
    """The CRX-10iA/L without its last joint, which never enters det J."""
    six = open_robot("fanuc-crx-10ia-l")
    *joints, last = six.chain.joints
    tool = (*last.before, *six.chain.tool)
    chain: Chain = replace(
        six.chain, joints=tuple(joints), tool=tool, task="position-and-z-axis"
    )
    found = audit(replace(six, chain=chain))
    assert found.verdict is Verdict.CUSPIDAL
    assert found.answer.aspects == audit(six).answer.aspects
