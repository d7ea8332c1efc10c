"""The components of V - {Delta = 0}, from the sheets of R over the cells of R^d.

A roadmap of the paper for the projection R itself. On V - {Delta = 0} the map
R: V -> R^d is a local diffeomorphism, so its polar varieties are empty there and no
deformation of {Delta != 0} is needed; what remains of Canny's curve are fibers of R
over segments of R^d parallel to the axes.

**Theorem.** Let g = lc disc (``geometry.generic_fiber``). The vertices are the pairs
(cell of {g != 0}, sheet over it). An edge joins two sheets, over a contact of two
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
be missing this is excluded exactly (``geometry.wall_points``). QED
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from time import monotonic

import networkx as nx
from flint import arb, ctx, fmpq

from cuspaudit.algebra.parametrization import RealPoint
from cuspaudit.algebra.rationals import exact_rational
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.algebra.univariate import PRECISIONS
from cuspaudit.errors import PrecisionError, UnableError
from cuspaudit.geometry.continuation import follow, square_chart
from cuspaudit.geometry.generic_fiber import GenericFiber, generic_fiber
from cuspaudit.geometry.lifting import Box
from cuspaudit.geometry.open_cells import Cell, Contact, OpenCells, Point, open_cells
from cuspaudit.geometry.sheet_crossing import cross, only_met
from cuspaudit.geometry.wall_points import WallPoints

__all__ = ["Sheet", "SheetRoadmap", "sheet_roadmap"]

#: a vertex: a cell of {g != 0} and the number of a sheet over it, by increasing lambda
Sheet = tuple[Cell, int]
QueryPoint = RealPoint | Sequence[fmpq | int]


@dataclass(frozen=True, eq=False)
class SheetRoadmap:
    """The sheets of R over the cells of {g != 0}, and which continue each other.

    Attributes:
        fiber: the generic fiber of R.
        cells: the cells of {g != 0} with their contacts.
        graph: vertices (cell, sheet); an edge has the contact it crosses.
        grounds: what completeness rests on beside proofs by exact arithmetic.
    """

    fiber: GenericFiber
    cells: OpenCells
    graph: nx.Graph[Sheet]
    grounds: set[str]

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
        return [self._vertex(point) for point in points]

    def component(self, point: QueryPoint) -> int:
        """The number of the component that a point of V - {Delta = 0} lies in."""
        return self.components[self._vertex(point)]

    def connected(self, first: QueryPoint, second: QueryPoint) -> bool:
        """Whether two points lie in one component of V - {Delta = 0}."""
        return self.component(first) == self.component(second)

    def _vertex(self, point: QueryPoint) -> Sheet:
        variety, mapping = self.fiber.variety, self.fiber.mapping
        for bits in PRECISIONS[1:]:
            with ctx.workprec(bits):
                box = _box(variety.ring, point, bits)
                chart = square_chart(variety, mapping, box)
                if chart is None:
                    continue
                y0 = tuple(chart.coordinates.values(box))
                for value in _near(y0, bits // 4):
                    try:
                        cell = self.cells.cell(value)
                    except PrecisionError:
                        continue
                    way = follow(chart, box, y0, tuple(map(arb, value)))
                    if way is None:
                        continue
                    found = only_met(way.end, self.fiber.sheets(value))
                    if found is not None:
                        return cell, found
        raise PrecisionError("the place of a point on the roadmap", PRECISIONS[-1])


def sheet_roadmap(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    *,
    timeout: float = 60.0,
    seed: int = 1,
    progress: Callable[[str], None] = lambda step: None,
) -> SheetRoadmap:
    """The components of V - {Delta = 0}.

    [Paper, routines Roadmap and GraphIsotop]; by the theorem of this module.

    Args:
        variety: V = {f = 0} over Q, of dimension d; assumption (A) of the paper is
            assumed (``geometry.assumption_a`` checks it).
        mapping: R: V -> R^d.
        timeout: in s; looked at between steps.
        seed: of msolve's random choices.
        progress: called with the name of each step before it runs.

    Raises:
        DegenerateMapError: the values of R fill no open set.
        UnableError: too large, too long, or a wall that could not be decided.
    """
    clock = _Clock("roadmap", monotonic() + timeout)
    progress("generic_fiber")
    fiber = generic_fiber(variety, mapping, timeout, seed)
    clock.check()
    progress("open_cells")
    boundary = [fiber.leading, fiber.discriminant]
    cells = open_cells(fiber.ring, boundary, fiber.values)
    progress("sample_points")
    graph: nx.Graph[Sheet] = nx.Graph()
    points = WallPoints(fiber, timeout, seed)
    roadmap = SheetRoadmap(fiber, cells, graph, points.grounds)
    for cell in cells.samples:
        clock.check()
        graph.add_nodes_from(roadmap.sheets(cell))
    progress("graph_isotop")
    joined = nx.utils.UnionFind(graph.nodes)
    for contact in sorted(cells.contacts, key=lambda contact: contact.is_wall):
        clock.check()
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


@dataclass(frozen=True)
class _Clock:
    step: str
    end: float

    def check(self) -> None:
        if monotonic() > self.end:
            raise UnableError(self.step, "no answer within the time limit")


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
