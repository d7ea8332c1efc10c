"""The verdict by tiles, against Algorithm 1."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
from short_tables import Number
from surfaces import arm_map, decided

from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality import tile_decision
from cuspaudit.cuspidality.tile_decision import TileDecision, decide_by_tiles
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, UnableError

Map = tuple[PolynomialSystem, PolynomialMap]


def agree(pair: Map) -> TileDecision:
    """The decision by tiles, after Algorithm 1 was found to say the same."""
    found, known = decide_by_tiles(*pair), decided(pair)
    assert found.verdict is known.verdict
    assert found.aspects == known.aspects
    assert (found.couple is None) == (found.verdict is Verdict.NONCUSPIDAL)
    return found


ARMS: dict[str, tuple[tuple[Number, ...], ...]] = {
    "ISSAC": ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
    "WT1": ((1, ".7", ".3"), (0, ".2", 0), (-90, 90, 0)),
    "WT5": ((1, 3, 4), (0, 3, 0), (-90, 90, 0)),
    "one sheet": ((1, "11/10", "1/5"), (0, -1, "-1/10"), (60, 90, 0)),
    "narrow": ((1, "11/10", "1/2"), (0, "1/5", 1), (90, 90, 0)),
    "over Q(sqrt 3)": ((1, 2, "3/2"), (0, 1, "1/3"), (30, 60, 0)),
}


@pytest.mark.parametrize("name", ARMS)
def test_tiles_agree_with_sample_values(name: str) -> None:
    """Verdict and aspects, for arms on both sides and with walls."""
    agree(arm_map(*ARMS[name]))


@pytest.mark.parametrize("name", ["ISSAC", "WT5"])
def test_a_mirrored_value_changes_nothing(name: str) -> None:
    """Delta changes its sign with r_1, and so do the aspects; the verdict stays."""
    variety, mapping = arm_map(*ARMS[name])
    r_1, r_2 = mapping.components
    mirrored = PolynomialMap(mapping.ring, (-r_1, r_2))
    assert agree((variety, mirrored)).verdict is agree((variety, mapping)).verdict


def test_random_arms_agree() -> None:
    """Lengths in halves and special twists meet the borders between the kinds."""
    rng = random.Random(7)
    seen = []
    for _ in range(30):
        a = (1, *(Fraction(rng.randint(0, 8), 2) for _ in range(2)))
        d = (0, Fraction(rng.randint(-4, 4), 2), Fraction(rng.randint(0, 2), 2))
        twist = tuple(rng.choice((90, -90)) for _ in range(2))
        try:
            seen.append(agree(arm_map(a, d, (*twist, 0))).verdict)
        except (UnableError, DegenerateMapError):
            continue
    assert len(seen) > 15
    assert set(seen) == set(Verdict) - {Verdict.UNDECIDED}


def test_triangular_maps_need_no_tiles() -> None:
    """PUMA's arm: noncuspidal, and nothing is looked at."""
    found = agree(arm_map((0, ".4318", ".4331"), (0, ".15005", 0), (-90, 0, 0)))
    assert (found.verdict, found.tiles) == (Verdict.NONCUSPIDAL, 0)


def test_the_ends_of_a_couple_have_one_position() -> None:
    """The map takes one value at both, and they lie over two points of the base."""
    variety, mapping = arm_map(*ARMS["ISSAC"])
    found = decide_by_tiles(variety, mapping)
    assert found.couple is not None
    surface, ring = found.roadmap.surface, variety.ring
    names = (*surface.fiber.names, *surface.base.names)
    values = []
    for turn, fiber in zip(found.couple.angles, found.couple.fiber, strict=True):
        base = tile_decision._cosine_sine(turn)
        at = dict(zip(names, (*fiber, *base), strict=True))
        values.append([ring.evaluate(r, at) for r in mapping.components])
    assert all(a.overlaps(b) and a.rad() < 1e-9 for a, b in zip(*values, strict=True))
    gap = found.couple.angles[0] - found.couple.angles[1]
    assert gap.q != 1


def test_tiles_that_stay_open_are_no_verdict(monkeypatch: pytest.MonkeyPatch) -> None:
    """With few tiles a noncuspidal arm is left to other engines."""
    pair = arm_map(*ARMS["WT1"])
    assert decide_by_tiles(*pair).verdict is Verdict.NONCUSPIDAL
    monkeypatch.setattr(tile_decision, "_MOST_TILES", 260)
    with pytest.raises(UnableError, match="stay open"):
        decide_by_tiles(*pair)
