"""Routing on a torus: maxima of |h|, the saddles between them, and the widest paths.

As a level falls, components of {|h| >= level} are born at maxima of |h| and join at
saddles, critical points whose Hessian (of |h|) has exactly one positive eigenvalue, the
two ascents from which end in maxima [Hong, Rohal, Safey El Din, Schost 2020]. A maximum
spanning tree of this graph holds the widest path between any two points: the one on
which the smallest |h| is largest.

The graph is found by a seeded search in floating point. It proves nothing: the number
of components is proved by ``geometry.torus.components``, which also tells whether the
search has found enough; a path is proved where it is used, in ball arithmetic.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import beside, separation
from cuspaudit.geometry.torus.critical import ascents, critical_points
from cuspaudit.geometry.torus.function import TorusFunction

__all__ = ["Merge", "TorusRouting", "WidestPath", "torus_routing"]

Array = NDArray[np.float64]

_ROUNDS = 8
_STARTS = 1500
_OFF_SADDLE = 1e-3
_AT_MAXIMUM = 0.05


@dataclass(frozen=True, eq=False)
class WidestPath:
    """A path on the torus and the smallest |h| on it.

    Attributes:
        points: (m, k) way points, angles not reduced modulo 2 pi.
        level: the smallest |h| at the way points.
    """

    points: Array
    level: float


@dataclass(frozen=True)
class Merge:
    """Two groups of maxima that join as the level falls.

    Attributes:
        level: |h| at the saddle.
        saddle: its angles.
        first: the maxima on one side, by number.
        second: those on the other.
    """

    level: float
    saddle: tuple[float, ...]
    first: frozenset[int]
    second: frozenset[int]


@dataclass(frozen=True, eq=False)
class TorusRouting:
    """Maxima of |h| and the saddles that join them.

    Attributes:
        function: h.
        seed: of the search.
        maxima: (m, k) angles in [-pi, pi).
        saddles: (n, k) likewise; Hessians with one positive eigenvalue.
        others: (l, k) the other critical points with h != 0.
        graph: a vertex for every maximum, with its ``point`` and ``level``; an edge
            for two maxima that a saddle joins, the highest such, with its ``level``,
            the number of its ``saddle``, and the ``way`` (from the smaller vertex).
    """

    function: TorusFunction
    seed: int
    maxima: Array
    saddles: Array
    others: Array
    graph: nx.Graph[int]

    @property
    def number_of_components(self) -> int:
        """The number of groups of maxima: at least that of components, if all found."""
        return nx.number_connected_components(self.graph)

    @property
    def grounds(self) -> tuple[str, ...]:
        """What the graph rests on: a search."""
        return ("a search in floating point",)

    @property
    def largest(self) -> float:
        """The largest |h| found."""
        return float(np.abs(self.function(self.maxima)).max())

    @cached_property
    def tree(self) -> nx.Graph[int]:
        """The maximum spanning forest by level."""
        return nx.maximum_spanning_tree(self.graph, weight="level")

    def merges(self) -> list[Merge]:
        """The merge tree: joins of groups of maxima, highest level first."""
        edges: list[tuple[int, int, dict[str, Any]]] = sorted(
            self.tree.edges(data=True), key=lambda e: -e[2]["level"]
        )
        groups = {i: frozenset([i]) for i in self.graph}
        found = []
        for i, j, edge in edges:
            first, second = groups[i], groups[j]
            saddle = tuple(float(x) for x in self.saddles[edge["saddle"]])
            found.append(Merge(edge["level"], saddle, first, second))
            groups.update(dict.fromkeys(first | second, first | second))
        return found

    def vert(self, points: Array) -> list[int]:
        """The maximum that the ascent from each of (n, k) points ends at.

        An ascent that ends elsewhere (at a saddle, or at a maximum that was not found)
        gives the nearest one.
        """
        return [_nearest(self.maxima, way[-1])[0] for way in self._climb(points)]

    def component(self, point: Array) -> frozenset[int]:
        """The maxima of the group that the ascent from a point ends in."""
        [vertex] = self.vert(np.asarray(point)[None, :])
        return frozenset(nx.node_connected_component(self.graph, vertex))

    def connected(self, p: Array, q: Array) -> bool:
        """Whether the ascents from two points end in one group."""
        return self.component(p) == self.component(q)

    def widest_path(self, p: Array, q: Array) -> WidestPath | None:
        """The widest path from ``p`` to ``q`` through the maxima, or None.

        Up from p, along the maximum spanning tree, down to q. Its level is the
        smallest of |h(p)|, |h(q)| and the saddles on the way.
        """
        up, down = self._climb(np.array([p, q], dtype=np.float64))
        first, second = (_nearest(self.maxima, way[-1])[0] for way in (up, down))
        if not nx.has_path(self.tree, first, second):
            return None
        pieces = [up]
        for i, j in pairwise(nx.shortest_path(self.tree, first, second)):
            way = self.tree.edges[i, j]["way"]
            pieces.append(way if i < j else way[::-1])
        points = _chain([*pieces, down[::-1]])
        return WidestPath(points, float(np.abs(self.function(points)).min()))

    def path(self, p: Array, q: Array) -> Array | None:
        """The way points of the widest path."""
        widest = self.widest_path(p, q)
        return None if widest is None else widest.points

    def _climb(self, points: Array) -> list[Array]:
        return ascents(self.function, np.asarray(points, dtype=np.float64))


def torus_routing(
    function: TorusFunction, seed: int = 0, components: int | None = None
) -> TorusRouting:
    """The routing graph of |h|, by Newton's method from seeded random points.

    Args:
        function: h, not identically zero.
        seed: of the random points.
        components: the proved number of components of {h != 0}. The search goes on,
            up to eight rounds, until it finds that many groups and then one round
            adds no critical point; without it, until a round adds none.
    """
    rng = np.random.default_rng(seed)
    found = np.empty((0, function.dimension))
    for _ in range(_ROUNDS):
        size = (_STARTS, function.dimension)
        starts = rng.uniform(-np.pi, np.pi, size)
        before = len(found)
        more = critical_points(function, starts)
        found = critical_points(function, np.concatenate([found, more]))
        if len(found) == before:
            routing = _routing(function, seed, found)
            if components in (None, routing.number_of_components):
                return routing
    return _routing(function, seed, found)


def _routing(function: TorusFunction, seed: int, found: Array) -> TorusRouting:
    level = function(found)
    bend = function.hessian(found) * np.sign(level)[:, None, None]
    values, vectors = np.linalg.eigh(bend)
    rising = (values > 0).sum(1)
    maxima, saddles = found[rising == 0], found[rising == 1]
    out = _OFF_SADDLE * vectors[rising == 1][:, :, -1]
    graph = _graph(function, maxima, saddles, out)
    return TorusRouting(function, seed, maxima, saddles, found[rising > 1], graph)


def _graph(
    function: TorusFunction, maxima: Array, saddles: Array, out: Array
) -> nx.Graph[int]:
    graph: nx.Graph[int] = nx.Graph()
    for i, point in enumerate(maxima):
        level = float(np.abs(function(point)))
        graph.add_node(i, point=point, level=level)
    ways = ascents(function, np.concatenate([saddles + out, saddles - out]))
    order = np.argsort(-np.abs(function(saddles)), kind="stable")
    for k in order:
        one, two = ways[k], ways[k + len(saddles)]
        (i, off), (j, away) = (_nearest(maxima, way[-1]) for way in (one, two))
        if i == j or graph.has_edge(i, j) or max(off, away) > _AT_MAXIMUM:
            continue
        way = _chain([maxima[[i]], one[::-1], saddles[[k]], two, maxima[[j]]])
        level = float(np.abs(function(saddles[k])))
        graph.add_edge(
            i, j, level=level, saddle=int(k), way=way if i < j else way[::-1]
        )
    return graph


def _nearest(maxima: Array, point: Array) -> tuple[int, float]:
    """The number of the nearest maximum and how far it is, in rad."""
    apart = separation(maxima, point).max(1)
    return int(apart.argmin()), float(apart.min())


def _chain(pieces: list[Array]) -> Array:
    """Pieces joined end to start, each turned whole turns to lie next to the last."""
    points = [pieces[0]]
    for piece in pieces[1:]:
        points.append(beside(piece, points[-1][-1]))
    return np.concatenate(points)
