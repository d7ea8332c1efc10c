"""An audit as a Python object."""

from __future__ import annotations

import base64
import json
import re
from pathlib import Path

import numpy as np
import pytest

import cuspaudit as cu
from cuspaudit.robot.frames import frames


@pytest.fixture(scope="module")
def paper() -> cu.Audit:
    """The arm of the paper, audited."""
    return cu.audit(cu.load("chablat-2022-3r"))


def test_a_verdict_equals_its_word_only(paper: cu.Audit) -> None:
    """True or False by comparison, and an error as a condition."""
    assert paper.verdict == "cuspidal"
    assert paper.verdict != "noncuspidal"
    with pytest.raises(TypeError, match="one of three"):
        bool(paper.verdict)


def test_an_audit_says_what_it_found(paper: cu.Audit) -> None:
    """Verdict, reason, proof and counts, as the JSON has them."""
    assert repr(paper) == (
        "<Audit of chablat-2022-3r: cuspidal, 2 aspects, 4 postures>"
    )
    assert (paper.proof.kind, paper.proof.rests_on) == ("witness", ("ball arithmetic",))
    assert paper.aspects is not None
    assert (paper.aspects.count, paper.aspects.proved) == (2, True)
    assert "path" in paper.why
    assert paper.within_limits is None
    assert paper.to_dict()["verdict"] == "cuspidal"
    json.dumps(paper.to_dict(), allow_nan=False)


def test_structures_come_nearest_first_and_decide_nothing(paper: cu.Audit) -> None:
    """Each has a distance and the verdict of the arm that would have it."""
    found = paper.structures
    assert found
    assert not any(structure.holds for structure in found)
    assert {structure.verdict for structure in found} <= {*cu.Verdict, None}
    assert [s.name for s in found] == [
        entry["name"] for entry in paper.to_dict()["structures"]
    ]


def test_what_to_dict_gives_belongs_to_the_caller(paper: cu.Audit) -> None:
    """Changing it does not change the audit."""
    paper.to_dict()["proof"]["why"] = "another"
    assert paper.why != "another"


def test_the_witness_is_two_postures_of_one_pose_and_a_regular_path(
    paper: cu.Audit,
) -> None:
    """Its ends reach one point, differ, and det J keeps the sign on the path."""
    witness = paper.witness
    assert witness is not None
    assert witness.path.shape[1] == 3
    tips = [frames(paper.robot.chain, q)[-1, :3, 3] for q in witness.postures]
    assert np.allclose(tips[0], tips[1], atol=1e-9)
    assert np.abs(witness.postures[0] - witness.postures[1]).max() > 0.1
    values = witness.determinants(200)
    assert values.shape == (200,)
    assert np.all(np.sign(values) == witness.sign)
    assert values.min() < 0.99 * values.max()


def test_the_path_of_five_joints_has_five_columns() -> None:
    """The virtual joint of a tool axis is not the robot's."""
    audit = cu.audit(cu.load("chablat-2022-5r"))
    assert audit.witness is not None
    assert audit.witness.path.shape[1] == 5
    assert np.all(np.sign(audit.witness.determinants(50)) == audit.witness.sign)


def test_files_are_written_and_the_certificate_verifies(
    paper: cu.Audit, tmp_path: Path
) -> None:
    """`save_html` and `save_certificate` write what the command writes."""
    paper.save_html(tmp_path / "a.html")
    paper.save_certificate(tmp_path / "c.json")
    assert "<html" in (tmp_path / "a.html").read_text()
    found = cu.verify(str(tmp_path / "c.json"))
    assert found.accepted
    assert found.why == found.to_dict()["reason"]


def test_a_locked_joint_is_loaded_and_named() -> None:
    """`lock` takes texts; a bare number, which has no unit, is refused."""
    robot = cu.load("ur5_robot", lock={"wrist_3_joint": "30 deg"}, task=None)
    assert "wrist_3_joint = 30 deg" in repr(robot)
    with pytest.raises(cu.CuspauditError, match=re.escape('"30 deg"')):
        cu.load("ur5_robot", lock={"wrist_3_joint": 0.5})  # type: ignore[dict-item]


def test_a_name_is_no_robot() -> None:
    """The message shows the call that was meant."""
    with pytest.raises(cu.CuspauditError, match=r"audit\(load"):
        cu.audit("ur5")  # type: ignore[arg-type]


def test_a_system_has_the_results_of_an_audit() -> None:
    """Whitney's cusp: verdict, counts and path without any robot."""
    found = cu.decide(variables=["x", "y"], map=["x^3 + x*y", "y"], equations=[])
    assert repr(found) == "<SystemAudit of a map to R^2: cuspidal>"
    assert found.aspects is not None
    assert found.aspects.count == 2
    assert found.path is not None
    assert found.path.shape[1] == 2
    assert found.to_dict()["robot"] is None


def test_a_system_that_cannot_be_read_is_refused() -> None:
    """Polynomials are parsed, never evaluated; the message names the entry."""
    with pytest.raises(cu.CuspauditError, match=r"map\[0\]"):
        cu.decide(variables=["x"], map=["__import__('os')"])


def test_the_witness_within_limits_stays_inside_them(tmp_path: Path) -> None:
    """Its two postures have one tip, and no way point leaves the limits."""
    text = (Path(cu.__file__).parents[1] / "robots/chablat-2022-3r.yaml").read_text()
    limited = text.replace("d: 1}", "d: 1, limits: [-170 deg, 170 deg]}", 1)
    limited = limited[: limited.index("expect:")]
    (tmp_path / "arm.yaml").write_text(limited)
    found = cu.audit(cu.load(tmp_path / "arm.yaml"))
    within = found.within_limits
    assert within is not None
    assert within.verdict == "cuspidal"
    assert within.witness is not None
    assert np.all(np.abs(within.witness.path[:, 1]) < np.radians(170))
    assert len(set(np.sign(within.witness.determinants(50)))) == 1
    # the page shows that path, and gives away the certificate of it
    found.save_html(tmp_path / "arm.html")
    page = (tmp_path / "arm.html").read_text()
    assert "cuspaudit verify chablat-2022-3r.within-limits.certificate.json" in page
    links = re.findall(r"data:application/json;base64,([A-Za-z0-9+/=]+)", page)
    texts = [json.loads(base64.b64decode(link)) for link in links]
    [kept] = [t for t in texts if t["schema"].startswith("cuspaudit/certificate")]
    assert kept["limits"][1] is not None
