"""MJCF files as a format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from cuspaudit.robot.formats.format import Choices, Format
from cuspaudit.robot.robot import Robot

if TYPE_CHECKING:
    from cuspaudit.robot.formats.choice import Candidate

__all__ = ["MJCF"]


def _read(path: Path, choices: Choices) -> Robot:
    from cuspaudit.robot.formats.mjcf.read import read_mjcf

    return read_mjcf(path, base=choices.base, tip=choices.tip, task=choices.task)


def _chains(path: Path, choices: Choices) -> list[Candidate]:
    from cuspaudit.robot.formats.mjcf.read import mjcf_candidates

    return mjcf_candidates(path, choices.base)


def _is_mjcf(path: Path) -> bool:
    from cuspaudit.robot.formats.elements import looks_like
    from cuspaudit.robot.formats.mjcf.elements import MJCF_KINDS

    return path.suffix.lower() == ".mjcf" or looks_like(path, MJCF_KINDS)


MJCF = Format(
    name="MJCF",
    endings=(".mjcf", ".xml"),
    read=_read,
    chains=_chains,
    is_robot=_is_mjcf,
)
