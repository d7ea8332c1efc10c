"""The verdict alone, by tiles of pairs of points, without a discriminant.

``cuspidality.pair_decision`` says which pairs decide: R is cuspidal if and only if two
points of one value, with Delta of one sign at both, lie in one aspect. Here the pairs
are looked at in tiles (``surface.pair_tiles``), and the aspects are those of the exact
roadmap. A tile whose middle has both ends in one aspect is a candidate; its pair is
proved in balls, and the verdict is CUSPIDAL. A tile is *settled* when its circles do
not meet, or g has different signs at both ends, or the ends lie in different aspects
of the sign that both have. The others are cut in four.

**Theorem.** Let V be a product of two circles, the values over its base circles of the
kind of ``surface.value_waves``, and let the test of ``PairTiles.obstacle`` have been
passed. If all tiles are settled, R is noncuspidal.

*Proof.* Let X be a component of the surface W of ``pair_decision``, of regular points
(q, q') of one value, and let both ends of X lie in one aspect. Over one point of the
base a value with Delta != 0 is taken once, so t != w on X. Where L = 0, the circles
over t and w have one center; as they meet they are equal, and r = 0 too. By the test
there are finitely many such (m, h), and the pairs over each form a curve at most: q
moves on a fiber, and q' follows. So X has a pair with L > 0. Its tile is settled:
the circles do not meet, or Delta has two signs at the ends, or these are in different
aspects. None of the three is so. QED
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from flint import arb, ctx, fmpq
from numpy.typing import NDArray

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.runtime.clock import check_time
from cuspaudit.surface.graph_isotop import RoadmapGraph, Vertex, graph_isotop
from cuspaudit.surface.pair_tiles import PairTiles
from cuspaudit.surface.roadmap import SurfaceRoadmap, roadmap
from cuspaudit.surface.value_waves import ValueWaves, value_waves

__all__ = ["TileCouple", "TileDecision", "decide_by_tiles"]

Whole = NDArray[np.int64]
Truths = NDArray[np.bool_]

_FIRST_DEPTH = 5
_ARC_DEPTH = 12
_LAST_DEPTH = 24
_MOST_TILES = 20_000
_TRIED = 3
_BITS = 128


@dataclass(frozen=True, eq=False)
class TileCouple:
    """Two points of one value, proved to lie in one aspect.

    Attributes:
        angles: of the base circle at both ends, in turns.
        fiber: balls of (c, s) on the fiber at both ends.
        vertex: of both in the graph of the roadmap, the strip and the sign of Delta.
    """

    angles: tuple[fmpq, fmpq]
    fiber: tuple[tuple[arb, arb], tuple[arb, arb]]
    vertex: tuple[Vertex, Vertex]


@dataclass(frozen=True, eq=False)
class TileDecision:
    """What the tiles say.

    Attributes:
        verdict: CUSPIDAL with a couple, else NONCUSPIDAL.
        delta: det jac(f, R), reduced on V.
        roadmap: of V - {Delta = 0}.
        graph: its graph.
        tiles: how many were looked at; none for a triangular map, which needs none.
        couple: two points in one aspect, if there are any.
    """

    verdict: Verdict
    delta: Polynomial
    roadmap: SurfaceRoadmap
    graph: RoadmapGraph
    tiles: int
    couple: TileCouple | None

    @property
    def aspects(self) -> int:
        """The number of connected components of V - {Delta = 0}, proved."""
        return self.graph.number_of_aspects


def decide_by_tiles(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    progress: Callable[[str], None] = lambda step: None,
) -> TileDecision:
    """Decide whether the restriction of R to V_R is cuspidal, and nothing else.

    Exact where it comes to an end: CUSPIDAL by one couple in balls, NONCUSPIDAL by the
    theorem of this module or by that on triangular maps in ``pair_decision``.

    Args:
        variety: V = {f = 0}, a product of two circles.
        mapping: R = (r_1, r_2).
        progress: called with the name of each step before it runs.

    Raises:
        DegenerateMapError: Delta vanishes identically on V.
        UnableError: V or R is of another kind, or some tiles stay open: where R is
            noncuspidal by a hair, or has a cusp of the kind that only a proof without
            tiles tells.
    """
    progress("crit")
    surface, delta = oriented(variety, mapping)
    waves = value_waves(surface, mapping, delta)
    tiles = None if waves is None else PairTiles.of(waves)
    progress("roadmap")
    road = roadmap(surface, delta)
    graph = graph_isotop(road, delta, ())
    if waves is None or tiles is None:
        return TileDecision(Verdict.NONCUSPIDAL, delta, road, graph, 0, None)
    progress("pair tiles")
    search = _Search(waves, tiles, road, graph)
    couple = search.run()
    verdict = Verdict.NONCUSPIDAL if couple is None else Verdict.CUSPIDAL
    return TileDecision(verdict, delta, road, graph, search.looked_at, couple)


@dataclass(eq=False)
class _Search:
    """The tiles, from coarse to fine.

    Attributes:
        waves: of the circles.
        tiles: their functions.
        road: the roadmap.
        graph: its graph.
        looked_at: how many tiles so far.
    """

    waves: ValueWaves
    tiles: PairTiles
    road: SurfaceRoadmap
    graph: RoadmapGraph
    looked_at: int = 0

    def run(self) -> TileCouple | None:
        """A proved couple, or None when all tiles are settled.

        Raises:
            UnableError: neither, with so many tiles.
        """
        aspects = _aspects_by_arc(self.road, self.graph, self.waves.sign)
        depth = _FIRST_DEPTH
        axes = np.arange(1 << depth), np.arange(1 << (depth - 2))
        tile = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 2)
        while True:
            self.looked_at += len(tile)
            here = aspects[min(depth, _ARC_DEPTH) - _FIRST_DEPTH]
            for candidate in self._candidates(depth, tile, here):
                couple = self._proved(depth, candidate)
                if couple is not None:
                    return couple
            tile = tile[self._open(depth, tile, here)]
            if not len(tile):
                return None
            check_time("pair tiles")
            depth += 1
            if depth > _LAST_DEPTH or self.looked_at + 4 * len(tile) > _MOST_TILES:
                raise UnableError("pair tiles", f"{len(tile)} tiles stay open")
            steps = np.array([(0, 0), (0, 1), (1, 0), (1, 1)])
            tile = (2 * tile[:, None] + steps).reshape(-1, 2)

    def _open(self, depth: int, tile: Whole, aspects: Whole) -> Truths:
        """Which tiles are not settled."""
        ends = _ends(depth, tile, 0), _ends(depth, tile, 1)
        found = np.zeros(len(tile), dtype=bool)
        for own, common in zip(aspects, self.tiles.common(depth, tile), strict=True):
            near, other = (own[a] | own[b] for a, b in zip(*ends, strict=True))
            found |= common & ((near & other) != 0)
        return found

    def _candidates(
        self, depth: int, tile: Whole, aspects: Whole
    ) -> Iterator[tuple[int, int]]:
        """Tiles whose middles seem to have both ends in one aspect, the best first."""
        left, right = _ends(depth, tile, 0)
        room = self.tiles.at_middles(depth, tile).max(1)
        best = np.full(len(tile), -np.inf)
        for i in (0, 1):
            shared = aspects[i, left] & aspects[i, right]
            here = np.where(shared != 0, room[:, i], -np.inf)
            best = np.maximum(best, here)
        for k in np.argsort(-best)[:_TRIED]:
            if best[k] > 0:
                yield int(tile[k, 0]), int(tile[k, 1])

    def _proved(self, depth: int, tile: tuple[int, int]) -> TileCouple | None:
        """The couple in the middle of a tile, if its ends are proved in one aspect."""
        left, right = tile[0] - tile[1], tile[0] + tile[1] + 1
        turns = fmpq(left, 1 << depth), fmpq(right, 1 << depth)
        saved, ctx.prec = ctx.prec, _BITS
        try:
            for sheet in (1, -1):
                couple = self._couple(turns, sheet)
                if couple is not None:
                    return couple
        finally:
            ctx.prec = saved
        return None

    def _couple(self, turns: tuple[fmpq, fmpq], sheet: int) -> TileCouple | None:
        points = _fiber_points(self.waves, turns, sheet)
        if points is None:
            return None
        ends = [
            _vertex(self.road, turn, point)
            for turn, point in zip(turns, points, strict=True)
        ]
        first, second = ends
        if first is None or second is None or not self.graph.connected(first, second):
            return None
        return TileCouple(turns, points, (first, second))


def _ends(depth: int, tile: Whole, back: int) -> tuple[Whole, Whole]:
    """The numbers of the arcs of the base that begin, or end, at t and w of a middle.

    Over a tile t and w keep to these two arcs, of the edge of a tile or longer.

    Args:
        depth: of the tiles.
        tile: their numbers.
        back: 1 for the arcs that end there, or hold the point.
    """
    coarser = max(depth - _ARC_DEPTH, 0)
    size = 1 << (depth - coarser)
    left, right = tile[:, 0] - tile[:, 1] - back, tile[:, 0] + tile[:, 1] + 1 - back
    return (left >> coarser) % size, (right >> coarser) % size


def _aspects_by_arc(
    road: SurfaceRoadmap, graph: RoadmapGraph, turned: int
) -> list[Whole]:
    """The aspects that may have a point over each arc of the base, as bits.

    Args:
        road: the roadmap.
        graph: its graph.
        turned: the sign of Delta / g.

    Returns:
        for each depth up to the finest of arcs (2, 2^depth): by the signs + and - of g,
        and by arc.

    Raises:
        UnableError: there are more aspects than bits.
    """
    if graph.number_of_aspects > 62:
        raise UnableError("pair tiles", f"{graph.number_of_aspects} aspects")
    size = 1 << _ARC_DEPTH
    finest = np.zeros((2, size), dtype=np.int64)
    ends = [_turn_of(road, root.enclosure(_BITS)) for root in road.critical]
    for index, strip in enumerate(road.strips):
        low, high = _between(ends, index, len(road.strips), size)
        arcs = np.arange(low, high + 1) % size
        for sign in strip.signs:
            bit = 1 << graph.aspects[index, sign]
            finest[0 if sign == turned else 1, arcs] |= bit
    levels = [finest]
    while levels[-1].shape[1] > 1 << _FIRST_DEPTH:
        levels.append(levels[-1][:, ::2] | levels[-1][:, 1::2])
    return levels[::-1]


def _between(ends: list[arb], index: int, strips: int, size: int) -> tuple[int, int]:
    """The first and the last arc that a strip meets; one turn at most."""
    if not ends:
        return 0, size - 1
    # the first strip begins, and the last one ends, where the chart has no point:
    # both are taken for the whole of which they are the halves
    below = ends[index - 1] if index else ends[-1] - 1
    above = ends[index] if index < strips - 1 else ends[0] + 1
    low, high = _arc(below.lower(), size), _arc(above.upper(), size)
    return low, min(high, low + size - 1)


def _arc(turn: arb, size: int) -> int:
    """The number of the arc of an exact ``turn``, whole turns counted."""
    whole = (turn * size).floor().unique_fmpz()
    assert whole is not None, "an exact number"
    return int(whole)


def _turn_of(road: SurfaceRoadmap, x: arb) -> arb:
    """The angle of a point of the base in turns, increasing with its chart."""
    c, s = (arb(value) for value in road.surface.base.rotation)
    start = arb.atan2(s, c) / (2 * arb.pi())
    return start + x.atan() / arb.pi()


def _fiber_points(
    waves: ValueWaves, turns: tuple[fmpq, fmpq], sheet: int
) -> tuple[tuple[arb, arb], tuple[arb, arb]] | None:
    """(c, s) on the fiber at both ends of a pair; None where none is proved.

    The circles over both turns meet, on each side of the line of their centres, if
    the distance and the radii are the sides of a triangle.
    """
    angles = [_cosine_sine(turn) for turn in turns]
    (p, q), (x, y) = (waves.center(*angle) for angle in angles)
    squares = [waves.squared_radius(*angle) for angle in angles]
    a, b = x - p, y - q
    length = a * a + b * b
    if not (length > 0 and squares[0] > 0 and squares[1] > 0):
        return None
    along = (length + squares[0] - squares[1]) / (2 * length)
    across = squares[0] / length - along * along
    if not across > 0:
        return None
    side = sheet * across.sqrt()
    first = along * a - side * b, along * b + side * a
    second = first[0] - a, first[1] - b
    return (
        waves.on_fiber(*angles[0], first, squares[0]),
        waves.on_fiber(*angles[1], second, squares[1]),
    )


def _cosine_sine(turn: fmpq) -> tuple[arb, arb]:
    half_turns = arb(2 * turn)
    return half_turns.cos_pi(), half_turns.sin_pi()


def _vertex(road: SurfaceRoadmap, turn: fmpq, point: tuple[arb, arb]) -> Vertex | None:
    """The strip of a point and the sign of Delta there; None where it is not told."""
    x = _chart(road, turn)
    if x is None:
        return None
    c, s = point
    p, q, constant = (part(x) for part in road.parts)
    value = p * c + q * s + constant
    strip = road.strip_of(x, _BITS)
    if strip is None or value.contains(0):
        return None
    return strip, 1 if value > 0 else -1


def _chart(road: SurfaceRoadmap, turn: fmpq) -> arb | None:
    c, s = _cosine_sine(turn)
    d, e = (arb(value) for value in road.surface.base.rotation)
    below = 1 + c * d + s * e
    return None if below.contains(0) else (s * d - c * e) / below
