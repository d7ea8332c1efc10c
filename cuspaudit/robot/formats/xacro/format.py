"""xacro files as a format: expanded, then read as URDF."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.formats.format import Choices, Format
from cuspaudit.robot.robot import Robot

if TYPE_CHECKING:
    from cuspaudit.robot.formats.choice import Candidate

__all__ = ["XACRO"]


@contextmanager
def _as_urdf(path: Path, choices: Choices) -> Iterator[Path]:
    """A URDF that the file expands to; errors about it name the file itself."""
    from cuspaudit.robot.formats.xacro.expand import expanded

    text = expanded(path, choices.packages or {}, choices.xacro_args or {})
    with tempfile.TemporaryDirectory() as folder:
        urdf = Path(folder) / f"{path.stem}.urdf"
        urdf.write_text(text, encoding="utf-8")
        try:
            yield urdf
        except InvalidRobotError as error:
            error.args = (str(error).replace(str(urdf), str(path)),)
            error.file = str(path)
            raise


def _read(path: Path, choices: Choices) -> Robot:
    from cuspaudit.robot.formats.urdf.read import read_urdf

    with _as_urdf(path, choices) as urdf:
        robot = read_urdf(urdf, choices.base, choices.tip, choices.task)
    given = [f"{name}={text}" for name, text in (choices.xacro_args or {}).items()]
    note = f"expanded by xacro, {', '.join(given) or 'without arguments'}"
    return replace(robot, file=str(path), urdf=None, notes=(note, *robot.notes))


def _chains(path: Path, choices: Choices) -> list[Candidate]:
    from cuspaudit.robot.formats.urdf.read import urdf_candidates

    with _as_urdf(path, choices) as urdf:
        return urdf_candidates(urdf, choices.base)


XACRO = Format(
    name="xacro file",
    endings=(".xacro",),
    read=_read,
    chains=_chains,
    takes=("base", "tip", "packages", "xacro_args"),
)
