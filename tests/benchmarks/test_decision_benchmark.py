"""Deciding a three-joint arm, import and cross-check aside, one core.

``pytest tests/benchmarks/test_decision_benchmark.py --benchmark-only -s`` prints the
median and the worst of 100 arms, with everything that Algorithm 1 gives and for the
verdict alone; no limit is held here.
"""

from __future__ import annotations

import random
import statistics
import time
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest
from short_tables import arm

from cuspaudit.cuspidality.surface_decision import SurfaceDecision, decide_surface
from cuspaudit.cuspidality.tile_decision import TileDecision, decide_by_tiles
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.robot.chain import Chain


def hundred() -> list[tuple[str, Chain]]:
    """Fifty orthogonal and fifty general arms, seeded."""
    rng = random.Random(2022)

    def length(low: float, high: float) -> Fraction:
        return Fraction(round(100 * rng.uniform(low, high)), 100)

    arms = []
    for k in range(100):
        a = (1, length(0.2, 3), length(0.2, 4))
        if k % 2:
            alpha = [rng.choice((-1, 1)) * rng.randrange(20, 160) for _ in range(2)]
            d = (0, length(-1.5, 1.5), length(-1.5, 1.5))
            arms.append(("general", arm(a, d, (*alpha, 0))))
        else:
            d = (0, length(0.1, 2), 0)
            arms.append(("orthogonal", arm(a, d, (-90, 90, 0))))
    return arms


WAYS: dict[str, Callable[..., SurfaceDecision | TileDecision]] = {
    "whole": decide_surface,
    "verdict": decide_by_tiles,
}


def seconds(chain: Chain, way: str) -> float:
    """Processor time of one decision."""
    pair = reduced_map(exact_model(chain))
    start = time.process_time()
    WAYS[way](*pair)
    return time.process_time() - start


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("kind", ["orthogonal", "general"])
def test_deciding_fifty_arms(benchmark: Any, kind: str, way: str) -> None:
    """Median and worst time of fifty random arms of one kind."""
    chains = [chain for name, chain in hundred() if name == kind]
    seconds(chains[0], way)
    times = benchmark.pedantic(
        lambda: [seconds(chain, way) for chain in chains], rounds=1, iterations=1
    )
    benchmark.extra_info["median"] = statistics.median(times)
    benchmark.extra_info["worst"] = max(times)
    middle, worst = statistics.median(times), max(times)
    print(f"{kind}, {way}: median {middle:.3f} s, worst {worst:.3f} s")
