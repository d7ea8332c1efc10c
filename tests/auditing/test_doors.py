"""A verdict belongs to the arm, whichever file it came through."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cuspaudit.auditing.audit import Options, audit
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats.dh.write import table_text
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snap_policy import NO_SNAPPING
from cuspaudit.robot.snapping import snap

DOORS = {
    "3R of the paper": (
        *("hostile/control_3r_cuspidal.urdf", "hostile/dh_control.csv"),
        *("hostile/dh_control.yaml", "chablat-2022-3r"),
    ),
    "UR": ("urdf/ur_ur5e.urdf", "dh/rtb_ur5.csv", "ur5", "ur5_robot"),
    "PUMA 560": ("urdf/puma_560.urdf", "dh/rtb_puma560.csv", "puma-560"),
    "CRX-10iA/L": ("urdf/fanuc_crx10ia_l.urdf", "fanuc-crx-10ia-l"),
}


def robot_of(corpus: Path, door: str) -> Robot:
    """The robot behind a door: a file of the corpus, or a name."""
    if "/" not in door:
        return open_robot(door)
    path = corpus / door
    if door.startswith("urdf/"):
        oracle = json.loads((corpus / "urdf" / "FK_ORACLE.json").read_text())
        entry = oracle["robots"][path.stem]
        return open_robot(path, base=entry["root"], tip=entry["tip"])
    if door.startswith("hostile/") and path.suffix == ".csv":
        return open_robot(path, convention="standard", angle_unit="rad")
    return open_robot(path)


def told(chain: Chain) -> tuple[object, ...]:
    """What is decided of a chain after snapping."""
    found = answer(exact_model(snap(chain)[0]))
    reduction = found.reduction.kind if found.reduction else None
    return found.verdict, reduction, found.aspects and found.aspects.count


@pytest.mark.parametrize("arm", DOORS)
def test_the_verdict_does_not_depend_on_the_door(
    arm: str, corpus: Path, tmp_path: Path
) -> None:
    """URDF, D-H table and a table written from each have one verdict and one reason."""
    found = set()
    for door in DOORS[arm]:
        literal = robot_of(corpus, door).chain
        path = tmp_path / "back.yaml"
        for chain in (literal, snap(literal)[0]):
            path.write_text(table_text(chain), encoding="utf-8")
            found.add(told(read_robot(path).chain))
        found.add(told(literal))
    assert len(found) == 1


def test_whole_audits_agree(corpus: Path) -> None:
    """The 3R of the paper has one verdict and one count in each of its records."""
    records = []
    for door in DOORS["3R of the paper"]:
        record = audit(robot_of(corpus, door)).record()
        keys = ("verdict", "aspects", "postures")
        counts = [record["singular"][key] for key in ("cusps", "nodes")]
        records.append(([record[key] for key in keys], counts))
    assert all(record == records[0] for record in records)
    assert records[0][0][0] == "cuspidal"


def test_a_policy_is_recorded_and_obeyed(corpus: Path) -> None:
    """Without snapping the model is the file's, and the record says which policy."""
    robot = robot_of(corpus, "hostile/control_3r_cuspidal.urdf")
    record = audit(robot, Options(snap=NO_SNAPPING)).record()
    assert record["robot"]["snap_policy"]["name"] == "none"
    assert record["robot"]["snapped"] == []
    assert record["robot"]["exact"] is False
    assert record["verdict"] == record["models"]["literal"] == "cuspidal"
    assert audit(robot).record()["robot"]["snap_policy"]["name"] == "default"
