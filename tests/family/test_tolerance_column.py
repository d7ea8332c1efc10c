"""The largest tolerance of each member of a family."""

from __future__ import annotations

from pathlib import Path

import pytest

from cuspaudit.family.family_file import read_family
from cuspaudit.family.row import decide_member

FAMILY = """
family: two
robot:
  convention: standard
  units: m
  task: position
  joints:
    - {type: revolute, a: 1, alpha: pi/2, d: 0}
    - {type: revolute, a: 2, alpha: -pi/2, d: 1}
    - {type: revolute, a: a3, alpha: 0, d: 0}
parameters:
  a3: {values: ["3/2", "1/5"]}
record: [tolerance]
"""


@pytest.mark.slow
def test_a_sweep_records_the_largest_tolerance(tmp_path: Path) -> None:
    """Of the cuspidal member a number; of one that needs square axes none."""
    file = tmp_path / "family.yaml"
    file.write_text(FAMILY)
    family = read_family(file)
    first, second = (decide_member(family, index) for index in range(2))
    assert first.get("error") is None, first
    assert first["verdict"] == "cuspidal"
    assert 1e-4 < first["tolerance"] < 1e-2
    assert second["verdict"] == "noncuspidal"
    assert second["tolerance"] is None
