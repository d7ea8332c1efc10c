"""The lessons run whole, and are stored without outputs."""

from __future__ import annotations

import re
import time
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

import cuspaudit

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))


def read(path: Path) -> nbformat.NotebookNode:
    """The notebook in a file."""
    return nbformat.read(path, as_version=4)


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


@pytest.mark.parametrize("name", ["02-auditing-a-cobot", "03-families"])
def test_a_users_lesson_imports_public_names_only(name: str) -> None:
    """Lessons for users need `cuspaudit` itself; the others open up what is inside."""
    (path,) = (path for path in NOTEBOOKS if path.stem == name)
    code = "\n".join(c.source for c in read(path).cells if c.cell_type == "code")
    assert "import cuspaudit as cu" in code
    assert not re.search(r"cuspaudit\.\w+ import|import cuspaudit\.", code)
    assert set(re.findall(r"\bcu\.(\w+)", code)) <= set(cuspaudit.__all__)


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
