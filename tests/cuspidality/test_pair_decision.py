"""Three joints by their pairs of postures, against Algorithm 1 and by hand."""

from __future__ import annotations

import random
from itertools import combinations

import pytest
from flint import arb
from short_tables import Number
from surfaces import arm_map, cylinder, decided, torus

from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.pair_decision import PairDecision, decide_pairs
from cuspaudit.cuspidality.surface_decision import SurfaceDecision
from cuspaudit.cuspidality.surface_path import propose_paths
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, UnableError

Map = tuple[PolynomialSystem, PolynomialMap]


def agree(pair: Map) -> tuple[SurfaceDecision, PairDecision]:
    """The two decisions, after they were found to say the same."""
    first, second = decided(pair), decide_pairs(*pair)
    assert first.verdict is second.verdict
    assert first.aspects == second.aspects
    return first, second


def aspects_by_values(decision: SurfaceDecision) -> set[tuple[int, int]]:
    """The two aspects of every two postures of a sample value with one sign."""
    return {
        tuple(sorted(map(decision.graph.aspect, pair)))
        for fiber in decision.samples
        for pair in combinations(fiber.postures, 2)
        if decision.graph.placed[pair[0]][1] == decision.graph.placed[pair[1]][1]
    }


def aspects_by_pairs(decision: PairDecision) -> set[tuple[int, int]]:
    """The two aspects of every pair."""
    return {tuple(sorted(map(decision.graph.aspect, p))) for p in decision.pairs}


ARMS: dict[str, tuple[tuple[Number, ...], ...]] = {
    "ISSAC": ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
    "WT1": ((1, ".7", ".3"), (0, ".2", 0), (-90, 90, 0)),
    "WT5": ((1, 3, 4), (0, 3, 0), (-90, 90, 0)),
    # of the pairs of one sign few lie on one sheet only, and between few walls
    "one sheet": ((1, "11/10", "1/5"), (0, -1, "-1/10"), (60, 90, 0)),
    "narrow": ((1, "11/10", "1/2"), (0, "1/5", 1), (90, 90, 0)),
}


@pytest.mark.parametrize("name", ARMS)
def test_pairs_meet_the_same_aspects_as_sample_values(name: str) -> None:
    """Verdict and aspects agree, and so do the aspects that two postures join."""
    first, second = agree(arm_map(*ARMS[name]))
    assert aspects_by_values(first) == aspects_by_pairs(second)


#: maps whose pairs are special, and whether they are cuspidal
SPECIAL: dict[str, tuple[Map, bool]] = {
    "circles through one point": (
        torus(
            lambda c, s, k, t: ((k + 2) * (1 + c) - t * s, t * (1 + c) + (k + 2) * s)
        ),
        False,
    ),
    "circles through two points": (
        cylinder(lambda c, s, q: (q + q * c - s, q * s + c)),
        False,
    ),
    "concentric circles": (
        torus(lambda c, s, k, t: ((k + 2 * k * t + 4) * c, (k + 2 * k * t + 4) * s)),
        False,
    ),
    "circles equal two by two": (
        torus(lambda c, s, k, t: (k + (3 * k + 2) * c, (3 * k + 2) * s)),
        False,
    ),
    "tangent circles": (
        torus(lambda c, s, k, t: (k + (k + 2) * c, (k + 2) * s)),
        False,
    ),
    "a line as base": (
        cylinder(lambda c, s, q: (q**2 + (q + 1) * c, (q + 1) * s)),
        True,
    ),
}


@pytest.mark.parametrize("name", SPECIAL)
def test_special_pairs(name: str) -> None:
    """Where sheets are missing, or circles coincide, Algorithm 1 agrees."""
    pair, cuspidal = SPECIAL[name]
    _, found = agree(pair)
    assert (found.verdict is Verdict.CUSPIDAL) == cuspidal


def test_triangular_maps_need_no_pairs() -> None:
    """PUMA's arm: the distance from axis 1 and 2 depends on joint 3 alone."""
    arm = arm_map((0, ".4318", ".4331"), (0, ".15005", 0), (-90, 0, 0))
    _, found = agree(arm)
    assert found.sheets is None
    assert found.verdict is Verdict.NONCUSPIDAL


def test_an_arm_out_of_reach_of_sample_values() -> None:
    """Neither coordinate tells its postures apart; axes 1 and 2 meet [facts]."""
    arm = arm_map((0, "7/2", "19/5"), (0, 0, "7/10"), (90, 90, 0))
    with pytest.raises(UnableError):
        decided(arm)
    assert decide_pairs(*arm).verdict is Verdict.NONCUSPIDAL


def test_no_rank_is_refused() -> None:
    """A map of rank 1 has no pairs to look at."""
    with pytest.raises(DegenerateMapError):
        decide_pairs(*arm_map((1, 2, 1), (0, 1, 0), (0, 0, 0)))


def test_couples_have_paths() -> None:
    """A path between the ends of a couple keeps the sign of Delta."""
    variety, mapping = arm_map(*ARMS["ISSAC"])
    decision = decide_pairs(variety, mapping)
    path = next(propose_paths(decision))
    assert 0 < path.smallest <= path.first
    first, last = (
        {
            name: arb(function)
            for factor, angle in zip(("2", "3"), point, strict=True)
            for name, function in (
                (f"c{factor}", arb(angle).cos()),
                (f"s{factor}", arb(angle).sin()),
            )
        }
        for point in path.points[[0, -1]]
    )
    for r in mapping.components:
        gap = variety.ring.evaluate(r, first) - variety.ring.evaluate(r, last)
        assert abs(float(gap.mid())) < 1e-9


def random_arm(seed: int) -> Map:
    """Right angles in one of two, a sliding joint in one of four; some lengths 0."""
    chance = random.Random(f"pairs {seed}")
    a = [chance.choice((0, *[f"{chance.randint(1, 40)}/10"] * 4)) for _ in range(3)]
    d = [0, *(f"{chance.choice((0, chance.randint(-20, 20)))}/10" for _ in range(2))]
    angles = (90, -90) if seed % 2 else (90, -90, 60, 30, 45, 0, "36.8699")
    twists = [chance.choice(angles) for _ in range(2)]
    kinds = chance.choice(("RRP", "PRR", "PRP")) if seed % 4 == 0 else "RRR"
    return arm_map(tuple(a), tuple(d), (*twists, 0), kinds)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(80))
def test_random_arms(seed: int) -> None:
    """Pairs and sample values agree, or both refuse the map."""
    pair = random_arm(seed)
    try:
        first = decided(pair)
    except DegenerateMapError:
        with pytest.raises(DegenerateMapError):
            decide_pairs(*pair)
        return
    except UnableError:
        # pairs reach further; what they say is theorem: axes 1 and 2 meet or ...
        assert decide_pairs(*pair).sheets is None
        return
    second = decide_pairs(*pair)
    assert (first.verdict, first.aspects) == (second.verdict, second.aspects)
    if second.sheets is not None:
        together = aspects_by_pairs(second)
        assert together <= aspects_by_values(first)
