"""The ways between maxima of a height over its saddles, all proved."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import networkx as nx
import numpy as np
from flint import ctx
from numpy.typing import NDArray

from cuspaudit.errors import CrossCheckError, UnableError
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.geometry.heights.morse import Basin, CriticalPoint, basin, exits
from cuspaudit.geometry.heights.proved_ascent import Ascent, prove_ascent
from cuspaudit.geometry.lifts.continuation import BITS
from cuspaudit.geometry.lifts.lifting import Box

__all__ = ["SaddleWay", "basin_of", "graph_of_ways"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SaddleWay:
    """A proved way from one maximum over a saddle to another.

    Attributes:
        ascents: from the saddle to either maximum.
        level: of G at the saddle.
    """

    ascents: tuple[Ascent, Ascent]
    level: float

    @property
    def begins(self) -> int:
        """The maximum where it begins."""
        return self.ascents[0].top

    @property
    def places(self) -> Array:
        """(m, n) way points."""
        down, up = self.ascents
        return np.concatenate([down.places[::-1], up.places])

    @property
    def boxes(self) -> list[Box]:
        """Boxes that cover it between the basins of the two maxima."""
        down, up = self.ascents
        return [step.image for step in (*reversed(down.steps), *up.steps)]

    def beginning_at(self, top: int) -> SaddleWay:
        """The same way, turned round if need be."""
        return self if self.begins == top else SaddleWay(self.ascents[::-1], self.level)


def graph_of_ways(
    landscape: ChartedHeight,
    basins: Sequence[Basin],
    saddles: Sequence[CriticalPoint],
    seed: int,
    check: Callable[[], object],
) -> nx.Graph[int]:
    """The graph of the theorem of ``geometry.routing``, from the highest saddle down.

    Without effect, hence skipped: a saddle on the side of P > 0 (or < 0) once all
    maxima of that side are connected.

    Args:
        landscape: V and G.
        basins: of all maxima.
        saddles: all critical points with exactly one positive eigenvalue.
        seed: of the ascents.
        check: called before each saddle; may raise.

    Returns:
        A vertex for each maximum, by number; an edge, with the ``way`` and its
        ``level``, where a saddle joins two, the highest if several do.
    """
    graph: nx.Graph[int] = nx.Graph()
    graph.add_nodes_from(range(len(basins)))
    for saddle in sorted(saddles, key=lambda s: s.level.mid(), reverse=True):
        side = [i for i, b in enumerate(basins) if b.top.sign == saddle.sign]
        if not side:
            raise CrossCheckError("a saddle on a side of Delta without a maximum")
        if nx.is_connected(graph.subgraph(side)):
            continue
        check()
        ahead, back = _two_ascents(landscape, saddle, basins, seed)
        if ahead.top != back.top and not graph.has_edge(ahead.top, back.top):
            level = float(saddle.level.mid())
            way = SaddleWay((ahead, back), level)
            graph.add_edge(ahead.top, back.top, level=level, way=way)
    return graph


def basin_of(landscape: ChartedHeight, top: CriticalPoint) -> Basin:
    """A basin of a maximum.

    Raises:
        UnableError: none was proved.
    """
    with ctx.workprec(BITS):
        found = basin(landscape, top)
    if found is None:
        raise UnableError("routing", "no neighbourhood of a maximum was proved")
    return found


def _two_ascents(
    landscape: ChartedHeight, saddle: CriticalPoint, basins: Sequence[Basin], seed: int
) -> tuple[Ascent, Ascent]:
    with ctx.workprec(BITS):
        pair = exits(landscape, saddle)
    if pair is None:
        raise UnableError("routing", "no exit of a saddle was proved")
    ways = [
        prove_ascent(landscape, exit_.end, saddle.level, basins, seed) for exit_ in pair
    ]
    if ways[0] is None or ways[1] is None:
        raise UnableError("routing", "no ascent from a saddle was proved")
    ahead, back = (
        way.after(exit_.lift, saddle.place)
        for way, exit_ in zip(ways, pair, strict=True)
        if way is not None
    )
    return ahead, back
