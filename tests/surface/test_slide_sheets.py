"""Pairs where joint 2 slides: one value at both ends, and the walls."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from flint import arb, fmpq
from short_tables import arm

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.cuspidality.pair_decision import PairEnd, pairs_off
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.kinematics.tip_circles import tip_across
from cuspaudit.robot.chain import Chain
from cuspaudit.surface.box_aspects import Box
from cuspaudit.surface.box_edges import Edge
from cuspaudit.surface.first_joint import LongestMotion
from cuspaudit.surface.slide_sheets import SlideSheets, slide_sheets
from cuspaudit.surface.surface import Surface, product_factors

BITS = 128
TURNS = arm(("1/2", "1/5", 2), ("1/10", 0, "1/5"), (60, 45, 30), "RPR")
FLAT = arm(("1/2", "1/5", 2), ("1/10", 0, "1/5"), (90, 45, 30), "RPR")
FIRST = arm(("1/2", "1/5", 2), ("1/10", 0, "1/5"), (60, 45, 30), "PPR")


def sheets_of(chain: Chain) -> tuple[SlideSheets | None, Polynomial]:
    """The sheets of an arm whose second joint slides, and Delta."""
    variety, mapping = reduced_map(exact_model(chain))
    surface = Surface(variety.ring, *product_factors(variety))
    return slide_sheets(surface, mapping), oriented(variety, mapping)[1]


def at(sheets: SlideSheets, function: Polynomial, end: PairEnd) -> arb:
    """A function on V at an end."""
    surface = sheets.surface
    values = dict(zip(surface.fiber.names, end.fiber_point(BITS), strict=True))
    values |= surface.base.coordinates(arb(end.base[0]))
    return surface.ring.evaluate(function, values)


def some_pairs(sheets: SlideSheets) -> Iterator[tuple[PairEnd, PairEnd]]:
    """Pairs over some cells."""
    x, w = sheets.ring.gens
    yield from pairs_off(sheets, [x - w, sheets.spread], ())


def test_both_ends_have_one_value() -> None:
    """R is the same at the two ends, which are different."""
    sheets, _ = sheets_of(TURNS)
    assert sheets is not None
    pairs = list(some_pairs(sheets))
    assert len(pairs) > 2
    _, mapping = reduced_map(exact_model(TURNS))
    for first, last in pairs:
        for component in mapping.components:
            gap = at(sheets, component, first) - at(sheets, component, last)
            assert gap.contains(0)
            assert gap.rad() < 1e-12
        assert first.base[0] != last.base[0]


@pytest.mark.parametrize("chain", [FLAT, FIRST], ids=["flat", "first"])
def test_arms_without_couples_need_no_pairs(chain: Chain) -> None:
    """A slide across axis 1, two slides: one value tells the postures apart."""
    assert sheets_of(chain)[0] is None


def test_walls_are_where_an_end_meets_them() -> None:
    """Each wall, divided by its denominator, is the function at the end over x."""
    sheets, delta = sheets_of(TURNS)
    assert sheets is not None
    across = tip_across(exact_model(TURNS))
    bound = LongestMotion("circle", (fmpq(3, 5), fmpq(4, 5)))
    edge = Edge(sheets.surface.fiber, 0, fmpq(1, 3))
    _, _, own, _ = sheets.walls(delta)
    low, _, _, _ = sheets.box_walls(Box((edge, edge), None))
    first, _ = sheets.first_walls(bound, across)
    for here, there in some_pairs(sheets):
        x, w = here.base
        names = {"x": arb(x), "w": arb(w)}
        spread = sheets.ring.evaluate(sheets.spread, names)

        def value(wall: Polynomial, names: dict[str, arb] = names) -> arb:
            assert sheets is not None
            return sheets.ring.evaluate(wall, names)

        signs = (value(own) / spread > 0) == bool(at(sheets, delta, here) > 0)
        assert signs
        s = here.fiber_point(BITS)[0]
        assert (value(low) / spread - (s - fmpq(1, 3))).contains(0)
        ends = [[at(sheets, p, end) for p in across] for end in (here, there)]
        assert bool(value(first) > 0) == bool(bound.allows(*ends) > 0)
