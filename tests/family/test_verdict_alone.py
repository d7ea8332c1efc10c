"""A sweep that records the verdict alone."""

from __future__ import annotations

from pathlib import Path

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
    row = decide_member(read_family(file), 1)
    file.write_text(FAMILY)
    assert row["aspects"] == decide_member(read_family(file), 1)["aspects"]
