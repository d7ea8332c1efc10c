"""Modules of ssik are read as data: literal numbers, and no line of them is run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from ssik_module import module

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.formats.registry import holds_robot
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.ssik_arms import ssik_arms


def test_a_module_is_read_and_not_run(tmp_path: Path) -> None:
    """Literal numbers become the chain, and its pose at zero is the one stated."""
    robot = open_robot(module(tmp_path))
    joints = robot.chain.joints
    assert [joint.name for joint in joints] == [f"j{k}" for k in range(1, 7)]
    assert joints[5].limits is None
    home = [[0, 0, 1, 1.4], [0, 1, 0, 0], [-1, 0, 0, 0.5], [0, 0, 0, 1]]
    assert np.abs(frames(robot.chain, np.zeros(6))[-1] - home).max() < 1e-12


def test_the_arms_of_a_package_have_names(tmp_path: Path) -> None:
    """Maker and model; a folder without the package has none."""
    assert ssik_arms(tmp_path) == {}
    path = module(tmp_path)
    assert ssik_arms(tmp_path) == {"maker-arm": path}
    assert open_robot(path).name == "maker-arm"


def test_other_python_holds_no_robot(tmp_path: Path) -> None:
    """A folder of scripts is no folder of robots."""
    script = tmp_path / "script.py"
    script.write_text("print(1)\n")
    assert not holds_robot(script)
    assert holds_robot(module(tmp_path))
    with pytest.raises(InvalidRobotError, match="no _JOINT_NAMES"):
        open_robot(script)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("0.5000000000000001", "__import__('os').getcwd()", "no literal"),
        ("0.5000000000000001", "1e999", "other entries"),
        ("0.5000000000000001", "True", "other entries"),
        ("0.5000000000000001", "0.6", "the pose at zero"),
        ("[1.0, 0, 0, 0.7]", "[2.0, 0, 0, 0.7]", "no rigid motion"),
        ("[1.0, 0, 0, 0.7]", "[1.0, 0, 0]", "other entries"),
        ("(-1.5, 1.5)", "(1.5, -1.5)", "above the upper one"),
        ("(-1.5, 1.5)", "(1.5,)", "other limits"),
        ("[0.0, 0.0, 1.0]", "[0.0, 0.0, 0.0]", "the axis 0 0 0"),
        ("'revolute'", "'screw'", "revolute or prismatic"),
        ('"j1", ', "", "joint|entries"),
        ("T_HOME", "T_ROME", "no T_HOME"),
        ("import numpy", "import", "not Python"),
        ("_JOINT_AXES = [", "_JOINT_AXES = -[", "no literal"),
    ],
)
def test_a_damaged_module_is_refused(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    """One line says what stands where a number should."""
    path = module(tmp_path)
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    with pytest.raises(InvalidRobotError, match=message) as error:
        open_robot(path)
    assert "\n" not in str(error.value)
