"""URDF files as a format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from cuspaudit.robot.formats.format import Choices, Format
from cuspaudit.robot.robot import Robot

if TYPE_CHECKING:
    from cuspaudit.robot.formats.choice import Candidate

__all__ = ["URDF"]


def _read(path: Path, choices: Choices) -> Robot:
    from cuspaudit.robot.formats.urdf.read import read_urdf

    return read_urdf(path, base=choices.base, tip=choices.tip, task=choices.task)


def _chains(path: Path, choices: Choices) -> list[Candidate]:
    from cuspaudit.robot.formats.urdf.read import urdf_candidates

    return urdf_candidates(path, choices.base)


URDF = Format(name="URDF", endings=(".urdf", ".xml"), read=_read, chains=_chains)
