"""Is a map of a surface cuspidal within joint limits? By its pairs of points.

A box is a product of open intervals over V = fiber x base (``surface.box_aspects``),
with a bound on what joint 1 may move between two postures (``surface.first_joint``). R
is cuspidal within it if two different points of V of one value have windings that lie
in one component of {Delta != 0} in the box, and joint 1 can follow.

**Theorem.** Take the cells of ``cuspidality.pair_decision`` with the walls of the box
and of joint 1 added, and the pairs over one point of each. R is cuspidal within the box
if and only if one of these pairs is such a couple.

*Proof.* Along a sheet over a cell neither end meets a zero of Delta or a limit, and the
motion of joint 1 does not pass its bound; so each winding of an end that lies in the
box stays in its aspect, and all pairs of the sheet are couples or none is. Let a couple
be given, X its component of the surface W of pairs. If the map X -> (x, w) has rank 2
somewhere it has it on a dense set, being analytic. Being a couple is open: box, aspect
and the bound are. So some couple near the given one lies over a cell, with its ends in
some order, and the pair chosen on its sheet is a couple. If the rank is less than 2
everywhere, X has both ends in different aspects of V by the proof of ``pair_decision``,
let alone in one of the box. QED.

**Two boxes.** Limits enter as rational tangents, so the question is put to a box that
contains the given one, and to a box inside it, both closer than 1e-12. No couple in the
first: noncuspidal within the limits. A couple in the second: cuspidal within them.
Else there are couples in the first only, and the answer is UNDECIDED.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from flint import arb, ctx, fmpq

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.algebra.univariate import PRECISIONS
from cuspaudit.count import Count
from cuspaudit.cuspidality.pair_decision import PairEnd, pairs_off
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import PrecisionError
from cuspaudit.surface.box_aspects import (
    Box,
    BoxAspects,
    Place,
    Ranges,
    box_aspects,
    charted_box,
    of_factors,
)
from cuspaudit.surface.box_stability import count_between
from cuspaudit.surface.box_walls import box_walls
from cuspaudit.surface.fiber_pieces import AtRational, steady_angle
from cuspaudit.surface.first_joint import (
    FirstJoint,
    FirstMotion,
    LongestMotion,
    bounds_of,
    first_walls,
)
from cuspaudit.surface.pair_sheets import PairSheets, pair_sheets
from cuspaudit.surface.slide_sheets import SlideSheets, slide_sheets
from cuspaudit.surface.surface import Surface, product_factors
from cuspaudit.surface.value_circles import value_circles

__all__ = [
    "BoxCouple",
    "BoxDecision",
    "Winding",
    "angle_at",
    "decide_box",
    "decide_box_of_slide",
]


@dataclass(frozen=True)
class Winding:
    """One of the points over an end of a pair in the box.

    Attributes:
        place: the vertex of the graph of the box.
        turns: of the fiber, on top of the angle in (-pi, pi].
    """

    place: Place
    turns: int


@dataclass(frozen=True, eq=False)
class BoxCouple:
    """Two points of one value with windings in one aspect of the box.

    Attributes:
        postures: the two ends of a pair.
        windings: one of each.
        sign: of Delta in their aspect.
    """

    postures: tuple[PairEnd, PairEnd]
    windings: tuple[Winding, Winding]
    sign: int


@dataclass(frozen=True, eq=False)
class BoxDecision:
    """What the pairs say of a box.

    Attributes:
        verdict: CUSPIDAL, NONCUSPIDAL, or UNDECIDED when only the longer box has
            couples.
        surface: V with the charts of the box.
        delta: det jac(f, R), reduced on V.
        found: the aspects of the box that decided.
        aspects: of the box between; proved if every box between the two has as many.
        pairs: how many pairs were looked at.
        couples: those that decided; empty unless CUSPIDAL.
    """

    verdict: Verdict
    surface: Surface
    delta: Polynomial
    found: BoxAspects
    aspects: Count
    pairs: int
    couples: list[BoxCouple]


def decide_box(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    ranges: Ranges,
    first: FirstJoint | None = None,
    progress: Callable[[str], None] = lambda step: None,
) -> BoxDecision:
    """Decide whether R is cuspidal within joint limits, by its pairs of points.

    Args:
        variety: V = {f = 0}, a product of two circles or of a circle and a line.
        mapping: R = (r_1, r_2).
        ranges: of the two factors of V, in the order of its ring; None for no limits.
        first: what joint 1 does; None where it has no limits.
        progress: called with the name of each step before it runs.

    Raises:
        DegenerateMapError: Delta vanishes identically on V.
        UnableError: outside what this route handles, as for a chain whose second joint
            slides (`decide_box_of_slide`).
        RetryableError: the place of an end, or a chart, could not be told.
    """
    surface, delta = oriented(variety, mapping)

    def sheets(charted: Surface) -> PairSheets | None:
        circles = value_circles(charted, mapping)
        return None if circles.is_triangular else pair_sheets(circles)

    return _decided(surface, delta, sheets, ranges, first, progress)


def decide_box_of_slide(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    ranges: Ranges,
    first: FirstMotion | None = None,
    progress: Callable[[str], None] = lambda step: None,
) -> BoxDecision:
    """The same where joint 2 slides, by the pairs of ``surface.slide_sheets``.

    Args:
        variety: V = {f = 0}, a product of a line and a circle or of two lines, the
            line of joint 2 first.
        mapping: R = (r_1, r_2).
        ranges: of the two factors of V; None for no limits.
        first: what joint 1 does; None where it has no limits.
        progress: called with the name of each step before it runs.

    Raises:
        DegenerateMapError: Delta vanishes identically on V.
        UnableError: R or Delta is outside what this route handles.
        RetryableError: the place of an end, or a chart, could not be told.
    """
    surface, delta = oriented(variety, mapping)
    surface = Surface(variety.ring, *product_factors(variety))
    return _decided(
        surface, delta, lambda s: slide_sheets(s, mapping), ranges, first, progress
    )


def _decided(
    surface: Surface,
    delta: Polynomial,
    sheets: Callable[[Surface], PairSheets | SlideSheets | None],
    ranges: Ranges,
    first: FirstMotion | None,
    progress: Callable[[str], None],
) -> BoxDecision:
    """The decision; ``sheets`` gives the pairs in a chart, None for no couple."""
    progress("limits: aspects")
    ranges = of_factors(surface, ranges)
    surface, outer, inner = charted_box(surface, delta, ranges)
    wide = box_aspects(surface, delta, outer)
    narrow = None if inner is None else box_aspects(surface, delta, inner)
    aspects = count_between(wide, narrow, ranges)
    progress("limits: pairs")
    pairs_of = sheets(surface)

    def decision(verdict: Verdict, found: BoxAspects, asked: _Asked) -> BoxDecision:
        couples = asked.couples if verdict is Verdict.CUSPIDAL else []
        return BoxDecision(
            verdict, surface, delta, found, aspects, asked.pairs, couples
        )

    if pairs_of is None:
        return decision(Verdict.NONCUSPIDAL, wide, _Asked(0, []))
    question = _Question(surface, delta, pairs_of, first)
    most, least = bounds_of(first)
    asked = question.ask(wide, most)
    if not asked.couples:
        return decision(Verdict.NONCUSPIDAL, wide, asked)
    if narrow is not None:
        pairs = [couple.postures for couple in asked.couples]
        again = _Asked(asked.pairs, list(question.couples(pairs, narrow, least)))
        if not again.couples:
            again = question.ask(narrow, least)
        if again.couples:
            return decision(Verdict.CUSPIDAL, narrow, again)
    return decision(Verdict.UNDECIDED, wide, asked)


@dataclass(frozen=True, eq=False)
class _Asked:
    pairs: int
    couples: list[BoxCouple]


@dataclass(frozen=True, eq=False)
class _Question:
    """The pairs of a map, to be asked of several boxes."""

    surface: Surface
    delta: Polynomial
    sheets: PairSheets | SlideSheets
    first: FirstMotion | None

    def ask(self, aspects: BoxAspects, bound: LongestMotion | None) -> _Asked:
        """A pair of every sheet over every cell of a box, and the couples among."""
        pieces, walls = aspects.pieces, list(self._walls(aspects.box, bound))
        lines = [pieces.change, pieces.parts[-1], *pieces.at_limits]
        avoided = [line for line in lines if not line.is_zero]

        def inside(x: fmpq) -> bool:
            return bool(aspects.turns(AtRational(x)))

        pairs = list(pairs_off(self.sheets, walls, avoided, inside))
        return _Asked(len(pairs), list(self.couples(pairs, aspects, bound)))

    def _walls(self, box: Box, bound: LongestMotion | None) -> Iterator[Polynomial]:
        """Between them lie the cells: of the sheets, of the box, of joint 1."""
        sheets, first = self.sheets, self.first
        if isinstance(sheets, SlideSheets):
            yield from sheets.walls(self.delta)
            yield from sheets.box_walls(box)
            if bound is not None and first is not None:
                yield from sheets.first_walls(bound, first.across)
            return
        yield from sheets.walls
        yield from box_walls(sheets.circles, box)
        if bound is not None and first is not None:
            assert isinstance(first, FirstJoint), "joint 2 turns"
            yield from first_walls(first, bound, self.surface, sheets.ring)

    def couples(
        self,
        pairs: list[tuple[PairEnd, PairEnd]],
        aspects: BoxAspects,
        bound: LongestMotion | None,
    ) -> Iterator[BoxCouple]:
        """The pairs that are couples in a box."""
        for pair in pairs:
            signs = [self._sign(end, aspects) for end in pair]
            if signs[0] != signs[1]:
                continue
            windings = [self._windings(end, aspects, signs[0]) for end in pair]
            together = next(
                (
                    (a, b)
                    for a in windings[0]
                    for b in windings[1]
                    if aspects.aspects[a.place] == aspects.aspects[b.place]
                ),
                None,
            )
            if together and (bound is None or self._follows(pair, bound)):
                yield BoxCouple(pair, together, signs[0])

    def _windings(self, end: PairEnd, aspects: BoxAspects, sign: int) -> list[Winding]:
        angle = angle_at(end)
        places = aspects.places(AtRational(end.base[0]), angle, sign)
        return [Winding(place, turns) for place, turns in places]

    def _sign(self, end: PairEnd, aspects: BoxAspects) -> int:
        x = end.base[0]

        def value(bits: int) -> arb:
            *slopes, constant = (part(x) for part in aspects.pieces.parts)
            point = end.fiber_point(bits)
            return sum((p * c for p, c in zip(slopes, point, strict=True)), constant)

        return _sign_of(value, "sign of Delta at an end of a pair")

    def _follows(self, pair: tuple[PairEnd, PairEnd], bound: LongestMotion) -> bool:
        """Whether joint 1 can move as this pair asks it to."""
        assert self.first is not None, "a bound is one of joint 1"
        across = self.first.across
        ring = self.surface.ring

        def at(end: PairEnd, bits: int) -> list[arb]:
            names = self.surface.fiber.names
            values = dict(zip(names, end.fiber_point(bits), strict=True))
            values |= self.surface.base.coordinates(arb(end.base[0]))
            return [ring.evaluate(p, values) for p in across]

        def value(bits: int) -> arb:
            return bound.allows(at(pair[0], bits), at(pair[1], bits))

        return _sign_of(value, "motion of joint 1 between the ends of a pair") > 0


def angle_at(end: PairEnd) -> Callable[[int], arb]:
    """Balls of the angle of an end on the fiber, or of its coordinate on a line."""
    if isinstance(end.sheets, SlideSheets):
        return lambda bits: end.fiber_point(bits)[0]

    def point(bits: int) -> tuple[arb, arb]:
        c, s = end.fiber_point(bits)
        return c, s

    return steady_angle(point)


def _sign_of(value: Callable[[int], arb], what: str) -> int:
    saved = ctx.prec
    try:
        for ctx.prec in PRECISIONS:
            ball = value(ctx.prec)
            if not ball.contains(0):
                return 1 if ball > 0 else -1
    finally:
        ctx.prec = saved
    raise PrecisionError(what, PRECISIONS[-1])
