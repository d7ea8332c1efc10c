"""D-H tables as a format."""

from __future__ import annotations

import re
from pathlib import Path

from cuspaudit.robot.formats.dh.endings import LINE_ENDINGS
from cuspaudit.robot.formats.format import Choices, Format
from cuspaudit.robot.robot import Robot

__all__ = ["DH"]

_YAML = (".yaml", ".yml")
_ROBOT = re.compile(rb"^joints[ \t]*:", re.MULTILINE)


def _read(path: Path, choices: Choices) -> Robot:
    from cuspaudit.robot.formats.dh.read import read_dh

    return read_dh(
        path,
        task=choices.task,
        convention=choices.convention,
        angle_unit=choices.angle_unit,
        length_unit=choices.length_unit,
    )


def _is_robot(path: Path) -> bool:
    """Not so a YAML file without joints: a family, say."""
    return path.suffix.lower() not in _YAML or bool(_ROBOT.search(path.read_bytes()))


DH = Format(
    name="D-H table",
    endings=(*_YAML, ".json", *LINE_ENDINGS),
    read=_read,
    recorded=(*_YAML, ".csv"),
    is_robot=_is_robot,
    takes=("convention", "angle_unit", "length_unit"),
)
