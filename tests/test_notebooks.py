"""The lessons run whole, and are stored without outputs."""

from __future__ import annotations

import ast
import re
import time
from importlib import import_module
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

import cuspaudit

ROOT = Path(__file__).parents[1]
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
ON_THE_ALGORITHM = ("01-the-papers-example", "04-a-map-of-your-own")


def read(path: Path) -> nbformat.NotebookNode:
    """The notebook in a file."""
    return nbformat.read(path, as_version=4)


def nodes(path: Path) -> list[ast.AST]:
    """The syntax of the code cells of a notebook."""
    cells = (c.source for c in read(path).cells if c.cell_type == "code")
    return [node for cell in cells for node in ast.walk(ast.parse(cell))]


def imports(path: Path) -> set[tuple[str, str]]:
    """What a notebook imports of the package: modules ("" for all of one) and names."""
    found = set()
    for node in nodes(path):
        if isinstance(node, ast.Import):
            found |= {(alias.name, "") for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found |= {(node.module or "", alias.name) for alias in node.names}
    return {(m, name) for m, name in found if m.partition(".")[0] == "cuspaudit"}


def documented_names() -> set[tuple[str, str]]:
    """Module and name of each routine and type of the paper in `docs/symbols.md`."""
    text = (ROOT / "docs" / "symbols.md").read_text()
    found = set()
    for dotted in re.findall(r"`([a-z]\w*(?:\.\w+)+)`", text):
        room, _, name = dotted.rpartition(".")
        own = (ROOT / "cuspaudit" / dotted.replace(".", "/")).with_suffix(".py")
        found.add((f"cuspaudit.{dotted if own.is_file() else room}", name))
    return found


def test_there_are_lessons() -> None:
    """The folder of notebooks was found."""
    assert NOTEBOOKS


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_lesson_is_stored_without_outputs(path: Path) -> None:
    """No output, no run number and no metadata but the kernel's is in the file."""
    notebook = read(path)
    assert set(notebook.metadata) <= {"kernelspec", "language_info"}
    for cell in notebook.cells:
        assert not cell.metadata
        if cell.cell_type == "code":
            assert not cell.outputs
            assert cell.execution_count is None


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_lesson_uses_public_names_only(path: Path) -> None:
    """`cuspaudit` itself, and on the algorithm the names that `docs/symbols.md` has."""
    used = imports(path)
    allowed = documented_names() if path.stem in ON_THE_ALGORITHM else set()
    assert used - {("cuspaudit", "")} <= allowed
    assert ("cuspaudit", "") in used
    attributes = [node for node in nodes(path) if isinstance(node, ast.Attribute)]
    of_package = {
        node.attr
        for node in attributes
        if isinstance(node.value, ast.Name) and node.value.id in ("cu", "cuspaudit")
    }
    assert of_package
    assert of_package <= set(cuspaudit.__all__)
    assert not [node.attr for node in attributes if node.attr.startswith("_")]


def test_the_paper_s_names_are_where_the_symbols_say() -> None:
    """Each name in `docs/symbols.md` is public in the module that it names."""
    names = documented_names()
    assert ("cuspaudit.geometry.crit", "crit") in names
    for module, name in names:
        assert name in import_module(module).__all__


def test_what_a_lesson_imports_is_seen(tmp_path: Path) -> None:
    """An import of the package under another name, or of a room of it, is found."""
    cell = nbformat.v4.new_code_cell(
        "import cuspaudit\nimport cuspaudit.robot.chain as c\n"
        "def inside():\n    from cuspaudit.errors import CuspauditError as E\n"
        "import numpy as np\nfrom flint import arb"
    )
    file = tmp_path / "lesson.ipynb"
    nbformat.write(nbformat.v4.new_notebook(cells=[cell]), file)
    assert imports(file) == {
        ("cuspaudit", ""),
        ("cuspaudit.robot.chain", ""),
        ("cuspaudit.errors", "CuspauditError"),
    }


@pytest.mark.slow
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_lesson_runs_whole(path: Path, tmp_path: Path) -> None:
    """Every cell of a lesson runs, its asserts hold, and it takes under a minute."""
    client = NotebookClient(
        read(path),
        timeout=60,
        kernel_name="python3",
        resources={"metadata": {"path": str(tmp_path)}},
    )
    start = time.perf_counter()
    client.execute()
    assert time.perf_counter() - start < 60
