"""Connected components of V - {Delta = 0} by routing functions.

**Theorem.** Let M be the set of regular points of V with P != 0, G a height on it
(``geometry.heights.height``) such that every {G >= c} is compact, and all critical
points of G nondegenerate. Give every critical point S with exactly one positive
eigenvalue of the Hessian ("saddle") an edge: each of its two exits, the pieces of {G >
G(S)} next to S, is joined to some maximum by a path on which G > G(S), and the edge
joins these two maxima. Then two maxima lie in one component of M if and only if they
are connected in this graph, and every component of M has a maximum.

*Proof.* (Hong, Rohal, Safey El Din, Schost, "Connectivity in semi-algebraic sets I",
2020.) G attains its largest value on a component of M, because {G >= c} is compact:
that is a maximum. An edge comes from a path in M, so connected maxima lie in one
component. For the converse lower c from above all critical values. By Morse theory
{G >= c} changes, up to homotopy, only when c passes a critical value, by attaching for
every critical point of that value a cell of dimension p, its number of positive
eigenvalues. p = 0 is a maximum: a new component. p >= 2 attaches a cell along a
connected sphere: the components stay. p = 1 joins the components of the two exits.
So by induction two maxima above c lie in one component of {G > c} if and only if they
are connected by edges of saddles above c: a path on which G > G(S) leads to a maximum
in the same component of {G > G(S)} as the exit. A path in M is compact and so lies in
some {G > c}. QED.

The level matters: with paths that dip below G(S) an edge could join the wrong pair of
maxima, and the graph fall apart. Points need no level: any path in M to a maximum will
do. With w = 1, exp(G(S)/2) = |h(S)| is the clearance: the largest smallest |h| on any
path between maxima that the saddle is the first to connect.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import networkx as nx
import numpy as np
from flint import arb
from numpy.typing import NDArray

from cuspaudit.algebra.points.parametrization import RealPoint
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import (
    NotOnVarietyError,
    NotZeroDimensionalError,
    PrecisionError,
    UnableError,
)
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.geometry.heights.critical_points import Point, box_of, critical_points
from cuspaudit.geometry.heights.height import heights
from cuspaudit.geometry.heights.morse import Basin, CriticalPoint
from cuspaudit.geometry.heights.proved_ascent import Ascent, prove_ascent
from cuspaudit.geometry.heights.saddle_ways import SaddleWay, basin_of, graph_of_ways
from cuspaudit.geometry.lifts.lifting import Box
from cuspaudit.runtime.clock import time_left, time_limit

__all__ = ["Point", "Routing", "morse_graph", "routing"]

Array = NDArray[np.float64]
_QUERY_BITS = 212


@dataclass(frozen=True, eq=False)
class Routing:
    """The components of V - {Delta = 0}, proved.

    Attributes:
        landscape: V and the height G.
        maxima: all maxima of G.
        saddles: all critical points with exactly one positive eigenvalue.
        graph: a vertex for each maximum, by number; an edge where a saddle joins two
            maxima, with the ``way`` over it and its ``level``.
        basins: of the maxima.
        grounds: what the list of critical points being complete rests on.
        seed: of the ascents.
    """

    landscape: ChartedHeight
    maxima: tuple[CriticalPoint, ...]
    saddles: tuple[CriticalPoint, ...]
    graph: nx.Graph[int]
    basins: tuple[Basin, ...]
    grounds: tuple[str, ...]
    seed: int
    ascents: dict[Point, Ascent] = field(default_factory=dict)

    @property
    def number_of_components(self) -> int:
        """The number of connected components of V - {Delta = 0}."""
        return nx.number_connected_components(self.graph)

    def vert(self, points: Sequence[Point]) -> list[int]:
        """The vertices of points of V with Delta != 0 (the paper's ``Vert``).

        Raises:
            UnableError: no ascent from a point could be proved.
        """
        return [self._ascent(point).top for point in points]

    def component(self, point: Point) -> int:
        """The number of the component of a point of V with Delta != 0."""
        (vertex,) = self.vert([point])
        parts = nx.connected_components(self.graph)
        return next(i for i, part in enumerate(parts) if vertex in part)

    def connected(self, first: Point, second: Point) -> bool:
        """Whether two points of V lie in one component of V - {Delta = 0}."""
        return bool(nx.has_path(self.graph, *self.vert([first, second])))

    def path(self, first: Point, second: Point) -> Array:
        """Way points (m, n) between two connected points, over the highest saddles."""
        a, b = self._ascent(first), self._ascent(second)
        ways = [a.places, *(way.places for way in self._ways(a.top, b.top))]
        return np.concatenate([*ways, b.places[::-1]])

    def boxes(self, first: Point, second: Point) -> tuple[Box, ...]:
        """Boxes in R^n, one after the other, that hold ``path``; P != 0 on each."""
        a, b = self._ascent(first), self._ascent(second)
        boxes = [step.image for step in a.steps]
        for way in self._ways(a.top, b.top):
            boxes += [self.basins[way.begins].lift.image, *way.boxes]
        boxes.append(self.basins[b.top].lift.image)
        return tuple(boxes + [step.image for step in reversed(b.steps)])

    def clearance(self, first: Point, second: Point) -> float:
        """The largest c such that some path between two points has |h| >= c.

        Sure to about six digits: the ascents of the points are proved to stay above
        their own level less 2^-20.

        Raises:
            UnableError: a weight was needed; then heights are not those of |h|.
        """
        if self.landscape.height.decay:
            raise UnableError("clearance", "the critical points of |h| are degenerate")
        a, b = self._ascent(first), self._ascent(second)
        ways = self._ways(a.top, b.top)
        return math.exp(min(a.level, b.level, *(way.level for way in ways)) / 2)

    def _ways(self, first: int, second: int) -> list[SaddleWay]:
        """The ways between maxima over the highest saddles, each turned forward."""
        tree = nx.maximum_spanning_tree(self.graph, weight="level")
        pairs = pairwise(nx.shortest_path(tree, first, second))
        return [tree.edges[u, v]["way"].beginning_at(u) for u, v in pairs]

    def _ascent(self, point: Point) -> Ascent:
        key = point if isinstance(point, RealPoint) else tuple(point)
        if key not in self.ascents:
            _check_query(self.landscape, point)
            ball = box_of(self.landscape.variety.ring, point, _QUERY_BITS)
            self.ascents[key] = _query_ascent(
                self.landscape, ball, self.basins, self.seed
            )
        return self.ascents[key]


def routing(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    minors: Sequence[Polynomial],
    queries: Sequence[Point] = (),
    *,
    seed: int = 1,
    timeout: float = 60,
    progress: Callable[[str], None] = lambda step: None,
) -> Routing:
    """The components of V - {Delta = 0} with the vertices of ``queries`` found.

    Args:
        variety: V = {f = 0} under assumption (A) of the paper, not checked.
        mapping: R.
        minors: those of ``crit``; their common zeros on V are {Delta = 0}.
        queries: points of V with Delta != 0.
        seed: of the weights and ascents.
        timeout: seconds for the whole graph.
        progress: called with the name of each step before it runs.

    Raises:
        UnableError: the critical points cannot be listed completely, every weight has
            degenerate ones, or an ascent could not be proved.
    """
    found = morse_graph(
        variety,
        mapping.dimension,
        minors,
        seed=seed,
        timeout=timeout,
        progress=progress,
    )
    progress("routing: query points")
    found.vert(queries)
    return found


def morse_graph(
    variety: PolynomialSystem,
    dimension: int,
    minors: Sequence[Polynomial],
    *,
    seed: int = 1,
    timeout: float = 60,
    progress: Callable[[str], None] = lambda step: None,
) -> Routing:
    """The components of the points of V where not all ``minors`` vanish.

    Args:
        variety: V = {f = 0}, of dimension d; jac f of rank n - d where a minor is not
            zero.
        dimension: d.
        minors: any polynomials, not all zero on a component of V.
        seed: of the weights and ascents.
        timeout: seconds for the whole graph.
        progress: called with the name of each step before it runs.
    """
    with time_limit(timeout):
        return _by_some_height(variety, dimension, minors, seed, progress)


def _by_some_height(
    variety: PolynomialSystem,
    dimension: int,
    minors: Sequence[Polynomial],
    seed: int,
    progress: Callable[[str], None],
) -> Routing:
    why = "no height"
    for height in heights(variety, minors, seed):
        landscape = ChartedHeight(variety, dimension, height)
        progress("routing: critical points")
        try:
            critical, grounds = critical_points(landscape, _left(), seed)
        except (NotZeroDimensionalError, UnableError) as error:
            why = str(error)
            continue
        if critical is not None:
            progress("routing: ascents")
            return _routing(landscape, critical, grounds, seed)
        why = "a critical point is degenerate"
    raise UnableError("routing", f"with every weight tried: {why}")


def _routing(
    landscape: ChartedHeight,
    critical: Sequence[CriticalPoint],
    grounds: tuple[str, ...],
    seed: int,
) -> Routing:
    tops, saddles = (
        tuple(point for point in critical if point.rising == count) for count in (0, 1)
    )
    basins = tuple(basin_of(landscape, top) for top in tops)
    graph = graph_of_ways(landscape, basins, saddles, seed, _left)
    return Routing(landscape, tops, saddles, graph, basins, grounds, seed)


def _left() -> float:
    return time_left("routing")


def _query_ascent(
    landscape: ChartedHeight, ball: Box, basins: Sequence[Basin], seed: int
) -> Ascent:
    level = landscape.height.value(ball)
    if level is None:
        raise PrecisionError("the sign of Delta at a query point", _QUERY_BITS)
    found = prove_ascent(landscape, ball, level - arb(2) ** -20, basins, seed)
    if found is None:
        raise UnableError("routing", "no ascent from a query point was proved")
    return found


def _check_query(landscape: ChartedHeight, point: Point) -> None:
    """Exactly: f = 0 and P != 0 at the point."""
    ring, base = landscape.variety.ring, landscape.height.base
    own = Ring(tuple(ring.context.names()))

    def vanishes(polynomial: Polynomial) -> bool:
        if isinstance(point, RealPoint):
            return point.sign(polynomial, own) == 0
        values = dict(zip(ring.variables, point, strict=True))
        return bool(ring.reduce(ring.substitute(polynomial, values)) == 0)

    if not all(map(vanishes, landscape.variety.equations)):
        raise NotOnVarietyError(str(point), "it is not on V")
    if vanishes(base):
        raise NotOnVarietyError(str(point), "Delta = 0 there")
