"""What a format is: which files are of it, and how a robot is read from one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING

from cuspaudit.robot.robot import Robot

if TYPE_CHECKING:
    from cuspaudit.robot.formats.choice import Candidate

__all__ = ["MOST_JOINTS", "Choices", "Format"]

MOST_JOINTS = 50
"""No format reads a longer chain."""


@dataclass(frozen=True)
class Choices:
    """What a reader is told beside the file; None where the file decides.

    Attributes:
        base: the link that the chain begins at.
        tip: the link that it ends at.
        task: a name in `robot.task.DIMENSIONS`.
        convention: "standard" or "modified", for a table that does not say.
        angle_unit: "rad" or "deg", for a table that does not say.
        length_unit: "m" or "mm", for a table that does not say.
        packages: name to folder, for a file that finds packages by name.
        xacro_args: name to text, for a file that asks for arguments.
    """

    base: str | None = None
    tip: str | None = None
    task: str | None = None
    convention: str | None = None
    angle_unit: str | None = None
    length_unit: str | None = None
    packages: Mapping[str, str] | None = None
    xacro_args: Mapping[str, str] | None = None

    def given(self) -> list[str]:
        """The names of those that are told."""
        return [each.name for each in fields(self) if getattr(self, each.name)]


def _any(path: Path) -> bool:
    return True


@dataclass(frozen=True)
class Format:
    """A format of robot files.

    Attributes:
        name: of the format.
        endings: of its files' names, in lower case.
        read: the robot in a file.
        chains: the serial chains of a file, from a base link or the root, likely ones
            first; None for a format that holds one chain and no links.
        recorded: those of the endings whose files may say what is expected of them.
        is_robot: whether a file with such an ending holds a robot, by a look at it.
        takes: the choices beside the task that its reader uses; others are refused.
    """

    name: str
    endings: tuple[str, ...]
    read: Callable[[Path, Choices], Robot]
    chains: Callable[[Path, Choices], list[Candidate]] | None = None
    recorded: tuple[str, ...] = ()
    is_robot: Callable[[Path], bool] = _any
    takes: tuple[str, ...] = ("base", "tip")
