"""SDF files as a format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from cuspaudit.robot.formats.format import Choices, Format
from cuspaudit.robot.robot import Robot

if TYPE_CHECKING:
    from cuspaudit.robot.formats.choice import Candidate

__all__ = ["SDF"]


def _read(path: Path, choices: Choices) -> Robot:
    from cuspaudit.robot.formats.sdf.read import read_sdf

    return read_sdf(path, base=choices.base, tip=choices.tip, task=choices.task)


def _chains(path: Path, choices: Choices) -> list[Candidate]:
    from cuspaudit.robot.formats.sdf.read import sdf_candidates

    return sdf_candidates(path, choices.base)


def _is_sdf(path: Path) -> bool:
    from cuspaudit.robot.formats.elements import looks_like
    from cuspaudit.robot.formats.sdf.elements import SDF_KINDS

    return path.suffix.lower() != ".xml" or looks_like(path, SDF_KINDS)


SDF = Format(
    name="SDF model",
    endings=(".sdf", ".world", ".xml"),
    read=_read,
    chains=_chains,
    is_robot=_is_sdf,
)
