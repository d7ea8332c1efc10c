"""The graph of a roadmap, with the vertices of query points (``GraphIsotop``).

It is a handful of chains and circles of strips. A search by breadth is all that is
asked of it, and written here: loading a library of graphs takes longer than most runs.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, TypeVar

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.univariate import PRECISIONS
from cuspaudit.errors import PrecisionError
from cuspaudit.surface.roadmap import SurfaceRoadmap
from cuspaudit.surface.sample_points import Fiber, FiberPosture

__all__ = ["RoadmapGraph", "Vertex", "components", "graph_isotop", "reached"]

Vertex = tuple[int, int]
Node = TypeVar("Node", bound=Hashable)


@dataclass(frozen=True, eq=False)
class RoadmapGraph:
    """A graph with the connectivity of a roadmap.

    Attributes:
        neighbors: a vertex (strip, sign) for every arc of the roadmap over a strip,
            with those it has an edge to: two arcs are joined over a zero of D, or over
            the point of the base circle without chart.
        around: the edges over that point, each both ways.
        aspects: for every vertex the number of its connected component.
        placed: the vertex of every query point.
    """

    neighbors: Mapping[Vertex, Sequence[Vertex]]
    around: frozenset[tuple[Vertex, Vertex]]
    aspects: dict[Vertex, int]
    placed: Mapping[Any, Vertex]

    def vert(self, fiber: Fiber) -> list[Vertex]:
        """The vertices of the postures of one fiber (the paper's ``Vert``)."""
        return [self.placed[posture] for posture in fiber.postures]

    def aspect(self, posture: Hashable) -> int:
        """The number of the aspect a query point lies in."""
        return self.aspects[self.placed[posture]]

    def connected(self, first: Vertex, second: Vertex) -> bool:
        """Whether two vertices are connected (the paper's ``GraphConnected``)."""
        return self.aspects[first] == self.aspects[second]

    def turns(self, first: Hashable, second: Hashable) -> int:
        """How often a way between two connected postures goes round the base circle.

        Counted with sign: crossings of the point without chart, upwards positive.
        """
        start, end = self.placed[first], self.placed[second]
        way, before = [end], reached(self.neighbors, start)
        while way[-1] != start:
            way.append(before[way[-1]])
        steps = ((a, b) for a, b in pairwise(reversed(way)) if (a, b) in self.around)
        return sum(1 if a[0] > b[0] else -1 for a, b in steps)

    @property
    def number_of_aspects(self) -> int:
        """The number of connected components of V - {Delta = 0}."""
        return len(set(self.aspects.values()))


def graph_isotop(
    roadmap: SurfaceRoadmap, delta: Polynomial, postures: Sequence[FiberPosture]
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
    neighbors: dict[Vertex, list[Vertex]] = {
        (index, sign): []
        for index, strip in enumerate(roadmap.strips)
        for sign in strip.signs
    }

    def join(first: Vertex, second: Vertex) -> None:
        neighbors[first].append(second)
        neighbors[second].append(first)

    for index, sign in enumerate(roadmap.passing):
        if sign:
            join((index, sign), (index + 1, sign))
    last = len(roadmap.strips) - 1
    around: list[tuple[Vertex, Vertex]] = []
    if roadmap.is_closed and last:
        for sign in roadmap.strips[0].signs:
            low, high = (0, sign), (last, sign)
            if high not in neighbors[low]:
                join(low, high)
                around += [(low, high), (high, low)]
    numerator, _ = roadmap.surface.chart(delta)
    placed = {p: (_strip(roadmap, p), p.sign(numerator)) for p in postures}
    return RoadmapGraph(neighbors, frozenset(around), components(neighbors), placed)


def components(neighbors: Mapping[Node, Sequence[Node]]) -> dict[Node, int]:
    """The number of its connected component, for every vertex."""
    numbers: dict[Node, int] = {}
    count = 0
    for vertex in neighbors:
        if vertex not in numbers:
            numbers.update(dict.fromkeys(reached(neighbors, vertex), count))
            count += 1
    return numbers


def reached(neighbors: Mapping[Node, Sequence[Node]], start: Node) -> dict[Node, Node]:
    """What a search by breadth from ``start`` meets, each with the vertex before it."""
    before, waiting = {start: start}, deque([start])
    while waiting:
        vertex = waiting.popleft()
        for other in neighbors[vertex]:
            if other not in before:
                before[other] = vertex
                waiting.append(other)
    return before


def _strip(roadmap: SurfaceRoadmap, posture: FiberPosture) -> int:
    for bits in PRECISIONS:
        try:
            _, x = posture.chart(bits)
        except PrecisionError:
            continue
        strip = roadmap.strip_of(x, bits)
        if strip is not None:
            return strip
    raise PrecisionError("strip of a posture", PRECISIONS[-1])
