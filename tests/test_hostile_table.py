from __future__ import annotations

import os
from pathlib import Path

import pytest
from hostile_table import examine, show, table


@pytest.mark.slow
def test_no_hostile_file_is_answered_otherwise(corpus: Path) -> None:
    """Each of 125 hostile files gets its answer from the command line, in bounds."""
    rows = table(corpus, workers=min(2, os.cpu_count() or 1))
    show(rows)
    assert len(rows) == 125
    assert [(row.file, row.differs) for row in rows if row.differs] == []


def test_the_table_sees_what_a_command_does(corpus: Path) -> None:
    """A row is wrong when its answer is; here a good file that should be refused."""
    row = examine(corpus / "hostile" / "no_joints.urdf", "OK + note")
    assert row.answer == "REFUSED"
    assert row.differs == "answered REFUSED"
