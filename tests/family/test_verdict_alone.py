"""A sweep that records the verdict alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from cuspaudit.family import row
from cuspaudit.family.family_file import read_family
from cuspaudit.family.row import decide_member

FAMILY = """\
family: orthogonal
robot:
  convention: standard
  task: position
  joints:
    - {type: revolute, a: 1,  alpha: -pi/2, d: 0}
    - {type: revolute, a: a2, alpha: pi/2,  d: d2}
    - {type: revolute, a: 2,  alpha: 0,     d: 0}
parameters: {a2: {values: [1/2, 3/2, 3]}, d2: {values: [0, 1/2]}}
"""


def test_the_verdict_alone_is_the_verdict(tmp_path: Path) -> None:
    """With ``record: verdict`` no count is made, and no verdict is another one."""
    full, alone = tmp_path / "full.yaml", tmp_path / "alone.yaml"
    full.write_text(FAMILY)
    alone.write_text(FAMILY + "record: verdict\n")
    every, few = read_family(full), read_family(alone)
    assert few.record == ()
    rows = [(decide_member(every, k), decide_member(few, k)) for k in range(6)]
    assert all(a["verdict"] == b["verdict"] for a, b in rows)
    assert {b["verdict"] for _, b in rows} == {"cuspidal", "noncuspidal"}
    assert all(b["proof"] == "exact" and "cusps" not in b for _, b in rows)


def test_aspects_come_with_the_verdict(tmp_path: Path) -> None:
    """They are counted by the roadmap that tells the ends of a pair."""
    file = tmp_path / "aspects.yaml"
    file.write_text(FAMILY + "record: [aspects]\n")
    found = decide_member(read_family(file), 1)
    file.write_text(FAMILY)
    assert found["aspects"] == decide_member(read_family(file), 1)["aspects"]


def test_counts_without_sample_values_are_those_with(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Cusps, nodes, aspects and postures of cuspidal and noncuspidal members."""
    file = tmp_path / "counts.yaml"
    file.write_text(FAMILY)
    family = read_family(file)
    short = [decide_member(family, k) for k in range(6)]
    monkeypatch.setattr(row, "_counts_alone", lambda family: None)
    full = [decide_member(family, k) for k in range(6)]
    for line in (*short, *full):
        del line["seconds"]
    assert short == full
    assert len({line["cusps"] for line in full}) > 1
