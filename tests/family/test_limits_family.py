"""Limits as parameters of a family, and the verdict within them as a column."""

from __future__ import annotations

from pathlib import Path

import pytest

from cuspaudit.auditing.check import check_robot
from cuspaudit.auditing.expectation import write_expectation
from cuspaudit.errors import InvalidRobotError
from cuspaudit.family.family_file import read_family
from cuspaudit.family.row import decide_member
from cuspaudit.robot.library import open_robot

FAMILY = """
family: how far joint 2 may turn
robot:
  convention: standard
  units: m
  task: position
  joints:
    - {type: revolute, a: 1,   alpha: -pi/2, d: 0}
    - {type: revolute, a: 2,   alpha: pi/2,  d: 1, limits: [-t, t]}
    - {type: revolute, a: 3/2, alpha: 0,     d: 0}
parameters:
  t: {values: [40 deg, 170 deg]}
record: [aspects, within_limits]
"""
ROBOT = """
name: boxed
convention: standard
units: m
task: position
joints:
  - {type: revolute, a: 1,   alpha: -pi/2, d: 0}
  - {type: revolute, a: 2,   alpha: pi/2,  d: 1, limits: [-20 deg, 20 deg]}
  - {type: revolute, a: 3/2, alpha: 0,     d: 0, limits: [-20 deg, 20 deg]}
"""


def test_a_limit_is_a_parameter_and_has_its_column(tmp_path: Path) -> None:
    """Joint 2 held short is noncuspidal, held long cuspidal; the arm is the same."""
    path = tmp_path / "limits.yaml"
    path.write_text(FAMILY)
    family = read_family(path)
    rows = [decide_member(family, index) for index in (0, 1)]
    assert [row.get("error") for row in rows] == [None, None]
    assert [row["verdict"] for row in rows] == ["cuspidal", "cuspidal"]
    assert [row["within_limits"] for row in rows] == ["noncuspidal", "cuspidal"]


def test_a_recorded_verdict_within_limits_is_held(tmp_path: Path) -> None:
    """What is found is written, read again, and a contradiction is a mismatch."""
    path = tmp_path / "boxed.yaml"
    path.write_text(ROBOT)
    first = check_robot(path)
    assert first.status == "no expectation"
    assert first.found["within_limits.verdict"] == "noncuspidal"
    assert first.found["within_limits.aspects"] == 2
    assert write_expectation(path, first.found)
    assert open_robot(path).expect == first.found
    assert check_robot(path).status == "ok"
    text = path.read_text()
    path.write_text(text.replace("verdict: noncuspidal", "verdict: cuspidal"))
    again = check_robot(path)
    assert again.status == "mismatch"
    assert "within_limits.verdict noncuspidal where cuspidal" in again.detail


@pytest.mark.parametrize(
    "entry", ["within_limits: cuspidal", "within_limits: {cusps: 4}"]
)
def test_other_records_within_limits_are_refused(tmp_path: Path, entry: str) -> None:
    """Verdict and aspects, and nothing else."""
    path = tmp_path / "boxed.yaml"
    path.write_text(f"{ROBOT}expect: {{{entry}}}\n")
    with pytest.raises(InvalidRobotError, match="within_limits"):
        open_robot(path)
