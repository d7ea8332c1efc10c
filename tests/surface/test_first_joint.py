"""What joint 1 must do between two postures: walls against the motion itself."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import pytest
from flint import arb, fmpq
from joint_boxes import first_joint
from short_tables import arm

from cuspaudit.cuspidality.pair_decision import PairEnd, pairs_off
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.robot.chain import Chain
from cuspaudit.surface.first_joint import (
    FirstJoint,
    LongestMotion,
    bounds_of,
    first_walls,
)
from cuspaudit.surface.pair_sheets import PairSheets, pair_sheets
from cuspaudit.surface.surface import Surface
from cuspaudit.surface.value_circles import value_circles

BITS = 128
HAIR = 1e-5
SQUARE = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
SKEW = arm((1, "7/5", "4/5"), ("1/10", "1/2", "1/5"), (60, 90, 0))
SLIDE = arm((1, 2, "3/2"), (0, 1, 0), (-60, 90, 0), "PRR")


def pairs_of(chain: Chain) -> tuple[Surface, PairSheets, FirstJoint]:
    """The pairs of an arm, and its first joint with some range."""
    pair = reduced_map(exact_model(chain))
    surface, _ = oriented(*pair)
    first = first_joint(chain, (0, 90))
    assert first is not None
    return surface, pair_sheets(value_circles(surface, pair[1])), first


def some_pairs(sheets: PairSheets) -> Iterator[tuple[PairEnd, PairEnd]]:
    """Pairs of a few cells."""
    found = list(pairs_off(sheets, sheets.walls, ()))
    yield from found[:: len(found) // 8]


def across(surface: Surface, first: FirstJoint, end: PairEnd) -> list[arb]:
    """The coordinates of the tip that joint 1 moves."""
    values = dict(zip(surface.fiber.names, end.fiber_point(BITS), strict=True))
    values |= surface.base.coordinates(arb(end.base[0]))
    return [surface.ring.evaluate(p, values) for p in first.across]


def motion(surface: Surface, first: FirstJoint, pair: tuple[PairEnd, PairEnd]) -> float:
    """How far joint 1 moves between two ends, from their coordinates."""
    here, there = ([float(x.mid()) for x in across(surface, first, e)] for e in pair)
    if first.kind == "line":
        return abs(there[0] - here[0])
    (a, b), (c, d) = here, there
    return abs(math.atan2(a * d - b * c, a * c + b * d))


def bound(first: FirstJoint, size: float) -> LongestMotion:
    """A bound of this size, nearly, rational."""
    if first.kind == "line":
        return LongestMotion("line", (fmpq(round(size * 2**40), 2**40),))
    t = fmpq(round(math.tan(size / 2) * 2**40), 2**40)
    return LongestMotion("circle", ((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)))


@pytest.mark.parametrize(
    "chain", [SQUARE, SKEW, SLIDE], ids=["square", "skew", "slide"]
)
def test_walls_part_shorter_from_longer_motions(chain: Chain) -> None:
    """A wall changes sign, and a bound its mind, where the motion is the bound."""
    surface, sheets, first = pairs_of(chain)
    ring = sheets.circles.ring
    for pair in some_pairs(sheets):
        size = motion(surface, first, pair)
        at = {"x": arb(pair[0].base[0]), "w": arb(pair[1].base[0])}
        ends = [across(surface, first, end) for end in pair]
        values, minds = [], []
        for allowed in (size - HAIR, size + HAIR):
            limited = bound(first, allowed)
            walls = first_walls(first, limited, surface, ring)
            values.append([float(ring.evaluate(p, at).mid()) for p in walls])
            minds.append(bool(limited.allows(*ends) > 0))
        changed = [a * b < 0 for a, b in zip(*values, strict=True)]
        assert any(changed)
        assert minds == [False, True]


def test_bounds_enclose_the_range() -> None:
    """One bound is a hair longer than the range, one a hair shorter."""
    first = first_joint(SQUARE, (0, 50))
    outer, inner = bounds_of(first)
    assert outer is not None
    assert inner is not None
    angles = [math.atan2(*b.point[::-1]) for b in (outer, inner)]
    assert angles[0] - angles[1] < 1e-9
    # cosines decide, and exactly: cos 50 deg lies between
    cosine = (arb.pi() * 5 / 18).cos()
    assert outer.point[0] < cosine < inner.point[0]


def test_a_turn_by_half_needs_no_bound() -> None:
    """Over a half turn there is no bound; at it only the shorter range has one."""
    assert bounds_of(first_joint(SQUARE, (0, 181))) == (None, None)
    assert bounds_of(first_joint(SQUARE, None)) == (None, None)
    outer, inner = bounds_of(first_joint(SQUARE, (-90, 90)))
    assert outer is None
    assert inner is not None


def test_what_all_pairs_ask_for_is_said() -> None:
    """A wall that is zero everywhere is refused, not dropped."""
    surface, sheets, first = pairs_of(SLIDE)
    still = LongestMotion("line", (fmpq(0),))
    ring = sheets.circles.ring
    assert all(w != 0 for w in first_walls(first, still, surface, ring))
    flat = replace(first, height=surface.ring.constant(0))
    with pytest.raises(UnableError, match="exactly the range"):
        first_walls(flat, still, surface, ring)
