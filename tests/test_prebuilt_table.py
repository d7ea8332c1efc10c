"""The table of the arms that ssik carries."""

from __future__ import annotations

from pathlib import Path

from prebuilt_table import show, table
from ssik_module import module


def test_the_table_counts_verdicts_by_class(tmp_path: Path) -> None:
    """A small arm with a spherical wrist is audited and counted."""
    module(tmp_path)
    rows = list(table(tmp_path, 5.0))
    assert show(rows) == "6 joints, spherical wrist: 1 noncuspidal"
