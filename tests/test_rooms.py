"""The rooms and their arrows, read from the imports themselves."""

from __future__ import annotations

import ast
from pathlib import Path

import networkx as nx
import pytest

import cuspaudit

ROOT = Path(cuspaudit.__file__).parent
BASE = {"errors", "count", "runtime"}
GEOMETRY = BASE | {"algebra", "geometry"}
DECISION = GEOMETRY | {"surface", "cuspidality"}
MODEL = BASE | {"algebra", "robot", "kinematics"}
AUDIT = DECISION | MODEL | {"certificate", "parallel", "auditing"}
ALLOWED = {
    "errors": set(),
    "count": set(),
    "runtime": {"errors"},
    "algebra": BASE,
    "geometry": GEOMETRY,
    "surface": GEOMETRY,
    "cuspidality": DECISION,
    "certificate": {"errors"},
    "certificate_js": set(),
    "robot": BASE | {"algebra"},
    "parallel": BASE | {"algebra", "robot"},
    "kinematics": MODEL,
    "auditing": AUDIT,
    "toolpath": AUDIT | {"toolpath"},
    "family": AUDIT,
    "viz": {"errors", "certificate", "certificate_js", "robot"},
    "pictures": AUDIT | {"toolpath", "viz"},
    "atlas": AUDIT | {"viz", "pictures"},
    "api": AUDIT | {"toolpath", "family", "viz", "pictures"},
    "cli": AUDIT | {"toolpath", "family", "viz", "pictures", "atlas", "api"},
    "pytest_plugin": {"auditing", "robot"},
}
OWNERS = {
    "sympy": {"algebra"},
    "flint": {
        *("algebra", "geometry", "surface", "cuspidality"),
        *("certificate", "robot", "parallel", "kinematics", "family", "toolpath"),
    },
    "networkx": {"geometry", "surface"},
    "yourdfpy": {"robot"},
    "xacro": {"robot"},
    "xacrodoc": {"robot"},
    "meshcat": {"viz"},
    "matplotlib": {"viz"},
    "pinocchio": {"auditing"},
    "pyarrow": {"family"},
    "distributed": {"family", "atlas"},
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


def module_name(path: Path) -> str:
    """The dotted name of a module; of a package without its ``__init__``."""
    parts = ("cuspaudit", *path.relative_to(ROOT).with_suffix("").parts)
    return ".".join(parts).removesuffix(".__init__")


def test_no_module_imports_itself_through_others() -> None:
    """Inside a room too, imports go one way: the modules have an order."""
    names = {module_name(path) for path in MODULES}
    graph: nx.DiGraph[str] = nx.DiGraph()
    for path in MODULES:
        if path.name != "__init__.py":
            for name in imports(path):
                target = name if name in names else name.rpartition(".")[0]
                graph.add_edge(module_name(path), target)
    assert graph.number_of_edges() > len(MODULES)
    assert [c for c in nx.strongly_connected_components(graph) if len(c) > 1] == []


def test_tests_stand_where_their_rooms_do() -> None:
    """A folder of tests has its room, and a folder inside it the same folder there."""
    here = Path(__file__).parent
    others = {"benchmarks", "conformance", "fuzz", "systems"}
    folders = {p.parent.relative_to(here) for p in here.rglob("test_*.py")}
    mirrored = [f for f in folders if f.parts and f.parts[0] not in others]
    assert len(mirrored) > 20
    assert [str(f) for f in mirrored if not (ROOT / f).is_dir()] == []


def test_no_two_test_files_have_one_name() -> None:
    """Tests are collected by base name: of two alike one would not be run."""
    names = [path.name for path in Path(__file__).parent.rglob("test_*.py")]
    assert sorted(names) == sorted(set(names))
