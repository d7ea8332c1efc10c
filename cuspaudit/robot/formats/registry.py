"""The formats a robot is read from.

To add one: a package beside this file with a `Format` of its own, and a line here.
"""

from __future__ import annotations

from pathlib import Path

from cuspaudit.robot.formats.dh.format import DH
from cuspaudit.robot.formats.format import Format
from cuspaudit.robot.formats.mjcf.format import MJCF
from cuspaudit.robot.formats.sdf.format import SDF
from cuspaudit.robot.formats.ssik.format import SSIK
from cuspaudit.robot.formats.urdf.format import URDF
from cuspaudit.robot.formats.xacro.format import XACRO

__all__ = [
    "FORMATS",
    "endings",
    "format_of",
    "holds_robot",
    "is_recorded",
    "recorded_endings",
]

FORMATS: tuple[Format, ...] = (DH, MJCF, SDF, SSIK, URDF, XACRO)


def format_of(path: Path) -> Format | None:
    """The format of a file, by the ending of its name; None for an unknown one.

    Of two formats with one ending the file's beginning chooses.
    """
    ending = path.suffix.lower()
    known = [each for each in FORMATS if ending in each.endings]
    if len(known) > 1:
        known = [each for each in known if each.is_robot(path)]
    return known[0] if known else None


def holds_robot(path: Path) -> bool:
    """Whether a file is of a format, by its ending and a look at it."""
    known = format_of(path)
    return known is not None and path.is_file() and known.is_robot(path)


def endings() -> tuple[str, ...]:
    """The endings of all robot files."""
    return tuple(dict.fromkeys(e for known in FORMATS for e in known.endings))


def recorded_endings() -> tuple[str, ...]:
    """The endings of the files that may say what is expected of their robot."""
    return tuple(ending for known in FORMATS for ending in known.recorded)


def is_recorded(path: Path) -> bool:
    """Whether a file holds a robot and may say what is expected of it."""
    known = format_of(path)
    if known is None or path.suffix.lower() not in known.recorded:
        return False
    return known.is_robot(path)
