"""The exact topology of a real curve {f = 0, h_1 > 0, ..., h_t > 0} in R^n.

[Paper, routine GraphIsotop]. Let v = mu(x) and u = lambda(x) be forms in general
position and omega(u, v) = 0 the image of the curve. The *critical values* are the real
zeros of the discriminant of omega, of the resultants with the numerators of the h_j,
and the values of mu at the query points. Between two of them the curve consists of
branches in constant order by u, with constant signs of the h_j. The vertices are the
points over all critical values and over one rational value in each gap, with all
h_j > 0; the edges are the branches from one to the next.

**Theorem.** Without h, and with a ray for every end at infinity, the graph drawn with
straight edges is isotopic to the curve in R^n; with h likewise, when a half-open edge
is added for every end at a point where some h_j <= 0.

Proof. In a plane mu = v let u_i, w_i be the value of u and the other coordinates at
the points of the curve, u'_i, w'_i at those of the drawing. Both are numbered by u,
strictly increasing unless v is critical: two edges are in strict order by u on one end
and in weak order on the other. Let phi(u) and psi(u) be piecewise linear with phi(u_i)
= u'_i and psi(u_i) = w'_i - w_i, phi of slope 1 and psi constant outside. The map (u,
w) -> (phi(u), w + psi(u)) is a homeomorphism of the plane that takes one set of points
to the other and moves nothing farther than these are moved; so do the maps on the way
to it from the identity. They depend continuously on v, for near a critical value the
points move little. QED

Where several points of the curve have one image (u, v) all of them are vertices, so
that the drawing has the crossings of the curve.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations

import networkx as nx
from flint import arb, ctx

from cuspaudit.algebra.matrix import determinant, jacobian
from cuspaudit.algebra.points.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
    empty_set,
)
from cuspaudit.algebra.points.union import with_form
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.algebra.univariate import RealRoot
from cuspaudit.errors import CrossCheckError, NotOnVarietyError, UnableError
from cuspaudit.geometry.curves.fiber import CurveFiber, Place
from cuspaudit.geometry.curves.parametrization import Curve, parametrized_curve
from cuspaudit.geometry.curves.sections import CurveSections, curve_sections

__all__ = ["CurveGraph", "Vertex", "graph_isotop"]

_TRIES = 4
_BITS = 64

#: number of the plane, from below, and the place of the point in it
Vertex = tuple[int, Place]
#: balls of the coordinates of a point
Box = tuple[arb, ...]


@dataclass(frozen=True, eq=False)
class CurveGraph:
    """The topology of {f = 0, h > 0}, a curve in R^n.

    Attributes:
        curve: {f = 0} and its parametrization.
        conditions: h_1..h_t.
        graph: every vertex has ``kind``, ``point`` (balls of x_1..x_n), ``branches``
            (the half-branches of {f = 0} there) and ``ends`` (those of them that leave
            the set: to infinity, or to a point where some h_j <= 0). The kinds are
            "singular" (jac f has rank < n - 1), "vertical" (the tangent lies in
            mu = v), "crossing" (regular, not alone over (u, v)), "regular".
        grounds: what completeness rests on.
        points: the query points.
        queries: the vertices of the query points, by the value of mu; None outside.
    """

    curve: Curve
    conditions: tuple[Polynomial, ...]
    graph: nx.Graph[Vertex]
    grounds: tuple[str, ...]
    points: ZeroDimensionalParametrization
    queries: dict[RealRoot, Vertex | None] = field(repr=False)

    @property
    def number_of_components(self) -> int:
        """The number of connected components."""
        return nx.number_connected_components(self.graph)

    @property
    def euler_characteristic(self) -> int:
        """Vertices less edges: of the set up to homotopy, so 1 for a line."""
        return self.graph.number_of_nodes() - self.graph.number_of_edges()

    @property
    def ends(self) -> int:
        """The number of ends: at infinity, and where some h_j becomes 0."""
        return sum(own["ends"] for _, own in self.graph.nodes(data=True))

    def of_kind(self, kind: str) -> list[Vertex]:
        """The vertices of one kind."""
        return [v for v, own in self.graph.nodes("kind") if own == kind]

    @property
    def isolated(self) -> list[Vertex]:
        """The isolated real points of {f = 0} in the set."""
        return [v for v, count in self.graph.nodes("branches") if count == 0]

    def vert(self, points: ZeroDimensionalParametrization) -> list[Vertex]:
        """The vertices of the points of Z(Q) in the set, by increasing mu.

        [Paper, routine Vert].

        Args:
            points: Q with Z(Q) contained in the query points.

        Raises:
            NotOnVarietyError: some point of Z(Q) is no query point.
        """
        if not points.is_subset(self.points):
            raise NotOnVarietyError(f"of {points.variables}", "it was not asked for")
        own = _by_value(self.curve, points)
        assert own is not None, "mu separates a set of which this is a part"
        found = (self.queries[point.root] for point in own.real_points())
        return [vertex for vertex in found if vertex is not None]


def graph_isotop(
    system: PolynomialSystem,
    conditions: Sequence[Polynomial] = (),
    points: ZeroDimensionalParametrization | None = None,
    *,
    seed: int = 1,
    timeout: float = 60.0,
) -> CurveGraph:
    """A graph isotopic to the real curve {f = 0, h > 0}, by the theorem of the module.

    Args:
        system: f in Q[x_1..x_n], n >= 2, with {f = 0} a curve in C^n, <f> reduced.
        conditions: h_1..h_t.
        points: query points on {f = 0}; those with h > 0 become vertices.
        seed: of the forms lambda and mu.
        timeout: of each elimination and system, in s.

    Raises:
        NotOnVarietyError: a query point is not on the curve.
        UnableError: {f = 0} is no reduced curve, or too large.
    """
    ring = system.ring
    asked = empty_set(ring.variables) if points is None else points
    if not all(asked.vanishes(ring, f) for f in system.equations):
        raise NotOnVarietyError(f"of {asked.variables}", "f is not 0")
    for number in range(seed, seed + _TRIES):
        curve = parametrized_curve(system, number, timeout)
        queries = _by_value(curve, asked)
        if queries is not None:
            sections = curve_sections(curve, tuple(conditions), queries, timeout)
            return _Drawing(sections).graph(asked)
    raise UnableError("graph_isotop", "no form tried separates the query points")


def _by_value(
    curve: Curve, points: ZeroDimensionalParametrization
) -> ZeroDimensionalParametrization | None:
    """The points with parameter mu, None when it does not separate them."""
    return with_form(points, curve.parametrization.forms[1])


class _Drawing:
    """The vertices and edges over the sections of a curve.

    Attributes:
        sections: the curve cut at critical values and between them.
        drawn: the graph so far.
    """

    def __init__(self, sections: CurveSections) -> None:
        self.sections = sections
        self.ring = sections.curve.system.ring
        self.drawn: nx.Graph[Vertex] = nx.Graph()
        self.singular, self.vertical = _minors(sections.curve)

    def graph(self, asked: ZeroDimensionalParametrization) -> CurveGraph:
        """The graph, with the query points' vertices."""
        sections = self.sections
        for number, points in enumerate(sections.samples):
            self._add_sample(2 * number, points)
        for number, fiber in enumerate(sections.fibers):
            self._add_fiber(2 * number + 1, fiber)
        located = {q.root: self._located(q) for q in sections.queries.real_points()}
        return CurveGraph(
            *(sections.curve, sections.conditions, self.drawn, sections.grounds),
            *(asked, located),
        )

    def _add_sample(self, plane: int, points: Sequence[RealPoint]) -> None:
        """The points between two critical values; their ends at infinity."""
        open_sides = (plane == 0) + (plane == 2 * len(self.sections.fibers))
        for i, point in enumerate(points):
            if self.sections.is_inside(point):
                box = self._box(point)
                self._add((plane, (i, 0)), "regular", box, 2, open_sides)

    def _add_fiber(self, plane: int, fiber: CurveFiber) -> None:
        """The points over a critical value and the branches that end there."""
        for place, branches in fiber.places.items():
            self._add_point(plane, fiber, place, branches)
        for side, ends in ((plane - 1, fiber.left), (plane + 1, fiber.right)):
            for i, place in enumerate(ends):
                branch, end = (side, (i, 0)), (plane, place)
                if branch in self.drawn and end in self.drawn:
                    self.drawn.add_edge(branch, end)
                elif branch in self.drawn:
                    self.drawn.nodes[branch]["ends"] += 1
                elif end in self.drawn:
                    raise CrossCheckError("a condition changes its sign without a zero")

    def _add_point(
        self, plane: int, fiber: CurveFiber, place: Place, branches: int
    ) -> None:
        vertex = (plane, place)
        if place in fiber.listed:
            point = fiber.listed[place]
            if self.sections.is_inside(point):
                box = self._box(point)
                self._add(vertex, self._kind(point), box, branches, 0)
            return
        before = (plane - 1, (fiber.left.index(place), 0))
        after = (plane + 1, (fiber.right.index(place), 0))
        inside = before in self.drawn and after in self.drawn
        if inside and not self.sections.touches(fiber, place):
            self._add(vertex, "regular", self._simple(fiber, place), branches, 0)

    def _add(
        self, vertex: Vertex, kind: str, box: Box, branches: int, ends: int
    ) -> None:
        own = {"kind": kind, "point": box, "branches": branches, "ends": ends}
        self.drawn.add_node(vertex, **own)

    def _kind(self, point: RealPoint) -> str:
        """What the curve is like at a point with omega_u = 0, exactly."""
        if all(point.sign(m, self.ring) == 0 for m in self.singular):
            return "singular"
        if all(point.sign(m, self.ring) == 0 for m in self.vertical):
            return "vertical"
        return "crossing"

    def _box(self, point: RealPoint) -> Box:
        return tuple(point.ball(_BITS)[name] for name in self.ring.variables)

    def _simple(self, fiber: CurveFiber, place: Place) -> Box:
        """The coordinates of the point at a simple root of omega(.; v0)."""
        with ctx.workprec(2 * _BITS):
            v = fiber.value.enclosure(2 * _BITS)
            u = fiber.rulers[0].zeros[place[0]]
            return self.sections.curve.parametrization.point(u, v)

    def _located(self, query: RealPoint) -> Vertex | None:
        """The vertex of a query point, None when it is not in {h > 0}."""
        number = self.sections.values.index(query.root)
        vertex = (2 * number + 1, self.sections.fibers[number].place(query))
        return vertex if vertex in self.drawn else None


def _minors(curve: Curve) -> tuple[list[Polynomial], list[Polynomial]]:
    """The minors that vanish together where jac f, and jac(f, mu), drop rank."""
    ring, f = curve.system.ring, curve.system.equations
    rows, n = jacobian(ring, f), len(ring.variables)
    (last,) = jacobian(ring, [curve.line(curve.parametrization.forms[1])])
    singular, vertical = [], []
    for chosen in combinations(rows, n - 1):
        vertical.append(determinant(ring, [*chosen, last]))
        for columns in combinations(range(n), n - 1):
            matrix = [[row[j] for j in columns] for row in chosen]
            singular.append(determinant(ring, matrix))
    return singular, vertical
