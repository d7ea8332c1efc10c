"""One door for every robot file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from cuspaudit.robot.formats.dh.lines import LINE_ENDINGS
from cuspaudit.robot.formats.dh.read import read_dh
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.robot import Robot

if TYPE_CHECKING:
    from cuspaudit.robot.formats.choice import Candidate

__all__ = ["TABLES", "chains_in", "read_robot"]

TABLES = (".yaml", ".yml", ".json", *LINE_ENDINGS)

_TREES = (".urdf", ".xml", ".xacro")


def chains_in(path: Path | str, base: str | None = None) -> list[Candidate]:
    """The serial chains of a file, likely ones first; a table has none to choose from.

    Raises:
        InvalidRobotError: the file cannot be read, or several links may be its base.
    """
    path = Path(path)
    if path.suffix.lower() not in _TREES:
        return []
    from cuspaudit.robot.formats.urdf.read import urdf_candidates

    return urdf_candidates(path, base)


def read_robot(
    path: Path | str,
    *,
    base: str | None = None,
    tip: str | None = None,
    task: str | None = None,
    convention: str | None = None,
    angle_unit: str | None = None,
    length_unit: str | None = None,
) -> Robot:
    """The robot in a URDF or D-H file, by the ending of its name.

    Args:
        path: a .urdf file, or one whose ending is in `TABLES`.
        base: a link of the URDF; by default its root.
        tip: a link of the URDF; by default its only end.
        task: a name in `robot.task.DIMENSIONS`; by default the one for so many
            joints.
        convention: "standard" or "modified", for a table that does not say.
        angle_unit: "rad" or "deg", for a table that does not say.
        length_unit: "m" or "mm", for a table that does not say.

    Raises:
        InvalidRobotError: the file cannot be read as it stands, or an option does
            not belong to this kind of file.
    """
    path = Path(path)
    place = Place(str(path))
    if path.suffix.lower() in TABLES:
        if base is not None or tip is not None:
            expected = "leave out --base and --tip: a table is one chain"
            raise place.error("a table has no links to choose from", expected)
        return read_dh(
            path,
            task=task,
            convention=convention,
            angle_unit=angle_unit,
            length_unit=length_unit,
        )
    if path.suffix.lower() in _TREES:
        from cuspaudit.robot.formats.urdf.read import read_urdf

        return read_urdf(path, base=base, tip=tip, task=task)
    found = f"files ending in {quoted(path.suffix)} are unknown"
    raise place.error(found, f"give a .urdf, {', '.join(TABLES)} file")
