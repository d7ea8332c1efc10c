"""Arms of the package robot_descriptions, if it is installed (`pip install` it).

Its modules clone a git repository when they are imported. Nothing is cloned here: an
arm whose repository is not in the package's cache is refused with the command that
fetches it.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
from pathlib import Path
from typing import Any

from cuspaudit.errors import InvalidRobotError

__all__ = ["description_file", "description_names"]

_PACKAGE = "robot_descriptions"


def description_names() -> list[str]:
    """The arms that the package describes by URDF, empty when it is not installed."""
    return sorted(
        name
        for name, description in _descriptions().items()
        if description.has_urdf and "arm" in description.tags
    )


def description_file(name: str) -> Path | None:
    """The URDF of the description ``name``, None when the package has none.

    Raises:
        InvalidRobotError: its repository is not in the cache, or it is a xacro.
    """
    description = _descriptions().get(name)
    if description is None or not description.has_urdf:
        return None
    if not _is_cached(description.repository):
        raise InvalidRobotError(
            file=name,
            found="its git repository has not been fetched",
            expected=f"fetch it (network): robot_descriptions pull {name}",
        )
    path = getattr(importlib.import_module(f"{_PACKAGE}.{name}"), "URDF_PATH", None)
    if path is None:
        raise InvalidRobotError(
            file=name,
            found="it is a xacro",
            expected="expand it: xacro FILE > robot.urdf, and give that file",
        )
    return Path(path)


def _descriptions() -> dict[str, Any]:
    if importlib.util.find_spec(_PACKAGE) is None:
        return {}
    found: dict[str, Any] = importlib.import_module(_PACKAGE).DESCRIPTIONS
    return found


def _is_cached(repository: str | None) -> bool:
    known = importlib.import_module(f"{_PACKAGE}._repositories").REPOSITORIES
    if repository not in known:
        return False
    folder = os.environ.get("ROBOT_DESCRIPTIONS_CACHE", "~/.cache/robot_descriptions")
    path = Path(folder).expanduser() / str(known[repository].cache_path)
    return path.is_dir()
