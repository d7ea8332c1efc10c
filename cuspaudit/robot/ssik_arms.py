"""Arms of the package ssik, if it is installed: its modules are read, not imported."""

from __future__ import annotations

import importlib.util
from pathlib import Path

__all__ = ["ssik_arms"]


def ssik_arms(folder: Path | None = None) -> dict[str, Path]:
    """Name to module of each arm, as maker-model; empty without the package.

    Args:
        folder: of the package; by default where it is installed.
    """
    folder = _installed() if folder is None else folder
    if folder is None:
        return {}
    modules = sorted((folder / "prebuilt").glob("*/*_ik.py"))
    return {_name(module): module for module in modules}


def _name(module: Path) -> str:
    maker = module.parent.name.replace("_", "-")
    return f"{maker}-{module.stem.removesuffix('_ik').replace('_', '-')}"


def _installed() -> Path | None:
    spec = importlib.util.find_spec("ssik")
    places = spec.submodule_search_locations if spec else None
    return Path(next(iter(places))) if places else None
