from __future__ import annotations

import csv
from pathlib import Path

import pytest

from cuspaudit.errors import CuspauditError, NoAngleError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import place
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.proposals import check_task
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snapping import snap

LATER = {
    "rpy_arbitrary.urdf": "the exact model states its rational point of the circle",
    "degenerate_tip_on_last_axis.urdf": "the decision finds det J = 0",
    "degenerate_6r_two_coaxial_wrist.urdf": "the decision finds det J = 0",
}


def rows(corpus: Path) -> list[dict[str, str]]:
    """What a careful tool answers, file by file."""
    with (corpus / "hostile" / "EXPECT.csv").open(newline="") as stream:
        return list(csv.DictReader(stream))


def answer(path: Path) -> Robot | str:
    """The robot, or the one line that refuses it; of four joints when it has an angle.

    The tables name neither convention nor unit; a user states them on the command.
    """
    table = path.suffix != ".urdf"
    try:
        robot = read_robot(
            path,
            convention="standard" if path.suffix == ".csv" else None,
            angle_unit="rad" if table else None,
        )
        check_task(robot.chain, robot.file)
        if robot.chain.task == "position-and-angle":
            place(exact_model(snap(robot.chain)[0]))
    except NoAngleError as error:
        return str(NoAngleError(error.joints, robot.file))
    except CuspauditError as error:
        return str(error)
    return robot


def test_every_hostile_file_gets_its_answer(corpus: Path) -> None:
    """Each of 125 files is accepted, or refused in one line that names it."""
    differ = []
    for row in rows(corpus):
        path = corpus / "hostile" / row["file"]
        if not path.exists():
            continue
        result = answer(path)
        if isinstance(result, str):
            named = result.startswith(str(path)) and "\n" not in result
            right = named and any(word in row["answer"] for word in ("REJECT", "ASK"))
        else:
            right = "OK" in row["answer"]
        if not right:
            differ.append((row["file"], row["answer"], result))
    assert differ == []


def test_every_assumption_is_said(corpus: Path) -> None:
    """Each file accepted with a note has one, or a number that is listed as snapped."""
    control = read_robot(corpus / "hostile" / "control_3r_cuspidal.urdf")
    plain = {record.given for record in snap(control.chain)[1]}
    silent = set()
    for row in rows(corpus):
        robot = answer(corpus / "hostile" / row["file"])
        if row["answer"] == "OK + note" and isinstance(robot, Robot):
            listed = {record.given for record in snap(robot.chain)[1]} - plain
            if not robot.notes and not listed:
                silent.add(row["file"])
    assert silent == set(LATER)


def test_nothing_is_evaluated(corpus: Path) -> None:
    """Names that are programs stay names."""
    answer(corpus / "hostile" / "names_injection.urdf")
    assert not Path("/tmp/CUSPAUDIT_PWNED").exists()


@pytest.mark.parametrize(
    "name",
    [
        "base_is_not_root",
        "fixed_joints_between",
        "control_crlf_tabs",
        "control_utf16",
        "control_joint_before_link",
        "xinclude",
        "control_comments_and_extensions",
    ],
)
def test_variants_of_one_arm_are_one_chain(corpus: Path, name: str) -> None:
    """What changes only the writing of a file leaves kinds and limits alone."""
    control = read_robot(corpus / "hostile" / "control_3r_cuspidal.urdf").chain
    other = read_robot(corpus / "hostile" / f"{name}.urdf").chain
    assert other.kinds == control.kinds
    assert [j.limits for j in other.joints] == [j.limits for j in control.joints]
