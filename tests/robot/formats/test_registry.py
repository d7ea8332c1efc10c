"""The list of formats is all that the doors know of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from cuspaudit.auditing.check import robot_files
from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats import registry
from cuspaudit.robot.formats.format import Choices, Format
from cuspaudit.robot.formats.read_robot import chains_in, read_robot
from cuspaudit.robot.formats.registry import FORMATS, endings, format_of, is_recorded
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.robot import Robot


def test_an_ending_belongs_to_one_format(tmp_path: Path) -> None:
    """No two formats share an ending but .xml, where the file's beginning chooses."""
    assert len(set(endings())) == len(endings())
    for known in FORMATS:
        assert set(known.recorded) <= set(known.endings)
        for ending in known.endings:
            if ending != ".xml":
                assert format_of(Path("arm" + ending.upper())) is known
    for name, beginning in (
        ("MJCF", "<mujoco/>"),
        ("SDF model", "<sdf/>"),
        ("URDF", "<robot/>"),
    ):
        file = tmp_path / "arm.XML"
        file.write_text(beginning)
        found = format_of(file)
        assert found is not None
        assert found.name == name


def test_an_unknown_ending_is_told_the_known_ones(tmp_path: Path) -> None:
    """The message lists every ending that is read."""
    file = tmp_path / "arm.step"
    file.write_text("")
    with pytest.raises(InvalidRobotError) as caught:
        read_robot(file)
    assert all(ending in str(caught.value) for ending in endings())


def test_a_family_is_no_robot(tmp_path: Path) -> None:
    """A YAML file without joints of its own is not taken for a robot's."""
    family, robot = tmp_path / "family.yaml", tmp_path / "robot.yaml"
    family.write_text("family: f\nrobot:\n  joints: []\n")
    robot.write_text("convention: standard\njoints:\n  - {a: 1}\n")
    assert not is_recorded(family)
    assert is_recorded(robot)
    assert not is_recorded(tmp_path / "robot.urdf")


def test_one_line_adds_a_format(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A format that the list has is read, listed, opened and checked."""
    seen: list[Choices] = []

    def read(path: Path, choices: Choices) -> Robot:
        seen.append(choices)
        return Robot("new", str(path), Chain("new", (), task="position"))

    new = Format("new", (".new",), read, recorded=(".new",))
    monkeypatch.setattr(registry, "FORMATS", (*FORMATS, new))
    file = tmp_path / "arm.new"
    file.write_text("")
    assert read_robot(file, tip="hand").name == "new"
    assert seen == [Choices(tip="hand")]
    assert chains_in(file) == []
    assert open_robot(file, square=False).name == "new"
    assert robot_files([tmp_path]) == [file]
