"""Which robots an atlas is of: files, folders of files, and names of the library."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from cuspaudit.auditing.check import robot_files
from cuspaudit.errors import InvalidInputError, InvalidRobotError
from cuspaudit.robot.descriptions import description_file, description_names
from cuspaudit.robot.formats.registry import endings, holds_robot
from cuspaudit.robot.library import library
from cuspaudit.robot.ssik_arms import ssik_arms

__all__ = ["robot_sources"]


def robot_sources(sources: Iterable[str], known: bool = False) -> list[str]:
    """The robots among ``sources``, in their order, none twice.

    Args:
        sources: files and folders, or names that the library knows.
        known: also every robot of the library, by its name.

    Raises:
        InvalidInputError: no such file or folder, or one without a robot file.
    """
    names = dict(library())
    found: list[str] = []
    for source in sources:
        path = Path(source)
        if path.is_dir():
            found += _in_folder(path)
        elif path.is_file() or source not in names:
            found += [str(file) for file in robot_files([path])]
        else:
            found.append(source)
    if known:
        found += [*names, *ssik_arms()]
        found += [name for name in description_names() if _is_fetched(name)]
    return list(dict.fromkeys(found))


def _in_folder(folder: Path) -> list[str]:
    files = sorted(filter(holds_robot, folder.iterdir()))
    if not files:
        raise InvalidInputError(
            file=str(folder),
            found="no robot file",
            expected=f"name files or a folder with {', '.join(endings())}",
        )
    return [str(file) for file in files]


def _is_fetched(name: str) -> bool:
    try:
        return description_file(name) is not None
    except InvalidRobotError:
        return False
