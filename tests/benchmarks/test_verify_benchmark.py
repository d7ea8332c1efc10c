"""How long a certificate takes to verify: at most 1 s, even with 100 segments.

Run with ``pytest tests/benchmarks/test_verify_benchmark.py --benchmark-only``.
"""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import pytest

from cuspaudit.certificate import verify

MADE = runpy.run_path(str(Path(__file__).parents[1] / "certificate/certified_arms.py"))


@pytest.mark.parametrize("segments", [1, 100])
@pytest.mark.parametrize("name", MADE["ARMS"])
def test_verify(benchmark: Any, name: str, segments: int) -> None:
    """A certificate of 1 or 100 segments is accepted, and fast."""
    certificate = MADE["divided"](MADE["ARMS"][name](), segments)
    result = benchmark.pedantic(verify, args=(certificate,), rounds=5, warmup_rounds=1)
    assert result.accepted
    assert benchmark.stats.stats.median < 1
