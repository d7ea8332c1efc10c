"""The routes to a verdict of three joints, against each other."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
import yaml
from short_tables import arm

import cuspaudit
from cuspaudit.cuspidality.decision import decide
from cuspaudit.cuspidality.pair_decision import decide_pairs
from cuspaudit.cuspidality.surface_decision import decide_surface
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.snapping import snap

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"
ARMS = [
    file.stem
    for file in sorted(ROBOTS.glob("*.yaml"))
    if len(yaml.safe_load(file.read_text())["joints"]) == 3
]


def random_table(seed: int) -> tuple[tuple[object, ...], ...]:
    """(a, d, alpha) of an arm with right-angle twists, lengths in tenths."""
    chance = random.Random(f"three engines {seed}")
    a = (1, *(f"{chance.randint(1, 30) / 10}" for _ in range(2)))
    d = (0, *(f"{chance.randint(-10, 10) / 10}" for _ in range(2)))
    return a, d, (chance.choice([-90, 90]), chance.choice([90, -90]), 0)


def compare(seed: int, engine: str) -> None:
    """Verdict, aspects and postures of one arm by the general and the fast engine."""
    variety, mapping = reduced_map(exact_model(arm(*random_table(seed))))
    fast = decide_surface(variety, mapping)
    run = decide(variety, mapping, engine)
    assert run.failure is None
    found = (run.verdict, run.components, run.most_points)
    assert found == (fast.verdict, fast.aspects, fast.max_postures)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100))
def test_the_roadmap_of_a_map_agrees_with_that_of_an_arm(seed: int) -> None:
    """The general algorithm gives verdict, aspects and postures of the fast one."""
    compare(seed, "roadmap")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_the_routing_of_a_map_agrees_with_the_roadmap_of_an_arm(seed: int) -> None:
    """So does its second route; `tests/geometry/test_routing.py` has 100 more arms."""
    compare(seed, "routing")


@pytest.mark.slow
@pytest.mark.parametrize("name", ARMS)
def test_pairs_agree_on_every_arm_of_ours(name: str) -> None:
    """Pairs of postures give the verdict and aspects of Algorithm 1."""
    system = reduced_map(exact_model(snap(open_robot(name).chain)[0]))
    fast, pairs = decide_surface(*system), decide_pairs(*system)
    assert (pairs.verdict, pairs.aspects) == (fast.verdict, fast.aspects)
