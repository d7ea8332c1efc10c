"""Aspects in a box: against a grid, and where limits touch special places."""

from __future__ import annotations

import random

import numpy as np
import pytest
from flint import fmpq
from joint_boxes import Limits, joint_range
from numpy.typing import NDArray
from surfaces import arm_map, cylinder, delta_of, labels, torus

from cuspaudit.algebra.numeric import numeric_values
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.count import Count
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.surface.box_aspects import BoxAspects, box_aspects, charted_box
from cuspaudit.surface.box_stability import count_between
from cuspaudit.surface.fiber_pieces import AtRational
from cuspaudit.surface.roadmap import orient
from cuspaudit.surface.surface import Surface, product_factors

Array = NDArray[np.float64]
Map = tuple[PolynomialSystem, PolynomialMap]
ISSAC = arm_map((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
SKEW = arm_map((1, "7/5", "4/5"), ("1/10", "1/2", "1/5"), (60, 90, 0))
SURD = arm_map((1, 2, 1), (0, 1, 0), (-30, 90, 0))


def boxed(pair: Map, limits: Limits, slides: bool = False) -> tuple[BoxAspects, Count]:
    """The aspects in the outer box of two ranges in degrees, and the proved count."""
    surface, delta = oriented(*pair)
    second, third = limits
    ranges = joint_range(second), joint_range(third, slides)
    surface, outer, inner = charted_box(surface, delta, ranges)
    assert inner is not None
    wide, narrow = (box_aspects(surface, delta, box) for box in (outer, inner))
    return wide, count_between(wide, narrow)


def grid(pair: Map, limits: Limits, size: int = 160) -> int:
    """The components in the box, larger than a speck, by a grid."""
    ends = [[float(x) for x in end] for end in limits if end is not None]
    axes = [np.radians(np.linspace(*end, size + 1)[1:-1] + 1e-4) for end in ends]
    first, second = (a.ravel() for a in np.meshgrid(*axes, indexing="ij"))
    columns = (np.cos(first), np.sin(first), np.cos(second), np.sin(second))
    values = numeric_values(pair[0].ring, [delta_of(pair)], np.stack(columns, axis=1))
    signs = np.sign(values[:, 0]).astype(int).reshape(size - 1, size - 1)
    return len(np.unique(labels(signs, around=False)))


@pytest.mark.parametrize("name", ["ISSAC", "SKEW", "SURD"])
def test_a_grid_finds_the_same_number(name: str) -> None:
    """Ranges short and long, a turn and more, against a flood fill."""
    pair = {"ISSAC": ISSAC, "SKEW": SKEW, "SURD": SURD}[name]
    rng = random.Random(name)
    for _ in range(2):
        lows = rng.randint(-300, 100), rng.randint(-300, 100)
        limits = [(low, low + rng.randint(40, 500)) for low in lows]
        assert boxed(pair, limits)[1] == Count(grid(pair, limits), True)


def test_a_range_of_a_turn_is_no_circle() -> None:
    """Exactly a whole turn, at the ends of every chart, is an interval."""
    assert boxed(ISSAC, (None, None))[1] == Count(2, True)
    assert boxed(ISSAC, ((-180, 180), (-180, 180)))[1] == Count(5, True)
    assert boxed(ISSAC, ((-360, 360), (-360, 360)))[1] == Count(9, True)


def test_a_limit_on_a_touching_curve_is_not_proved() -> None:
    """At 3 pi / 4 the singular curve of this arm touches the side of the box."""
    limits = ((-27, 169), (-213, -135))
    found = boxed(ISSAC, limits)[1]
    assert found.proved is False
    assert boxed(ISSAC, ((-27, 169), (-213, "-135.001")))[1].proved is True


def test_a_curve_of_double_zeros_parts_an_interval() -> None:
    """Where Delta = 1 + c only touches 0, limits part what a circle joins."""
    variety, _ = torus(lambda c, s, k, t: (c, k))
    delta = 1 + variety.ring.gen("c2")
    surface = orient(Surface(variety.ring, *product_factors(variety)), delta)
    numbers = []
    for limits in (None, (90, 400), (-150, 150)):
        charted, box, _ = charted_box(surface, delta, (joint_range(limits), None))
        numbers.append(box_aspects(charted, delta, box).number_of_aspects)
    assert numbers == [1, 2, 1]


def test_slides_are_lines() -> None:
    """On a line as base a range is cut where it ends; outside nothing counts."""
    pair = cylinder(lambda c, s, q: (q**2 + (q + 1) * c, (q + 1) * s))
    free, _ = boxed(pair, (None, None), slides=True)
    part, proved = boxed(pair, (None, (-5, 5)), slides=True)
    none, _ = boxed(pair, (None, (40, 50)), slides=True)
    assert proved.proved
    assert part.number_of_aspects == free.number_of_aspects
    assert none.number_of_aspects <= free.number_of_aspects


def test_windings_of_a_point() -> None:
    """A point of the base is met once for every turn of its range."""
    found, _ = boxed(ISSAC, ((-170, 170), (-370, 370)))
    assert found.box.base is not None
    assert len(found.turns(AtRational(fmpq(1, 50)))) == 3
    assert len(found.turns(AtRational(fmpq(5)))) == 2
