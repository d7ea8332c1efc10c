"""Modules of the package ssik as a format."""

from __future__ import annotations

from pathlib import Path

from cuspaudit.robot.formats.format import Choices, Format
from cuspaudit.robot.robot import Robot

__all__ = ["SSIK"]


def _read(path: Path, choices: Choices) -> Robot:
    from cuspaudit.robot.formats.ssik.read import read_module

    return read_module(path, task=choices.task)


def _is_module(path: Path) -> bool:
    return b"_JOINT_T_LEFTS" in path.read_bytes()


SSIK = Format(
    name="ssik module", endings=(".py",), read=_read, is_robot=_is_module, takes=()
)
