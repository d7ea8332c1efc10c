"""The components of V - {Delta = 0}, from the sheets of R over the cells of R^d.

A roadmap of the paper for the projection R itself. On V - {Delta = 0} the map
R: V -> R^d is a local diffeomorphism, so its polar varieties are empty there and no
deformation of {Delta != 0} is needed; what remains of Canny's curve are fibers of R
over segments of R^d parallel to the axes.

**Theorem.** Let g = lc disc (``geometry.fibers.generic_fiber``). The vertices are the
pairs (cell of {g != 0}, sheet over it). An edge joins two sheets, over a contact of two
cells, that continue each other with Delta != 0: sheet i and sheet i over a passage;
over a wall, the sheets that end in one point of V with Delta != 0 over it. The
components of V - {Delta = 0} are those of this graph.

Proof. Over a cell, R is a covering with numbered sheets, so a vertex is a connected
piece of M = V - {Delta = 0}; the pieces are open and dense in M. What lies over a set
of codimension 2 in R^d has codimension 2 in the manifold M, because R is a local
homeomorphism there, and does not disconnect M. Left are the contacts. Along one wall
the same sheets continue each other over almost all of its points: at a point of the
wall {g = 0} is smooth, so after a base change the sheets are Puiseux series in a power
of its equation with coefficients analytic along the wall (Abhyankar-Jung); those
without ramification and poles are sections of R. A section through {Delta != 0} at one
point of the wall is there at almost all; so the chosen point can only miss a pair if
Delta vanishes there on a section that it does not vanish on elsewhere. Where a pair may
be missing this is excluded exactly (``geometry.sheets.wall_points``). QED
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

import networkx as nx
import numpy as np
from flint import arb, ctx, fmpq
from numpy.typing import NDArray

from cuspaudit.algebra.points.parametrization import RealPoint
from cuspaudit.algebra.rationals import exact_rational
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.algebra.univariate import PRECISIONS
from cuspaudit.errors import PrecisionError, UnableError
from cuspaudit.geometry.cells.open_cells import (
    Cell,
    Contact,
    OpenCells,
    Point,
    open_cells,
)
from cuspaudit.geometry.cells.way_inside import way_inside
from cuspaudit.geometry.fibers.generic_fiber import GenericFiber, generic_fiber
from cuspaudit.geometry.lifts.continuation import (
    Continuation,
    continue_point,
    follow,
    square_chart,
)
from cuspaudit.geometry.lifts.lifting import Box, Chart
from cuspaudit.geometry.sheets.sheet_crossing import cross, only_met
from cuspaudit.geometry.sheets.wall_points import WallPoints
from cuspaudit.runtime.clock import check_time, time_limit

__all__ = ["Roadmap", "Sheet", "roadmap"]

#: a vertex: a cell of {g != 0} and the number of a sheet over it, by increasing lambda
Sheet = tuple[Cell, int]

_BITS = 106
#: segments of the way through one cell, more when the proof stops
_STEPS = (8, 32, 128)

QueryPoint = RealPoint | Sequence[fmpq | int]


@dataclass(frozen=True, eq=False)
class Roadmap:
    """The sheets of R over the cells of {g != 0}, and which continue each other.

    Attributes:
        fiber: the generic fiber of R.
        cells: the cells of {g != 0} with their contacts.
        graph: vertices (cell, sheet); an edge has the contact it crosses.
        grounds: what completeness rests on beside proofs by exact arithmetic.
        placed: the query points so far.
    """

    fiber: GenericFiber
    cells: OpenCells
    graph: nx.Graph[Sheet]
    grounds: set[str]
    placed: dict[QueryPoint, tuple[Sheet, Point]] = field(default_factory=dict)

    @cached_property
    def components(self) -> dict[Sheet, int]:
        """The number of the component of V - {Delta = 0} of every vertex."""
        return {
            sheet: number
            for number, part in enumerate(nx.connected_components(self.graph))
            for sheet in part
        }

    @property
    def number_of_components(self) -> int:
        """The number of connected components of V - {Delta = 0}."""
        return nx.number_connected_components(self.graph)

    def sheets(self, cell: Cell) -> list[Sheet]:
        """The vertices over a cell."""
        return [(cell, i) for i in range(self.counts[cell])]

    @cached_property
    def counts(self) -> dict[Cell, int]:
        """The number of sheets over every cell: of real points of its fibers."""
        return {
            cell: len(self.fiber.sheets(value))
            for cell, value in self.cells.samples.items()
        }

    def vert(self, points: Iterable[QueryPoint]) -> list[Sheet]:
        """A vertex of the component of each point of V - {Delta = 0}.

        [Paper, routine GraphIsotop]. The point is continued, with proof, to a point
        over a rational value inside a cell.

        Args:
            points: real points of V with Delta != 0, algebraic or rational.

        Raises:
            PrecisionError: a point could not be continued; perhaps Delta = 0 there.
        """
        return [self._placed(point)[0] for point in points]

    def component(self, point: QueryPoint) -> int:
        """The number of the component that a point of V - {Delta = 0} lies in."""
        return self.components[self._placed(point)[0]]

    def connected(self, first: QueryPoint, second: QueryPoint) -> bool:
        """Whether two points lie in one component of V - {Delta = 0}."""
        return self.component(first) == self.component(second)

    def path(self, first: QueryPoint, second: QueryPoint) -> NDArray[np.float64]:
        """Way points (m, n) on V between two points of one component, in doubles.

        A proposal; `continuation` proves a path between the two points.
        """
        ring, steps = self.fiber.variety.ring, _STEPS[0]
        inner = [
            self.fiber.sheets(value)[sheet]
            for value, sheet in self._way(first, second, steps)
        ]
        points = (_box(ring, first, _BITS), *inner, _box(ring, second, _BITS))
        return np.array([[float(x.mid()) for x in point] for point in points])

    def continuation(self, first: QueryPoint, second: QueryPoint) -> Continuation:
        """A proved path on V - {Delta = 0} from near ``first`` to near ``second``.

        It begins and ends at the points over the rational values that the two points
        were continued to.

        Raises:
            UnableError: the way in R^d could not be lifted, however fine.
        """
        (_, value), (end, last) = self._placed(first), self._placed(second)
        for steps in _STEPS:
            way = self._way(first, second, steps)
            start = self.fiber.sheets(value)[way[0][1]]
            path = [y for y, _ in way]
            found = continue_point(self.fiber.variety, self.fiber.mapping, start, path)
            goal = self.fiber.sheets(last)
            if found is not None and only_met(found.end, goal) == end[1]:
                return found
        raise UnableError("roadmap", "a path could not be proved")

    def _way(
        self, first: QueryPoint, second: QueryPoint, steps: int
    ) -> list[tuple[Point, int]]:
        """Rational values of R with sheets over them, between connected points."""
        (start, value), (end, last) = self._placed(first), self._placed(second)
        way: list[tuple[Point, int]] = []
        vertices = nx.shortest_path(self.graph, start, end)
        for here, there in pairwise(vertices):
            contact: Contact = self.graph.edges[here, there]["contact"]
            ends = contact.ends if contact.cells[0] == here[0] else contact.ends[::-1]
            inside = way_inside(self.cells, value, ends[0], steps)
            way += [(y, here[1]) for y in inside]
            value = ends[1]
        inside = way_inside(self.cells, value, last, steps)
        return way + [(y, end[1]) for y in inside]

    def _placed(self, point: QueryPoint) -> tuple[Sheet, Point]:
        """A vertex, and a value in its cell, that the point can be continued to."""
        key = point if isinstance(point, RealPoint) else tuple(point)
        if key not in self.placed:
            self.placed[key] = self._place(point)
        return self.placed[key]

    def _place(self, point: QueryPoint) -> tuple[Sheet, Point]:
        for bits in PRECISIONS[1:]:
            with ctx.workprec(bits):
                box = _box(self.fiber.variety.ring, point, bits)
                chart = square_chart(self.fiber.variety, self.fiber.mapping, box)
                if chart is None:
                    continue
                for value in _near(chart.coordinates.values(box), bits // 4):
                    found = self._continued(chart, box, value)
                    if found is not None:
                        return found, value
        raise PrecisionError("the place of a point on the roadmap", PRECISIONS[-1])

    def _continued(self, chart: Chart, box: Box, value: Point) -> Sheet | None:
        """The vertex that the point in ``box`` is continued to over ``value``."""
        try:
            cell = self.cells.cell(value)
        except PrecisionError:
            return None
        start = tuple(chart.coordinates.values(box))
        way = follow(chart, box, start, tuple(map(arb, value)))
        met = None if way is None else only_met(way.end, self.fiber.sheets(value))
        return None if met is None else (cell, met)


def roadmap(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    *,
    fiber: GenericFiber | None = None,
    cells: OpenCells | None = None,
    timeout: float = 60.0,
    seed: int = 1,
    progress: Callable[[str], None] = lambda step: None,
) -> Roadmap:
    """The components of V - {Delta = 0}.

    [Paper, routines Roadmap and GraphIsotop]; by the theorem of this module.

    Args:
        variety: V = {f = 0} over Q, of dimension d; assumption (A) of the paper is
            assumed (``geometry.assumption_a`` checks it).
        mapping: R: V -> R^d.
        fiber: the generic fiber of R, if it is known already.
        cells: its open cells, if they are known already.
        timeout: in s.
        seed: of msolve's random choices.
        progress: called with the name of each step before it runs.

    Raises:
        DegenerateMapError: the values of R fill no open set.
        UnableError: too large, too long, or a wall that could not be decided.
    """
    with time_limit(timeout):
        if fiber is None:
            progress("atypical_values")
            fiber = generic_fiber(variety, mapping, timeout, seed)
        return _roadmap(fiber, cells, timeout, seed, progress)


def _roadmap(
    fiber: GenericFiber,
    cells: OpenCells | None,
    timeout: float,
    seed: int,
    progress: Callable[[str], None],
) -> Roadmap:
    check_time("roadmap")
    if cells is None:
        progress("sample_points_rational")
        boundary = [fiber.leading, fiber.discriminant]
        cells = open_cells(fiber.ring, boundary, fiber.values)
    progress("sample_points")
    graph: nx.Graph[Sheet] = nx.Graph()
    points = WallPoints(fiber, timeout, seed)
    roadmap = Roadmap(fiber, cells, graph, points.grounds)
    for cell in cells.samples:
        check_time("roadmap")
        graph.add_nodes_from(roadmap.sheets(cell))
    progress("graph_isotop")
    joined = nx.utils.UnionFind(graph.nodes)
    for contact in sorted(cells.contacts, key=lambda contact: contact.is_wall):
        check_time("roadmap")
        first, second = (roadmap.sheets(cell) for cell in contact.cells)
        if len({joined[sheet] for sheet in (*first, *second)}) < 2:
            continue
        for i, j in _pairs(fiber, contact, len(first), len(second), points):
            graph.add_edge(first[i], second[j], contact=contact)
            joined.union(first[i], second[j])
    return roadmap


def _pairs(
    fiber: GenericFiber, contact: Contact, first: int, second: int, points: WallPoints
) -> list[tuple[int, int]]:
    if not contact.is_wall:
        return [(i, i) for i in range(first)]
    if not (first and second):
        return []
    return cross(fiber, contact, lambda: points.regular(contact))


def _box(ring: Ring, point: QueryPoint, bits: int) -> Box:
    if isinstance(point, RealPoint):
        balls = point.ball(bits)
        return tuple(balls[name] for name in ring.variables)
    return tuple(arb(x) for x in point)


def _near(values: Sequence[arb], bits: int) -> list[Point]:
    """Rational points close to the midpoint, in directions of no importance."""
    middle = [exact_rational(y) for y in values]
    steps = [fmpq(k, 2**bits) for k in (0, 1, -1)]
    return [tuple(y + step * (j + 2) for j, y in enumerate(middle)) for step in steps]
