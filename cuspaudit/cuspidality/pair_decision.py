"""The pairs of points of one value decide whether a map of a surface is cuspidal.

W = {(q, q') : R(q) = R(q'), q != q', Delta(q) Delta(q') != 0} is a surface, because R
is a local diffeomorphism at q and q'. Along a component of W both ends keep to one
aspect each, so R is cuspidal if and only if some component has both in the same one.
One point of every component that can have that decides; no value is sampled, and no
atypical value is computed.

**Theorem.** Let V = fiber x base, the fiber a circle on which R and Delta are affine,
the values over points of the base circles (``surface.value_circles``), and mu > 0.
Take a point in every cell of the plane of (x, w), x < w, off the walls of
``surface.pair_sheets``, and where B > 0 the pair of each sheet over it on which Delta
is not 0. Then R is cuspidal if and only if one of these pairs has both ends in one
aspect.

*Proof.* If one has, R is cuspidal. Let X be a component of W. Over one x a value with
Delta != 0 is taken once: if N = 0, K = 0 and Delta = 0. So x != w on X; and exchanging
the ends of all pairs of X gives a component of W as well.

(1) Somewhere on X the map (q, q') -> (x, w) has rank 2. Then the image of X contains
an open set, hence points off the walls and in the charts, and B > 0 there, as p - C(x)
and p - C(w) are independent. Over the cell of such a point a sheet is connected and
Delta has no zero on it at either end, so the sheet that X meets there lies in X. The
pair chosen on it is in X, or with its ends exchanged.

(2) The rank is less than 2 on X. In the coordinates p of X neither dx nor dw is 0, as
the gradient of <p - C, p - C> is not. So the rank is 1: (x, w) moves on a curve, and p
still moves while (x, w) stands, hence the circles over x and w are equal. If C is not
constant, then C(x) = C(w), of degree 1 in (c, s) or 2 on a line, makes w the mirror
image of x; N is even under it, being analytic; so the derivative by x of the equation
of the circles is odd, and Delta, which is this times a function of one sign, has
opposite signs at q and q'. If C is constant, Delta is N'(x) times a function of one
sign; along a path in an aspect x moves where N is monotone, and N(x) = N(w) excludes
x != w. Either way q and q' are not in one aspect. QED.

**Triangular maps** (mu = 0): r_1 = A(x), r_2 = C_2(x) + <k_2(x), u>. No such map is
cuspidal: Delta is a multiple of A'(x) <k_2, u'>, u' the point u turned by a right
angle. Along a path in an aspect x moves where A is monotone, so q and q' have one x;
then u and u' have one <k_2, u>, and <k_2, .'> of opposite signs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from flint import arb, ctx, fmpq

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.algebra.univariate import PRECISIONS, Univariate
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import PrecisionError
from cuspaudit.geometry.sample_points_rational import sample_points_rational
from cuspaudit.surface.graph_isotop import RoadmapGraph, Vertex, graph_isotop
from cuspaudit.surface.pair_sheets import PairSheets, pair_sheets
from cuspaudit.surface.roadmap import SurfaceRoadmap, roadmap
from cuspaudit.surface.slide_sheets import SlideSheets
from cuspaudit.surface.surface import Surface
from cuspaudit.surface.value_circles import value_circles

__all__ = ["PairCouple", "PairDecision", "PairEnd", "decide_pairs", "pairs_off"]


@dataclass(frozen=True, eq=False)
class PairEnd:
    """One end of a pair.

    Attributes:
        sheets: the pairs.
        base: (x, w), chart coordinates of this and of the other end, rational.
        sheet: 1 or -1.
    """

    sheets: PairSheets | SlideSheets
    base: tuple[fmpq, fmpq]
    sheet: int

    def fiber_point(self, bits: int) -> tuple[arb, ...]:
        """Balls of the coordinates (c, s), or (q,), on the fiber."""
        return self.sheets.fiber_point(*self.base, self.sheet, bits)

    def chart(self, bits: int) -> tuple[arb, arb]:
        """Balls of the chart coordinates (y, x), y infinite near (c, s) = (-1, 0)."""
        x, point = arb(self.base[0]), self.fiber_point(bits)
        if len(point) == 1:
            return point[0], x
        c, s = point
        for above, below in ((s, 1 + c), (1 - c, s)):
            if not below.contains(0):
                return above / below, x
        return arb("inf"), x


@dataclass(frozen=True, eq=False)
class PairCouple:
    """Two points of one value in one aspect.

    Attributes:
        postures: the two ends of a pair.
        sign: of Delta in their aspect.
    """

    postures: tuple[PairEnd, PairEnd]
    sign: int


@dataclass(frozen=True, eq=False)
class PairDecision:
    """What the pairs say, step by step.

    Attributes:
        verdict: CUSPIDAL if there is a couple, else NONCUSPIDAL.
        surface: V with its charts.
        delta: det jac(f, R), reduced on V.
        sheets: of the pairs; None for a triangular map, which needs none.
        pairs: one at least in every component of W, up to the order of the ends, that
            could have both in one aspect; Delta has one sign at both.
        roadmap: of V - {Delta = 0}.
        graph: its graph, with the ends of ``pairs`` placed.
        couples: the pairs with both ends in one aspect.
    """

    verdict: Verdict
    surface: Surface
    delta: Polynomial
    sheets: PairSheets | None
    pairs: list[tuple[PairEnd, PairEnd]]
    roadmap: SurfaceRoadmap
    graph: RoadmapGraph
    couples: list[PairCouple]

    @property
    def aspects(self) -> int:
        """The number of connected components of V - {Delta = 0}, proved."""
        return self.graph.number_of_aspects


def decide_pairs(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    progress: Callable[[str], None] = lambda step: None,
) -> PairDecision:
    """Decide whether the restriction of R to V_R is cuspidal, by its pairs of points.

    Exact and complete, by the theorem of this module; its hypotheses are checked.

    Args:
        variety: V = {f = 0}, a product of two circles or of a circle and a line.
        mapping: R = (r_1, r_2).
        progress: called with the name of each step before it runs.

    Raises:
        DegenerateMapError: Delta vanishes identically on V.
        UnableError: V, R or Delta is outside what this route handles, as for a chain
            whose second joint slides.
        PrecisionError: the aspect of an end could not be told.
    """
    progress("crit")
    surface, delta = oriented(variety, mapping)
    circles = value_circles(surface, mapping)
    progress("roadmap")
    road = roadmap(surface, delta)
    graph = graph_isotop(road, delta, ())
    if circles.is_triangular:
        return PairDecision(
            Verdict.NONCUSPIDAL, surface, delta, None, [], road, graph, []
        )
    progress("pair sheets")
    sheets = pair_sheets(circles)
    placed: dict[PairEnd, Vertex] = {}
    pairs = []
    progress("pairs")
    for pair in pairs_off(sheets, sheets.walls, (road.change,)):
        vertices = [_vertex(road, end) for end in pair]
        if vertices[0][1] == vertices[1][1]:
            placed |= zip(pair, vertices, strict=True)
            pairs.append(pair)
    graph = replace(graph, placed=placed)
    couples = [
        PairCouple(pair, placed[pair[0]][1])
        for pair in pairs
        if graph.aspect(pair[0]) == graph.aspect(pair[1])
    ]
    verdict = Verdict.CUSPIDAL if couples else Verdict.NONCUSPIDAL
    return PairDecision(verdict, surface, delta, sheets, pairs, road, graph, couples)


def pairs_off(
    sheets: PairSheets | SlideSheets,
    walls: Sequence[Polynomial],
    avoided: Sequence[Univariate],
    wanted: Callable[[fmpq], bool] = lambda x: True,
) -> Iterator[tuple[PairEnd, PairEnd]]:
    """The pairs over a point of every cell of x < w, up to the order of the ends.

    Args:
        sheets: of the pairs.
        walls: those of the sheets, and more; the cells lie between them.
        avoided: nonzero; no end lies over one of their zeros.
        wanted: of x and of w; false for no pair that is asked for, and the same on
            every interval between walls of x, or of w, alone.
    """
    if sheets.are_empty:
        return
    ring = sheets.ring

    def accept(point: tuple[fmpq, ...]) -> bool:
        return all(line.sign(x) != 0 for line in avoided for x in point)

    points = sample_points_rational(ring, walls, ring.variables, accept, wanted)
    for x, w in points:
        for sheet in sheets.over(x, w) if x < w and wanted(w) else ():
            yield PairEnd(sheets, (x, w), sheet), PairEnd(sheets, (w, x), sheet)


def _vertex(road: SurfaceRoadmap, end: PairEnd) -> Vertex:
    """The strip of an end and the sign of Delta there.

    Raises:
        PrecisionError: the sign could not be told.
    """
    x = end.base[0]
    saved = ctx.prec
    try:
        for ctx.prec in PRECISIONS:
            c, s = end.fiber_point(ctx.prec)
            p, q, constant = (part(x) for part in road.parts)
            value = p * c + q * s + constant
            strip = road.strip_of(arb(x), ctx.prec)
            if not value.contains(0) and strip is not None:
                return strip, 1 if value > 0 else -1
    finally:
        ctx.prec = saved
    raise PrecisionError("sign of Delta at an end of a pair", PRECISIONS[-1])
