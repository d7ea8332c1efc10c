"""Aspects of six-joint arms: the proved count, and the routing graph with its levels.

``pytest tests/benchmarks/test_aspects_benchmark.py --benchmark-only -s``; one core. The
prototype's critical system took 850 s in msolve for the CRX-10iA/L, 18 s after the
elimination of two joints; the published analysis of the UR5 took 40 minutes.
"""

from __future__ import annotations

from typing import Any

import pytest

from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.auditing.search.aspect_routing import route_aspects
from cuspaudit.count import Count
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.library import open_robot

LIMITS = {"fanuc-crx-10ia-l": 20, "ur5": 30, "kinova-jaco-gen2": 20, "abb-gofa-5": 20}
ASPECTS = {"ur5": 8}


@pytest.mark.parametrize("name", LIMITS)
def test_counting_aspects(benchmark: Any, name: str) -> None:
    """From the robot's chain to the proved number."""
    chain = open_robot(name).chain
    found = benchmark(lambda: count_aspects(exact_model(chain)))
    assert found == Count(ASPECTS.get(name, 2), True)
    assert benchmark.stats.stats.median < 1


@pytest.mark.parametrize("name", LIMITS)
def test_routing_aspects(benchmark: Any, name: str) -> None:
    """Maxima, saddles and merge levels, agreeing with the proved number."""
    model = exact_model(open_robot(name).chain)
    routed = benchmark.pedantic(route_aspects, args=(model,), rounds=3, warmup_rounds=1)
    assert routed.routing.number_of_components == ASPECTS.get(name, 2)
    assert benchmark.stats.stats.median < LIMITS[name]


@pytest.mark.parametrize("name", ["hyperplane-6r", "raghavan-roth"])
def test_covering_a_general_arm(benchmark: Any, name: str) -> None:
    """Two covers of the torus of three joints, one for each sign of det J."""
    model = exact_model(open_robot(name).chain)
    found = benchmark.pedantic(count_aspects, args=(model, 300.0), rounds=1)
    assert found == Count(2, True)
