from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from short_tables import Number, arm, with_wrist

import cuspaudit
from cuspaudit.auditing import record as record_module
from cuspaudit.auditing.audit import Options, audit
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.auditing.deciders.registry import DECIDERS
from cuspaudit.auditing.record import SCHEMA, FinishedAudit
from cuspaudit.certificate import verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, UnableError
from cuspaudit.robot.chain import X_AXIS, Angle, Rotation
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.robot import Robot

module = import_module("cuspaudit.auditing.deciders.certify")
#: the keys of the audit as JSON; each is always there
KEYS: dict[str, set[str]] = {
    "": {
        *("schema", "robot", "verdict", "proof", "aspects", "postures", "singular"),
        *("witness", "models", "limits", "crosscheck", "undecided", "seconds"),
        *("versions", "seed", "literal_witness", "literal_why", "crowd"),
        *("cusp", "structures", "margin", "tolerance"),
    },
    "robot": {"name", "file", "joints", "base", "tip", "task", "exact", "snapped"},
    "proof": {"kind", "engine", "reduction", "rests_on", "why"},
    "aspects": {"count", "proved"},
    "postures": {"max", "proved"},
    "singular": {"determinant", "factors", "cusps", "nodes"},
    "witness": {"sign", "postures", "path", "clearance", "certificate"},
    "models": {"literal", "snapped"},
    "crosscheck": {
        *("engine", "samples", "max_relative_error", "singular_points_checked"),
        "agree",
    },
    "undecided": set(),
    "seconds": {"total", "import", "decide", "certify", "crosscheck"},
    "versions": {"cuspaudit", "python-flint", "msolve"},
}
NAMES = ["chablat-2022-3r", "baili-2004-wt1", "ur5", "puma-560", "abb-gofa-5"]


@pytest.fixture(scope="module")
def audits() -> dict[str, FinishedAudit]:
    """A cuspidal, two noncuspidal, a reduced and a searched robot, audited."""
    return {name: audit(open_robot(name), Options(seed=5)) for name in NAMES}


def robot_of(
    a: tuple[Number, ...], d: tuple[Number, ...], alpha: tuple[Number, ...]
) -> Robot:
    """A robot that no file holds."""
    return Robot("test", "test.yaml", arm(a, d, alpha))


@pytest.mark.parametrize("name", NAMES)
def test_every_key_is_there(audits: dict[str, FinishedAudit], name: str) -> None:
    """The documented keys are present, null where they do not apply."""
    record = audits[name].record()
    assert set(record) == KEYS[""]
    for key, wanted in KEYS.items():
        inside = record if key == "" else record[key]
        if isinstance(inside, Mapping):
            assert wanted <= set(inside), key
    limited = any(record["robot"]["joint_limits"])
    assert (record["limits"] is not None) == limited
    assert record["schema"] == SCHEMA == "cuspaudit/audit/2"
    assert record["seed"] == 5


@pytest.mark.parametrize("name", NAMES)
def test_the_record_is_json_and_fits_its_schema(
    audits: dict[str, FinishedAudit], name: str
) -> None:
    """It survives being written strictly and fits the schema that ships."""
    record = audits[name].record("arm.certificate.json")
    again = json.loads(json.dumps(record, allow_nan=False))
    jsonschema.validate(again, _schema())


@pytest.mark.parametrize("name", NAMES)
def test_the_verdict_and_its_proof_belong_together(
    audits: dict[str, FinishedAudit], name: str
) -> None:
    """A witness for cuspidal, a proof for noncuspidal, a reason for undecided."""
    found = audits[name]
    record = found.record()
    kind = record["proof"]["kind"]
    assert {
        "cuspidal": kind == "witness",
        "noncuspidal": kind in ("exact", "reduction"),
        "undecided": kind == "none",
    }[record["verdict"]]
    assert (record["witness"] is not None) == (record["verdict"] == "cuspidal")
    assert (record["undecided"] is not None) == (record["verdict"] == "undecided")
    assert bool(record["proof"]["rests_on"]) == (record["verdict"] != "undecided")
    assert record["crosscheck"]["agree"] is True
    assert record["crosscheck"]["max_relative_error"] <= 1e-9
    assert "msolve" not in record["proof"]["rests_on"]


def test_the_paper_s_arm(audits: dict[str, FinishedAudit]) -> None:
    """The numbers of the ISSAC 2022 arm, and a witness that verifies."""
    found = audits["chablat-2022-3r"]
    record = found.record("here.json")
    assert record["verdict"] == "cuspidal"
    assert record["aspects"] == {"count": 2, "proved": True}
    assert record["postures"] == {"max": 4, "proved": True}
    assert (record["singular"]["cusps"], record["singular"]["nodes"]) == (4, 0)
    assert record["models"] == {"literal": "cuspidal", "snapped": "cuspidal"}
    assert record["proof"]["rests_on"] == ["ball arithmetic"]
    assert record["proof"]["engine"] == "roadmap"
    witness = record["witness"]
    assert witness["certificate"] == "here.json"
    assert witness["path"][0] == witness["postures"][0]
    assert witness["path"][-1] == witness["postures"][1]
    assert 0 < witness["clearance"] <= 1
    assert found.witness is not None
    assert verify(found.witness.certificate).accepted


def test_a_reduction_is_named(audits: dict[str, FinishedAudit]) -> None:
    """The UR5 by its pattern, the PUMA by its wrist; nothing else is claimed."""
    ur5, puma = (audits[name].record() for name in ("ur5", "puma-560"))
    assert ur5["proof"]["reduction"] == "UR pattern"
    assert ur5["proof"]["engine"] is None
    assert ur5["singular"]["cusps"] is None
    assert puma["proof"]["reduction"] == "spherical wrist"
    assert puma["proof"]["kind"] == "reduction"
    assert puma["verdict"] == ur5["verdict"] == "noncuspidal"


def stiff_wrist() -> Robot:
    """A cuspidal arm whose wrist hardly tilts: no theorem says more."""
    chain = with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)), (3, 4))
    return Robot("stiff wrist", "stiff.yaml", chain)


def test_a_cusp_decides_where_no_path_is_met() -> None:
    """A stiff wrist turns little, and little is enough near a cusp."""
    found = audit(stiff_wrist(), Options(seed=3))
    record = json.loads(json.dumps(found.record("stiff.json")))
    jsonschema.validate(record, _schema())
    assert record["verdict"] == "cuspidal"
    assert found.cusp is not None
    assert verify(found.cusp.certificate).accepted
    if record["witness"] is None:
        assert record["proof"]["kind"] == "cusp"
        assert record["cusp"]["certificate"] == "stiff.json"


@pytest.mark.slow
def test_an_undecided_arm_says_what_was_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Step, reason, structures looked for, search, pairs, and what would settle it."""
    monkeypatch.setattr(
        *(import_module("cuspaudit.auditing.audit"), "decide"),
        lambda case, clock, ways=DECIDERS: decide(
            case, clock, [way for way in ways if way.stage != "cusp"]
        ),
    )
    record = audit(stiff_wrist(), Options(seed=3)).record()
    undecided = record["undecided"]
    jsonschema.validate(json.loads(json.dumps(record)), _schema())
    assert undecided["search"]["seed"] == 3
    assert sum(undecided["search"]["postures"].values()) == undecided["search"]["poses"]
    assert undecided["search"]["pairs"] > 0
    assert undecided["pairs"]["seed"] == 3
    assert undecided["pairs"]["together"] == 0
    assert undecided["step"]
    assert undecided["why"]
    assert len(undecided["looked_for"]) >= 3
    assert undecided["would_settle"]


def test_steps_are_announced() -> None:
    """Progress hears of each step, the certificate and the cross-check last."""
    steps: list[str] = []
    audit(open_robot("chablat-2022-3r"), Options(progress=steps.append))
    assert steps[0] == "crit"
    assert steps[-2:] == ["certificate", "crosscheck"]


@pytest.mark.parametrize("name", ["chablat-2022-3r", "raghavan-roth"])
def test_time_that_is_up_is_undecided(name: str) -> None:
    """With no time there is no verdict, and the audit still ends with its check."""
    found = audit(open_robot(name), Options(timeout=0))
    record = found.record()
    assert record["verdict"] == "undecided"
    assert "time limit" in record["undecided"]["why"]
    assert record["models"]["literal"] == "undecided"
    assert record["crosscheck"]["agree"] is True
    jsonschema.validate(json.loads(json.dumps(record)), _schema())


def _schema() -> Any:
    path = Path(cuspaudit.__file__).parent / "auditing" / "schema.json"
    return json.loads(path.read_text())


def test_without_a_proved_path_there_is_no_verdict(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A couple whose path resists proof is UNDECIDED: cuspidal is what is certified."""

    def never(*args: object) -> None:
        raise UnableError("certificate", "no path could be proved: test")

    monkeypatch.setattr(module, "find_witness", never)
    record = audit(open_robot("chablat-2022-3r")).record()
    assert record["verdict"] == "undecided"
    assert record["undecided"]["step"] == "certificate"
    assert record["witness"] is None
    assert record["proof"]["kind"] == "none"
    jsonschema.validate(json.loads(json.dumps(record)), _schema())


def test_a_couple_made_by_rounding_is_no_verdict() -> None:
    """Twists of 45 and 30 degrees fit no one field: couples 1e-15 high stay undecided.

    The model, 1e-12 rad beside the arm, opens crossings of the singular curve by a
    hair; Algorithm 1 is right about the model, and no path of the arm can be proved.
    """
    chain = arm((0, 1, 2), (0, -2, 0), (45, 30, -90), "PRR")
    record = audit(Robot("hair", "hair.yaml", chain)).record()
    assert record["verdict"] == "undecided"
    assert record["undecided"]["step"] == "certificate"
    assert record["robot"]["exact"] is False


def test_an_approximated_model_says_so() -> None:
    """An angle that no field holds: noncuspidal for the model, undecided as written."""
    robot = robot_of((1, ".2", 2), (0, 1, 0), (-60, "99.98", 0))
    found = audit(robot)
    record = found.record()
    assert record["verdict"] == "noncuspidal"
    assert record["robot"]["exact"] is False
    assert len(record["robot"]["approximated"]) >= 1
    assert "at most" in record["proof"]["why"]
    assert record["models"]["literal"] == "undecided"


def test_a_snapped_robot_has_two_models() -> None:
    """1.5708 is taken for pi/2: the snapped verdict, and the literal one beside it."""
    robot = robot_of((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
    joints = list(robot.chain.joints)
    rough = tuple(
        replace(motion, angle=Angle(radians=_rough(motion.angle)))
        if hasattr(motion, "angle") and motion.angle.half_turns
        else motion
        for motion in joints[1].before
    )
    joints[1] = replace(joints[1], before=rough)
    robot = replace(robot, chain=robot.chain.with_joints(joints))
    found = audit(robot)
    record = found.record()
    assert record["verdict"] == "cuspidal"
    assert len(record["robot"]["snapped"]) == 1
    assert record["robot"]["snapped"][0]["used"] == "-pi/2"
    assert record["models"] == {"literal": "cuspidal", "snapped": "cuspidal"}
    assert record["witness"]["model"] == "literal"


@pytest.mark.slow
def test_a_hair_between_the_literal_and_the_snapped_model() -> None:
    """3.1416 for pi between parallel axes: noncuspidal as meant, cuspidal as written.

    The clearance of the literal witness, proved, tells a hair from a hazard.
    """
    lengths = ((0, "-.28", "-.24", 0, 0, 0), (".1", 0, 0, ".1", ".1", 0))
    chain = arm(*lengths, (90, 0, 0, 90, -90, 0))
    twists = {1: "3.1416", 2: "-3.1416"}
    joints = list(chain.joints)
    for k, text in twists.items():
        flip = Rotation(X_AXIS, Angle(radians=Fraction(text)), "alpha")
        joints[k + 1] = replace(joints[k + 1], before=(*joints[k + 1].before, flip))
    found = audit(Robot("rounded", "rounded.yaml", chain.with_joints(joints)))
    record = found.record()
    jsonschema.validate(json.loads(json.dumps(record)), _schema())
    assert record["models"] == {"literal": "cuspidal", "snapped": "noncuspidal"}
    assert record["witness"] is None
    assert 0 < record["literal_witness"]["clearance"] < 1e-4
    assert found.literal_witness is not None
    assert verify(found.literal_witness.certificate).accepted


def _rough(angle: Angle) -> Any:
    return Fraction("1.5708") * (1 if angle.half_turns > 0 else -1)


def test_a_degenerate_arm_is_an_error_that_helps() -> None:
    """A planar arm with a position task in space: no verdict, and what to do."""
    with pytest.raises(DegenerateMapError, match="all three axes are par") as error:
        audit(robot_of((1, 1, 1), (0, 0, 0), (0, 0, 0)))
    assert "test.yaml" in str(error.value)


def test_limits_and_locks_are_recorded() -> None:
    """Joint limits in rad, locked joints as the user wrote them."""
    robot = open_robot("chablat-2022-3r")
    half = Angle()
    joints = list(robot.chain.joints)
    joints[2] = replace(joints[2], limits=(-_quarter(), half))
    chain = robot.chain.with_joints(joints)
    record = audit(replace(robot, chain=chain, locked={"wrist": "0"})).record()
    assert record["robot"]["joint_limits"] == [None, None, [-math.pi / 2, 0.0]]
    assert record["robot"]["locked"] == {"wrist": "0"}


def _quarter() -> Angle:
    return Angle(Fraction(1, 2))


def test_an_absent_package_has_no_version(monkeypatch: pytest.MonkeyPatch) -> None:
    """Versions of what is not installed are null."""
    monkeypatch.setattr(record_module, "PACKAGES", ("no-such-package",))
    versions = audit(open_robot("baili-2004-wt1")).record()["versions"]
    assert versions["no-such-package"] is None
    assert versions["cuspaudit"] == cuspaudit.__version__


def test_the_audit_of_one_robot_is_the_same_twice() -> None:
    """The same seed gives the same record, times aside."""
    records = [audit(open_robot("chablat-2022-3r")).record() for _ in range(2)]
    for record in records:
        del record["seconds"]
    assert records[0] == records[1]
    assert Verdict(records[0]["verdict"]) is Verdict.CUSPIDAL
