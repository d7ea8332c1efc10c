"""The rooms and their arrows, read from the imports themselves."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import cuspaudit

ROOT = Path(cuspaudit.__file__).parent
ALLOWED = {
    "errors": set(),
    "algebra": {"errors"},
    "geometry": {"errors", "algebra"},
    "surface": {"errors", "algebra", "geometry"},
    "cuspidality": {"errors", "algebra", "geometry", "surface"},
    "certificate": {"errors"},
    "kinematics": {"errors", "algebra"},
    "viz": {"errors", "certificate", "kinematics"},
    "audit": {
        *("errors", "algebra", "geometry", "surface", "cuspidality"),
        *("certificate", "kinematics"),
    },
    "cli": {"errors", "audit", "certificate", "kinematics", "viz"},
    "pytest_plugin": {"audit"},
}
OWNERS = {
    "sympy": {"algebra"},
    "flint": {
        *("algebra", "geometry", "surface", "cuspidality"),
        *("certificate", "kinematics"),
    },
    "networkx": {"geometry", "surface"},
    "yourdfpy": {"kinematics"},
    "meshcat": {"viz"},
    "matplotlib": {"viz"},
    "pinocchio": {"audit"},
    "pyarrow": {"audit"},
    "distributed": {"audit"},
    "pytest": {"pytest_plugin"},
}


def room_of(path: Path) -> str:
    """The room of a module: its folder, or its own name."""
    parts = path.relative_to(ROOT).parts
    return parts[0] if len(parts) > 1 else path.stem


def imports(path: Path) -> set[str]:
    """Everything a module imports, type-only imports too."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: write imports in full"
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


MODULES = sorted(p for p in ROOT.rglob("*.py") if room_of(p) in ALLOWED)


@pytest.mark.parametrize("path", MODULES, ids=lambda p: str(p.relative_to(ROOT)))
def test_imports_point_one_way(path: Path) -> None:
    """A room imports only from the rooms its arrow allows, type-only imports too."""
    room = room_of(path)
    for name in imports(path):
        head, *rest = name.split(".")
        if head == "cuspaudit" and rest and rest[0] != "__version__":
            assert rest[0] in ALLOWED[room] | {room}, f"{room} imports {name}"


@pytest.mark.parametrize("path", MODULES, ids=lambda p: str(p.relative_to(ROOT)))
def test_each_heavy_dependency_has_its_owner(path: Path) -> None:
    """A heavy library is imported by the room that owns it and by no other."""
    for name in imports(path):
        head = name.split(".")[0]
        if head in OWNERS:
            assert room_of(path) in OWNERS[head], f"{name} in {room_of(path)}"
