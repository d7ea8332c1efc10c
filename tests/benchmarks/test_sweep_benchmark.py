"""A sweep of random orthogonal 3R arms: what a member costs, and the rate.

``pytest tests/benchmarks/test_sweep_benchmark.py --benchmark-only -s`` prints processor
times, which other work on the machine hardly changes, beside the rates on the clock;
``CUSPAUDIT_RECORD=verdict`` records the verdict alone instead of all counts;
``CUSPAUDIT_MEMBERS=1000`` makes it the full run. No limit is held here.
"""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

from cuspaudit.family.family_file import read_family
from cuspaudit.family.row import decide_member
from cuspaudit.family.sweep import sweep

RECORD = os.environ.get("CUSPAUDIT_RECORD", "")
MEMBERS = int(os.environ.get("CUSPAUDIT_MEMBERS", "40"))
FAMILY = """\
family: orthogonal-3r
robot:
  convention: standard
  units: m
  task: position
  joints:
    - {{type: revolute, a: 1,  alpha: -pi/2, d: 0}}
    - {{type: revolute, a: a2, alpha: pi/2,  d: d2}}
    - {{type: revolute, a: a3, alpha: 0,     d: 0}}
parameters:
  a2: {{random: [0.2, 3], count: {count}}}
  a3: {{random: [0.2, 4], count: {count}}}
  d2: {{random: [0.1, 2], count: {count}}}
seed: 2022
"""
if RECORD:
    FAMILY += f"record: {RECORD}\n"


def timed(file: Path, folder: Path, workers: int) -> tuple[float, float]:
    """Members a second once rows come, and our own processor seconds a member."""
    clock: list[float] = []
    processor = time.process_time()
    sweep(file, folder, workers, lambda done, size: clock.append(time.perf_counter()))
    assert len(clock) == MEMBERS
    hands = (time.process_time() - processor) / MEMBERS
    return (MEMBERS - 1) / (clock[-1] - clock[0]), hands


def test_sweeping_random_arms(benchmark: Any, tmp_path: Path) -> None:
    """Processor seconds a member and of the hand-out, and members a second."""
    file = tmp_path / "family.yaml"
    file.write_text(FAMILY.format(count=MEMBERS))
    family = read_family(file)
    decide_member(family, 0)
    start = time.process_time()
    for index in range(min(MEMBERS, 40)):
        decide_member(family, index)
    member = (time.process_time() - start) / min(MEMBERS, 40)
    one, _ = timed(file, tmp_path / "one", 1)
    two, hands = benchmark.pedantic(timed, (file, tmp_path / "two", 2), rounds=1)
    found = {
        "processor_seconds_a_member": round(member, 4),
        "processor_seconds_to_hand_out": round(hands, 4),
        "members_a_second_on_one": round(one, 1),
        "members_a_second_on_two": round(two, 1),
        "scaling": round(two / one, 2),
        "scaling_by_processor": round((member + hands) / (member / 2 + hands), 2),
    }
    benchmark.extra_info.update(found)
    print(found)
