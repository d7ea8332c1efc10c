"""Deciding maps without a robot, and the direct problems of parallel mechanisms.

``pytest tests/benchmarks/test_systems_benchmark.py --benchmark-only -s``; bounds are of
processor time, msolve's included. With ``CUSPAUDIT_COMPLETE=1`` the whole run is made
although a couple was found, as every decision was before couples were looked for first:
62 s for the printed map of the paper's example then, 23 s for a slice of a 3-RPR.
"""

from __future__ import annotations

import os
import resource
from pathlib import Path
from typing import Any

import pytest

from cuspaudit.auditing.systems.file import read_system
from cuspaudit.cuspidality.decision import decide
from cuspaudit.cuspidality.verdict import Verdict

ROOT = Path(__file__).parents[2]
COMPLETE = os.environ.get("CUSPAUDIT_COMPLETE") == "1"
#: seconds at most, couples first
LIMITS = {
    "tests/systems/issac-2022-printed.yaml": 6,
    "tests/systems/issac-2022.yaml": 6,
    "tests/systems/swallowtail.yaml": 2,
    "mechanisms/3-rpr.yaml": 10,
    "mechanisms/3-rpr-slice.yaml": 10,
}


def processor() -> float:
    """Processor time of this process and of the programs it has run, in s."""
    who = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    used = [resource.getrusage(w) for w in who]
    return sum(u.ru_utime + u.ru_stime for u in used)


@pytest.mark.parametrize("name", LIMITS)
def test_deciding_a_cuspidal_map(benchmark: Any, name: str) -> None:
    """From the equations to the verdict, the counts that come with it included."""
    read = read_system(ROOT / name)
    begun = processor()
    run = benchmark.pedantic(
        decide,
        args=(read.variety, read.mapping),
        kwargs={"complete": COMPLETE, "timeout": 600},
        rounds=1,
    )
    assert run.verdict is Verdict.CUSPIDAL
    seconds = benchmark.extra_info["processor"] = processor() - begun
    assert COMPLETE or seconds < LIMITS[name]
