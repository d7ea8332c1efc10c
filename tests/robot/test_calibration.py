from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.calibration import calibrated, read_calibration
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.robot import Robot

POSTURE = np.array([0.1, 0.2, -0.4, 1.0, 2.0, 3.0])

DELTAS = """
convention: standard
units: m
delta_a: [-0.000243788992, 0.003811654186, 0.034503078453, 0.000107694613,
  -0.000198736633, 0]
delta_d: [0.000092253529, 12.062000375761, 17.671902564174, -29.733996046954,
  -0.000028164618, 0.000217420471]
delta_alpha: [0.001156157666, 0.00358518981, 0.003921323366, 0.000406669201,
  -0.002011704165, 0]
delta_theta: [9.1436e-08, 0.178461025123, 6.682833498198, -0.57811698261,
  6.112998e-06, -5.03926e-07]
"""
"""Of a UR3, from its calibration.conf as posted in public."""

UR3 = """
name: ur3
convention: standard
units: m
joints:
  - {type: revolute, a: 0, alpha: pi/2, d: 0.1519}
  - {type: revolute, a: -0.24365, alpha: 0, d: 0}
  - {type: revolute, a: -0.21325, alpha: 0, d: 0}
  - {type: revolute, a: 0, alpha: pi/2, d: 0.11235}
  - {type: revolute, a: 0, alpha: -pi/2, d: 0.08535}
  - {type: revolute, a: 0, alpha: 0, d: 0.0819}
"""

LINKS = """
kinematics:
  shoulder: {x: 0, y: 0, z: 0.1519, roll: -0, pitch: 0, yaw: 1.2e-07}
  upper_arm: {x: 0, y: 0, z: 0, roll: 1.570796327, pitch: 0, yaw: -0}
  forearm: {x: -0.24365, y: 0, z: 0, roll: -0, pitch: 0, yaw: -0}
  wrist_1: {x: -0.21325, y: 0, z: 0.11235, roll: 0.001, pitch: 0.002, yaw: 0.003}
  wrist_2: {x: 0, y: -0.08535, z: 0, roll: 1.570796327, pitch: 0, yaw: -0}
  wrist_3: {x: 0, y: 0.0819, z: 0, roll: 1.5707963, pitch: 3.14159265, yaw: 3.14159265}
  hash: calib_12788084448423163542
"""


@pytest.fixture
def ur3(tmp_path: Path) -> Robot:
    """The design of a UR3."""
    return read_robot(written(tmp_path, "ur3.yaml", UR3))


def written(folder: Path, name: str, text: str) -> Path:
    """A file of this text."""
    path = folder / name
    path.write_text(text)
    return path


def test_deltas_give_the_posted_calibrated_table(
    ur3: Robot, tmp_path: Path, corpus: Path
) -> None:
    """A UR3 with its deltas moves as the calibrated table that was posted."""
    given = read_calibration(written(tmp_path, "c.yaml", DELTAS))
    built = calibrated(ur3, given)
    posted = open_robot(corpus / "posted" / "ur3-calibrated.yaml")
    ours, theirs = (frames(arm.chain, POSTURE) for arm in (built, posted))
    assert np.abs(ours[-1] - theirs[-1]).max() < 2e-8
    assert np.abs((ours - theirs)[:, :3, 3]).max() < 2e-8
    assert "calibrated by" in built.notes[-1]


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_a_delta_is_the_change_of_its_row(convention: str, tmp_path: Path) -> None:
    """Deltas move the arm as the table with the sums in its rows does."""
    text = (
        f"convention: {convention}\nunits: mm\nangle_unit: rad\njoints:\n"
        "  - {{type: revolute, a: {a}, alpha: {b}, d: {c}, theta: {t}}}\n"
        "  - {{type: revolute, a: {e}, alpha: {f}, d: 20, theta: {g}}}\n"
        "  - {{type: revolute, a: 200, alpha: 0.25, d: 10, theta: 0}}\n"
    )
    nominal = read_robot(
        written(
            tmp_path,
            "n.yaml",
            text.format(a=100, b=1, c=50, t=0.5, e=300, f=0.5, g=0.25),
        )
    )
    moved = read_robot(
        written(
            tmp_path,
            "m.yaml",
            text.format(a=100.25, b=1.5, c=50.5, t=0.75, e=301, f=0.75, g=0),
        )
    )
    deltas = (
        f"convention: {convention}\nunits: mm\ndelta_a: [0.25, 1, 0]\n"
        "delta_d: [0.5, 0, 0]\ndelta_alpha: [0.5, 0.25, 0]\n"
        "delta_theta: [0.25, -0.25, 0]\n"
    )
    built = calibrated(nominal, read_calibration(written(tmp_path, "d.yaml", deltas)))
    posture = POSTURE[:3]
    ours, theirs = (frames(arm.chain, posture)[-1] for arm in (built, moved))
    assert np.abs(ours - theirs).max() < 1e-12
    assert np.abs(ours - frames(nominal.chain, posture)[-1]).max() > 1e-3


def test_links_replace_the_fixed_transforms(ur3: Robot, tmp_path: Path) -> None:
    """UR's form: the whole transform before each joint, yaw after pitch after roll."""
    built = calibrated(ur3, read_calibration(written(tmp_path, "k.yaml", LINKS)))
    fourth = built.chain.joints[3]
    assert fourth.axis == (0, 0, 1)
    assert [type(motion).__name__ for motion in fourth.before] == [
        "Translation",
        *("Rotation",) * 3,
    ]
    assert fourth.before[0].vector == (  # type: ignore[union-attr]
        Fraction("-0.21325"),
        0,
        Fraction("0.11235"),
    )
    lean = "roll: 0.001, pitch: 0.002, yaw: 0.003"
    square = LINKS.replace(lean, "roll: 0, pitch: 0, yaw: 0")
    given = read_calibration(written(tmp_path, "n.yaml", square))
    nominal = calibrated(ur3, given)
    still = np.zeros(6)
    tip, flange = frames(nominal.chain, still)[-1], frames(ur3.chain, still)[-1]
    assert np.abs(tip[:3, 3] - flange[:3, 3]).max() < 1e-7


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a: 1", "unknown"),
        ("units: m", "no calibration"),
        ("kinematics: 3", "no mapping of links"),
        ("kinematics: {shoulder: {x: 0}}", "upper_arm is missing"),
        (LINKS.replace("z: 0.1519", "z: __import__('os')"), "kinematics shoulder z"),
        (LINKS.replace("y: -0.08535, ", ""), "wrist_2: not x, y, z"),
        (LINKS.replace("yaw: -0}", "yaw: nan}", 1), "yaw"),
        (LINKS + "robot: ur3", "beside kinematics"),
        (DELTAS.replace("units: m", "units: inch"), "units"),
        (DELTAS.replace("convention: standard", ""), "no convention"),
        (DELTAS.replace("6.112998e-06, ", ""), "different lengths"),
        (DELTAS.replace("delta_a: [", "delta_a: [[1], "), "no list of numbers"),
        (DELTAS.replace("9.1436e-08", "1e999999"), "joint 1"),
        ("delta_a: &x [*x]", "alias"),
        ("[1, 2]", "not a mapping"),
        ("\x00", "c.yaml"),
    ],
)
def test_hostile_files_are_one_line(text: str, said: str, tmp_path: Path) -> None:
    """What is no calibration is refused in one line that names the place."""
    with pytest.raises(InvalidRobotError, match="(?i)" + said) as met:
        read_calibration(written(tmp_path, "c.yaml", text))
    assert "\n" not in str(met.value)


def test_a_missing_file_is_one_line(tmp_path: Path) -> None:
    """A calibration that is not there is refused by its name."""
    with pytest.raises(InvalidRobotError, match=r"none\.yaml"):
        read_calibration(tmp_path / "none.yaml")


def test_deltas_need_a_plain_table(tmp_path: Path) -> None:
    """A row that gives its axis has no D-H numbers to be changed."""
    text = UR3.replace(
        "{type: revolute, a: 0, alpha: 0, d: 0.0819}",
        "{type: revolute, before: [move 0 0 1], axis: 0 1 0}",
    )
    robot = read_robot(written(tmp_path, "axis.yaml", text))
    given = read_calibration(written(tmp_path, "c.yaml", DELTAS))
    with pytest.raises(InvalidRobotError, match="no plain D-H table"):
        calibrated(robot, given)


def test_the_calibration_of_another_arm_is_refused(ur3: Robot, tmp_path: Path) -> None:
    """Another number of joints, or links twice as long: not this robot's."""
    links = read_calibration(written(tmp_path, "k.yaml", LINKS))
    short = replace(ur3, chain=ur3.chain.with_joints(ur3.chain.joints[:5]))
    with pytest.raises(InvalidRobotError, match="has 5 joints"):
        calibrated(short, links)
    longer = LINKS.replace("-0.24365", "-0.612").replace("-0.21325", "-0.5723")
    other = read_calibration(written(tmp_path, "o.yaml", longer))
    with pytest.raises(InvalidRobotError, match="links of"):
        calibrated(ur3, other)
