from __future__ import annotations

from itertools import combinations, permutations

import pytest
from flint import arb, fmpq
from surfaces import arm_map, cylinder, decided, torus

from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.surface.pair_sheets import PairSheets, pair_sheets
from cuspaudit.surface.surface import Surface
from cuspaudit.surface.value_circles import value_circles

Map = tuple[PolynomialSystem, PolynomialMap]
BITS = 192

MAPS: dict[str, Map] = {
    "orthogonal": arm_map((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
    "general": arm_map((1, 2, "3/2"), (0, 1, "1/3"), (90, "73.7398", 0)),
    "over Q(sqrt 3)": arm_map((1, 2, "3/2"), (0, 1, "1/3"), (30, 60, 0)),
    "last joint slides": arm_map(("17/5", 0, 1), (0, 1, 2), (-90, 30, 0), "RRP"),
    "first joint slides": arm_map((0, "17/5", 3), (0, -1, 1), (45, -90, 0), "PRR"),
    "with a slant": torus(lambda c, s, k, t: (k + 2 * c + s, t + 3 * s)),
    # all circles pass through (-1, 0)
    "a common point": cylinder(
        lambda c, s, q: (q**2 + (q**2 + 1) * c - q * s, q + (q**2 + 1) * s + q * c)
    ),
}


def sheets_of(pair: Map) -> tuple[Surface, PairSheets]:
    """The surface of a map, and the sheets of its pairs."""
    surface, _ = oriented(*pair)
    return surface, pair_sheets(value_circles(surface, pair[1]))


def place(
    surface: Surface, sheets: PairSheets, x: fmpq, w: fmpq, sheet: int
) -> dict[str, arb]:
    """The coordinates of the end over x."""
    fiber = sheets.fiber_point(x, w, sheet, BITS)
    return dict(
        zip(surface.fiber.names, fiber, strict=True)
    ) | surface.base.coordinates(arb(x))


GRID = [fmpq(k, 7) for k in range(-23, 24, 5)]


@pytest.mark.parametrize("name", MAPS)
def test_both_ends_are_on_the_fiber_and_have_one_value(name: str) -> None:
    """c^2 + s^2 = 1 and R(q) = R(q') on each sheet where B > 0, in balls."""
    variety, mapping = MAPS[name]
    surface, sheets = sheets_of(MAPS[name])
    met = 0
    for x, w in combinations(GRID, 2):
        for sheet in sheets.over(x, w):
            one, other = (
                place(surface, sheets, *base, sheet) for base in ((x, w), (w, x))
            )
            for end in (one, other):
                norm = sum(end[n] ** 2 for n in surface.fiber.names)
                assert norm.overlaps(arb(1))
                assert float(norm.rad()) < 1e-12
            for r in mapping.components:
                gap = variety.ring.evaluate(r, one) - variety.ring.evaluate(r, other)
                assert gap.contains(0)
                assert float(gap.rad()) < 1e-12
            met += 1
    assert met > 10


@pytest.mark.parametrize("name", MAPS)
def test_the_sign_of_delta_is_that_of_the_formula(name: str) -> None:
    """Delta / ((x - w) (U +- V sqrt(mu B))) has one sign on both sheets."""
    variety, _ = MAPS[name]
    surface, sheets = sheets_of(MAPS[name])
    _, delta = oriented(*MAPS[name])
    ring, signs = sheets.circles.ring, set()
    for x, w in permutations(GRID, 2):
        at = {"x": arb(x), "w": arb(w)}
        mu, meeting, even, odd = (
            ring.evaluate(p, at)
            for p in (sheets.circles.metric, sheets.meeting, sheets.even, sheets.odd)
        )
        for sheet in sheets.over(x, w):
            here = place(surface, sheets, x, w, sheet)
            formula = (x - w) * (even + sheet * odd * (mu * meeting).sqrt())
            signs.add(variety.ring.evaluate(delta, here) * formula > 0)
    assert len(signs) == 1


@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=pytest.mark.slow) if "sqrt" in n else n for n in MAPS],
)
def test_every_two_postures_of_a_value_are_ends_of_a_pair(name: str) -> None:
    """Fibers that Algorithm 1 solves for, seen two by two: one sheet holds both."""
    decision = decided(MAPS[name])
    surface, sheets = sheets_of(MAPS[name])
    assert surface == decision.surface
    seen = 0
    for fiber in decision.samples:
        for one, other in permutations(fiber.postures, 2):
            (_, x), (_, w) = (posture.chart(BITS) for posture in (one, other))
            at = one.coordinates(BITS)
            wanted = [at[n] for n in surface.fiber.names]
            sheet, *more = (sheets.fiber_point(x, w, k, BITS) for k in (1, -1))
            if not sheet[0].is_finite():
                continue  # the value is on the line of the centers: B = 0
            held = [
                all(a.overlaps(b) for a, b in zip(found, wanted, strict=True))
                for found in (sheet, *more)
            ]
            assert held.count(True) == 1
            seen += 1
    assert seen > 3
