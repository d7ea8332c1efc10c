"""The graph of a roadmap, with the vertices of query points (``GraphIsotop``)."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import networkx as nx

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.univariate import PRECISIONS
from cuspaudit.errors import PrecisionError
from cuspaudit.surface.roadmap import Roadmap
from cuspaudit.surface.sample_points import Fiber, Posture

__all__ = ["RoadmapGraph", "Vertex", "graph_isotop"]

Vertex = tuple[int, int]


@dataclass(frozen=True, eq=False)
class RoadmapGraph:
    """A graph with the connectivity of a roadmap.

    Attributes:
        graph: a vertex (strip, sign) for every arc of the roadmap over a strip; an
            edge where two arcs are joined over a zero of D, or (``around``) over the
            point of the base circle without chart.
        aspects: for every vertex the number of its connected component.
        placed: the vertex of every query point.
    """

    graph: nx.Graph[Vertex]
    aspects: dict[Vertex, int]
    placed: Mapping[Any, Vertex]

    def vert(self, fiber: Fiber) -> list[Vertex]:
        """The vertices of the postures of one fiber (the paper's ``Vert``)."""
        return [self.placed[posture] for posture in fiber.postures]

    def aspect(self, posture: Hashable) -> int:
        """The number of the aspect a query point lies in."""
        return self.aspects[self.placed[posture]]

    def turns(self, first: Hashable, second: Hashable) -> int:
        """How often a way between two connected postures goes round the base circle.

        Counted with sign: crossings of the point without chart, upwards positive.
        """
        way = nx.shortest_path(self.graph, self.placed[first], self.placed[second])
        around = (e for e in pairwise(way) if self.graph.edges[e].get("around"))
        return sum(1 if a[0] > b[0] else -1 for a, b in around)

    @property
    def number_of_aspects(self) -> int:
        """The number of connected components of V - {Delta = 0}."""
        return nx.number_connected_components(self.graph)


def graph_isotop(
    roadmap: Roadmap, delta: Polynomial, postures: Sequence[Posture]
) -> RoadmapGraph:
    """The graph of ``roadmap`` with the query points placed on it.

    [Paper, routine GraphIsotop]. A posture lies on the arc of its strip with the sign
    of Delta there, because there is one arc a sign.

    Args:
        roadmap: of V - {Delta = 0}.
        delta: Delta in the ring of V.
        postures: query points with Delta != 0, none over a zero of D.

    Raises:
        PrecisionError: a posture could not be separated from a zero of D.
    """
    graph: nx.Graph[Vertex] = nx.Graph()
    for index, strip in enumerate(roadmap.strips):
        graph.add_nodes_from((index, sign) for sign in strip.signs)
    for index, sign in enumerate(roadmap.passing):
        if sign:
            graph.add_edge((index, sign), (index + 1, sign))
    last = len(roadmap.strips) - 1
    if roadmap.is_closed and last:
        for sign in roadmap.strips[0].signs:
            if not graph.has_edge((0, sign), (last, sign)):
                graph.add_edge((0, sign), (last, sign), around=True)
    aspects = {
        vertex: number
        for number, component in enumerate(nx.connected_components(graph))
        for vertex in component
    }
    numerator, _ = roadmap.surface.chart(delta)
    placed = {p: (_strip(roadmap, p), p.sign(numerator)) for p in postures}
    return RoadmapGraph(graph, aspects, placed)


def _strip(roadmap: Roadmap, posture: Posture) -> int:
    for bits in PRECISIONS:
        try:
            _, x = posture.chart(bits)
        except PrecisionError:
            continue
        strip = roadmap.strip_of(x, bits)
        if strip is not None:
            return strip
    raise PrecisionError("strip of a posture", PRECISIONS[-1])
