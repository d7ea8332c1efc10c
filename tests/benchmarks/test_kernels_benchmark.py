"""The share of msolve and FLINT in Algorithm 1 on the arm of the paper.

``pytest tests/benchmarks/test_kernels_benchmark.py --benchmark-only -s``, with Linux
perf: a profiler inside Python sees neither the operators of FLINT nor msolve. GMP and
MPFR count as theirs, the C library and NumPy do not.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

SYSTEMS = Path(__file__).parent.parent / "systems"
KERNELS = ("libflint", "libgmp", "libmpfr", "libneogb", "libmsolve", "msolve")


@pytest.mark.skipif(shutil.which("perf") is None, reason="needs perf")
def test_half_of_the_printed_map_is_spent_in_kernels(
    benchmark: Any, tmp_path: Path
) -> None:
    """Of all samples on the processor, at least half lie in msolve and FLINT."""
    data = tmp_path / "perf.data"
    file = SYSTEMS / "issac-2022-printed.yaml"
    decide = ("-m", "cuspaudit", "decide", "--complete", file)
    record = ("perf", "record", "-q", "-F", "100", "-o", data, "--", sys.executable)

    def run() -> None:
        ended = subprocess.run([*record, *decide], check=False, capture_output=True)
        assert ended.returncode == 1, ended.stderr.decode()

    benchmark.pedantic(run, rounds=1)
    shares = shares_by_library(data)
    share = sum(part for name, part in shares.items() if name.startswith(KERNELS))
    benchmark.extra_info["share"] = share
    print(", ".join(f"{name} {part:.1f} %" for name, part in list(shares.items())[:6]))
    assert share >= 50


def shares_by_library(data: Path) -> dict[str, float]:
    """Library -> percent of the samples, the largest first."""
    report = ("perf", "report", "-i", data, "--sort", "dso", "--stdio", "-q", "-t", ",")
    text = subprocess.run(report, check=True, capture_output=True, text=True).stdout
    rows = (line.split(",") for line in text.splitlines() if "," in line)
    return {name.strip(): float(part.strip(" %")) for part, name in rows}
