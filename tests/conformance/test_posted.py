"""Arms as people post them: the corpus answered as its table says, and small copies.

The copies are typed from the public sources that the corpus names (the robot catalogue
of uw-biorobotics/IKBT and its issues, orocos_kinematics_dynamics,
robotics-toolbox-python, Lgx521/EE368_Project), numbers only.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.deciders.decide import answer as exact_answer
from cuspaudit.auditing.options import Options
from cuspaudit.errors import CuspauditError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.library import open_robot

STATED = {"angle_unit": "deg", "length_unit": "mm"}
ROWS = [
    ("jaw.urdf", {}, r"--tip gripper_frame .*--tip moving_jaw .*a jaw\?"),
    (
        "jaw.urdf",
        {"tip": "gripper_frame", "task": "position-and-x-axis"},
        "noncuspidal",
    ),
    ("chair-helper.yaml", {}, "joint_5 turns about .*--task position-and-x-axis"),
    ("mackler.yaml", {}, "joint_5 turns about .*--task position-and-x-axis"),
    ("parkman.yaml", {}, "joint_5 turns about .*--task position-and-x-axis"),
    ("frei.yaml", {}, "joint_5 turns about .*--task position-and-x-axis"),
    ("gantry-offset-head.yaml", {}, "noncuspidal"),
    ("pprrrr.yaml", {}, "noncuspidal"),
    ("olson.yaml", {}, "noncuspidal"),
    ("ur5-on-a-rail.yaml", {}, "noncuspidal"),
    ("three-joints-no-tool.yaml", {}, r"the tip lies on axis 3.*tool: \[move"),
    ("all-axes-parallel.yaml", {}, "all six axes are parallel"),
    ("dummy-convention-in-doubt.csv", {}, "no convention.*--convention standard"),
    (
        "dummy-convention-in-doubt.csv",
        {"convention": "modified"},
        "axes 5 and 6 coincide.*perhaps the table is standard",
    ),
    ("dummy-convention-in-doubt.csv", {"convention": "standard"}, "noncuspidal"),
    ("ar3.yaml", {}, "noncuspidal"),
    ("xb25.json", {}, "noncuspidal"),
    ("gen3-lite.csv", {}, r"no unit of angles.*no unit of lengths.*--angle-unit"),
    ("gen3-lite.csv", STATED, "cuspidal"),
    ("ur3-calibrated.yaml", {}, "cuspidal"),
    ("parallelogram.urdf", {}, "noncuspidal"),
]


def answer(path: Path, **options: str) -> str:
    """The verdict on a file, or the line that refuses it."""
    try:
        robot = open_robot(path, **options)
        return audit(robot, Options(timeout=20.0)).answer.verdict.value
    except CuspauditError as error:
        assert "\n" not in str(error)
        return str(error)


def holds(said: str, expected: str) -> bool:
    """Whether a verdict is the one expected, or a line says what it should."""
    if expected.endswith("cuspidal"):
        return said == expected
    return re.search(expected, said) is not None


@pytest.mark.slow
@pytest.mark.parametrize(("name", "options", "expected"), ROWS)
def test_the_corpus_is_answered_as_its_table_says(
    corpus: Path, name: str, options: dict[str, str], expected: str
) -> None:
    """Every row of the table of posted arms."""
    said = answer(corpus / "posted" / name, **options)
    assert holds(said, expected), said


OLSON = """\
name: olson13
convention: modified
units: m
joints:
  - {type: P, alpha: -pi/2, a: 0, theta: pi/2}
  - {type: P, alpha: pi/2, a: 0, theta: -pi/2}
  - {alpha: pi/2, a: 0, d: 1, theta: 0}
  - {alpha: pi/2, a: 0, d: 0, theta: 0}
  - {alpha: 0, a: 4, d: 0, theta: 0}
  - {alpha: pi/2, a: 0, d: 2, theta: 0}
"""
GANTRY = """\
convention: standard
units: mm
joints:
  - {type: P, theta: 0, a: 0, alpha: -pi/2}
  - {type: P, theta: -pi/2, a: 0, alpha: -pi/2}
  - {type: P, theta: 0, a: 0, alpha: 0}
  - {d: 0, a: 80, alpha: pi/2}
  - {d: 0, a: 0, alpha: -pi/2}
  - {d: 120, a: 0, alpha: 0}
"""
RAIL = """\
convention: standard
joints:
  - {type: P, theta: 0, a: 0, alpha: 0}
  - {a: -0.425, alpha: 0, d: 0}
  - {a: -0.39225, alpha: 0, d: 0}
  - {a: 0, alpha: pi/2, d: 0.10915}
  - {a: 0, alpha: -pi/2, d: 0.09465}
  - {a: 0, alpha: 0, d: 0.0823}
"""
GEN3_LITE = """\
i,alpha_{i-1},a_{i-1},theta_i,d_i
1,0,0,0,243.3
2,90,0,90,30
3,180,280,90,20
4,90,0,90,245
5,90,0,180,57
6,90,0,90,235
"""


@pytest.mark.parametrize(
    ("name", "text", "options", "expected"),
    [
        ("olson.yaml", OLSON, {}, "noncuspidal"),
        ("gantry.yaml", GANTRY, {}, "noncuspidal"),
        ("rail.yaml", RAIL, {}, "noncuspidal"),
        pytest.param(
            *("gen3-lite.csv", GEN3_LITE, STATED, "cuspidal"), marks=pytest.mark.slow
        ),
        ("gen3-lite.csv", GEN3_LITE, {}, "no unit of angles.*no unit of lengths"),
    ],
)
def test_copies_are_answered_without_the_corpus(
    tmp_path: Path, name: str, text: str, options: dict[str, str], expected: str
) -> None:
    """One of each kind: slides, a gantry, a rail, posted headers."""
    path = tmp_path / name
    path.write_text(text)
    said = answer(path, **options)
    assert holds(said, expected), said


def test_sentences_speak_of_the_arm_at_hand(tmp_path: Path) -> None:
    """An arm with slides that no theorem decides is not called a general 6R arm."""
    path = tmp_path / "arm.yaml"
    general = RAIL.replace("a: -0.39225, alpha: 0", "a: 0.3, alpha: pi/5")
    path.write_text(general.replace("alpha: -pi/2, d", "alpha: pi/3, d"))
    found = exact_answer(exact_model(open_robot(path).chain))
    assert found.verdict.value == "undecided"
    assert found.undecided is not None
    said = f"{found.why} {found.undecided.would_settle}"
    assert "6R" not in said
    assert "PRRRRR" in said
