"""Small families for tests, and the command that sweeps them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pyarrow.parquet as pq

ORTHOGONAL = """\
family: orthogonal-3r
robot:
  convention: standard
  units: m
  task: position
  joints:
    - {type: revolute, a: 1,  alpha: -pi/2, d: 0}
    - {type: revolute, a: a2, alpha: pi/2,  d: d2}
    - {type: revolute, a: a3, alpha: 0,     d: 0}
"""

UR_PATTERN = """\
family: ur-pattern
robot:
  convention: standard
  units: m
  task: pose
  joints:
    - {type: revolute, a: 0,    alpha: pi/2,  d: 0.089159}
    - {type: revolute, a: -a2,  alpha: 0,     d: 0}
    - {type: revolute, a: -a3,  alpha: 0,     d: 0}
    - {type: revolute, a: 0,    alpha: pi/2,  d: 0.10915}
    - {type: revolute, a: 0,    alpha: -pi/2, d: d5}
    - {type: revolute, a: 0,    alpha: 0,     d: 0.0823}
"""


def ur_family(steps: int) -> str:
    """A family of ``steps`` quick members (a theorem decides each)."""
    return UR_PATTERN + (
        f"parameters: {{a2: {{range: [0.2, 0.7], steps: {steps}}}, "
        "a3: {values: [0.4]}, d5: {values: [0.09]}}\n"
    )


def command(family: Path, folder: Path, *more: str) -> list[str]:
    """The command that sweeps ``family`` into ``folder``."""
    words = ["-m", "cuspaudit", "sweep", str(family), "-o", str(folder), *more]
    return [sys.executable, *words]


def swept(family: Path, folder: Path, *more: str) -> subprocess.CompletedProcess[str]:
    """The sweep, run to its end."""
    return subprocess.run(
        command(family, folder, *more), capture_output=True, text=True, check=False
    )


def table(folder: Path) -> list[dict[str, object]]:
    """The rows of a sweep by index, without the times."""
    rows = pq.read_table(folder / "results.parquet").to_pylist()
    for row in rows:
        del row["seconds"]
    return sorted(rows, key=lambda row: row["index"])
