from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any

import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.formats.urdf.visuals import visuals
from cuspaudit.robot.library import example_robot_data, library, open_robot

YAML = [path for _, path in library() if path.suffix == ".yaml"]
OWN = {path.stem: path for path in YAML if path.parent.name == "robots"}
SPARE = [path.stem for path in YAML if path.parent.name == "seven-joints"]


@pytest.mark.parametrize("name", OWN)
def test_our_robots_open(name: str) -> None:
    """Each robot of robots/ is named as its file, sourced, square and unremarkable."""
    robot = open_robot(name)
    assert robot.name == name
    assert robot.title
    assert robot.source
    assert robot.expect is not None
    assert robot.notes == ()


@pytest.mark.parametrize("name", SPARE)
def test_our_robots_with_a_joint_to_spare_open(name: str) -> None:
    """Each is named as its file and sourced, with a joint more than its task asks."""
    robot = open_robot(name, square=False)
    assert robot.name == name
    assert robot.title
    assert robot.source
    assert robot.notes == ()
    assert len(robot.chain.joints) == 7
    with pytest.raises(InvalidRobotError, match="7 joints for a pose task"):
        open_robot(name)


def test_example_robots_open_by_name() -> None:
    """A robot of example-robot-data is found by the stem of its URDF."""
    robot = open_robot("ur5_robot")
    assert len(robot.chain.joints) == 6
    assert robot.urdf is not None
    share = example_robot_data()
    assert share is not None
    meshes = [v for v in visuals(robot, [share]) if v.kind == "mesh"]
    assert meshes
    assert all(v.path is not None for v in meshes)


def test_every_example_with_a_moving_chain_imports() -> None:
    """A URDF of example-robot-data imports, by the first options it lists if many."""
    empty = {"iris_simple", "quadrotor_base", "ur3"}
    for name, path in library():
        if path.suffix != ".urdf" or name in empty:
            continue
        try:
            robot = open_robot(path, square=False)
        except InvalidRobotError as error:
            listed = re.search(r"choose one: (--.+?) \([0-9]+ joint", str(error))
            assert listed is not None, name
            robot = open_robot(path, square=False, **keywords(listed[1]))
        assert robot.chain.joints, name


def keywords(options: str) -> dict[str, Any]:
    """The arguments of `open_robot` that pasted options stand for."""
    words = shlex.split(options)
    pairs = list(zip(words[::2], words[1::2], strict=True))
    locks = [value.split("=") for option, value in pairs if option == "--lock"]
    found: dict[str, Any] = {k[2:]: v for k, v in pairs if k != "--lock"}
    return found | ({"lock": dict(locks)} if locks else {})


@pytest.mark.parametrize(
    ("name", "tip", "joints"),
    [("ur3_robot", None, 6), ("panda", "panda_hand", 7), ("z1", "gripperStator", 6)],
)
def test_serial_arms_of_the_examples(name: str, tip: str | None, joints: int) -> None:
    """The arms of example-robot-data open by name; a hand makes the tip a choice."""
    assert len(open_robot(name, tip=tip, square=False).chain.joints) == joints


def test_a_path_opens(tmp_path: Path) -> None:
    """A file is opened by its path."""
    path = tmp_path / "my.yaml"
    path.write_text(OWN["ur5"].read_text())
    assert open_robot(path).name == "ur5"
    assert open_robot(str(path)).file == str(path)


def test_an_unknown_name_gets_neighbours() -> None:
    """An unknown name is refused with the names that look like it."""
    with pytest.raises(InvalidRobotError, match=r'did you mean .*"ur5"'):
        open_robot("ur6")


def test_a_xacro_file_that_is_not_there_is_said() -> None:
    """A missing file is named before anything is expanded."""
    with pytest.raises(InvalidRobotError, match="no such file"):
        open_robot("arm.urdf.xacro")


def test_locking_makes_a_chain_square() -> None:
    """Joints are locked before the task is checked; the record no longer applies."""
    with pytest.raises(InvalidRobotError, match="lock one of"):
        open_robot("xarm7")
    robot = open_robot("xarm7", lock={"joint3": "30 deg"})
    assert len(robot.chain.joints) == 6
    assert robot.notes[-1] == "joint3 is locked at 30 deg"
    wrist = {f"joint_{k}": "0" for k in (4, 5, 6)}
    robot = open_robot("puma-560", lock=wrist)
    assert (robot.chain.task, robot.expect) == ("position", None)
    assert len(open_robot("xarm7", square=False).chain.joints) == 7
