"""Topology of curves: known by hand, by other projections, by another route."""

from __future__ import annotations

import random
from itertools import pairwise

import networkx as nx
import numpy as np
import pytest

from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import NotOnVarietyError, UnableError
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.graph_isotop import CurveGraph, graph_isotop
from cuspaudit.geometry.roadmap import roadmap

PLANE = Ring(["x", "y"])
X, Y = PLANE.gens
SPACE = Ring(["x", "y", "z"])
A, B, C = SPACE.gens


def plane(equation: Polynomial) -> PolynomialSystem:
    """A plane curve."""
    return PolynomialSystem(PLANE, (equation,))


def space(*equations: Polynomial) -> PolynomialSystem:
    """A curve in space."""
    return PolynomialSystem(SPACE, equations)


def two_circles(distance: int) -> PolynomialSystem:
    """The unit circle of z = 0 and the one round (distance, 0, 0) in y = 0."""
    flat, upright = A**2 + B**2 - 1, (A - distance) ** 2 + C**2 - 1
    return space(C * B, C * upright, flat * B, flat * upright)


#: system, components, Euler characteristic, ends, singular points, isolated points
KNOWN = {
    "circle": (plane(X**2 + Y**2 - 1), 1, 0, 0, 0, 0),
    "no real point": (plane(X**2 + Y**2 + 1), 0, 0, 0, 0, 0),
    "one real point": (plane(X**2 + Y**2), 1, 1, 0, 1, 1),
    "line": (plane(X - 2 * Y), 1, 1, 2, 0, 0),
    "hyperbola": (plane(X * Y - 1), 2, 2, 4, 0, 0),
    "lemniscate": (plane((X**2 + Y**2) ** 2 - X**2 + Y**2), 1, -1, 0, 1, 0),
    "nodal cubic": (plane(Y**2 - X**2 * (X + 1)), 1, 0, 2, 1, 0),
    "cusp": (plane(Y**2 - X**3), 1, 1, 2, 1, 0),
    "isolated point": (plane(Y**2 - X**2 * (X - 1)), 2, 2, 2, 1, 1),
    "lines": (plane((X - 1) * (X**2 + Y**2 - 1) * (Y - X**2)), 1, -2, 4, 4, 0),
    "four leaves": (plane((X**2 + Y**2) ** 3 - 4 * X**2 * Y**2), 1, -3, 0, 1, 0),
    "tacnode": (plane((Y - X**2) * (Y + X**2)), 1, 1, 4, 1, 0),
    "circles in circles": (
        plane((X**2 + Y**2 - 1) * (X**2 + Y**2 - 4)),
        *(2, 0, 0, 0, 0),
    ),
    "twisted cubic": (space(B - A**2, C - A**3), 1, 1, 2, 0, 0),
    "three quadrics": (space(B - A**2, C - A * B, A * C - B**2), 1, 1, 2, 0, 0),
    "Viviani": (space(A**2 + B**2 + C**2 - 4, (A - 1) ** 2 + B**2 - 1), 1, -1, 0, 1, 0),
    "one oval": (space(A**2 + B**2 + C**2 - 1, A * B - C), 1, 0, 0, 0, 0),
    "two ovals": (space(A**2 + B**2 - 1, B**2 + C**2 - 2), 2, 0, 0, 0, 0),
    "linked circles": (two_circles(1), 2, 0, 0, 0, 0),
    "three axes": (space(A * B, B * C, A * C), 1, 1, 6, 1, 0),
}


def facts(graph: CurveGraph) -> tuple[int, ...]:
    """Components, Euler characteristic, ends, singular and isolated points."""
    return (
        graph.number_of_components,
        graph.euler_characteristic,
        graph.ends,
        len(graph.of_kind("singular")),
        len(graph.isolated),
    )


@pytest.mark.parametrize("name", KNOWN)
def test_curves_known_by_hand(name: str) -> None:
    """Components, Euler characteristic, ends, singular and isolated points."""
    system, *expected = KNOWN[name]
    assert facts(graph_isotop(system)) == tuple(expected)


@pytest.mark.parametrize("name", ["nodal cubic", "isolated point"])
def test_the_topology_is_that_of_the_curve_not_of_the_forms(name: str) -> None:
    """Another seed and other linear coordinates change no count."""
    system, *expected = KNOWN[name]
    ring, chance = system.ring, random.Random(name)
    gens = ring.gens
    moved = [x + chance.randint(-2, 2) * gens[0] for x in gens[1:]]
    first = gens[0] + 2 * moved[0]
    images = [first, *moved]
    changed = tuple(f.compose(*images, ctx=ring.context) for f in system.equations)
    for seed, equations in ((2, system.equations), (3, changed)):
        graph = graph_isotop(PolynomialSystem(ring, equations), seed=seed)
        assert facts(graph) == tuple(expected)


@pytest.mark.slow
@pytest.mark.parametrize("name", KNOWN)
@pytest.mark.parametrize("seed", range(2, 12))
def test_ten_seeds_agree(name: str, seed: int) -> None:
    """Ten projections of every curve known by hand give the same topology."""
    system, *expected = KNOWN[name]
    assert facts(graph_isotop(system, seed=seed)) == tuple(expected)


def polygons(graph: CurveGraph) -> list[np.ndarray]:
    """The cycles of a graph of ovals, drawn with straight edges."""
    own = graph.graph
    return [
        np.array(
            [
                [float(x.mid()) for x in own.nodes[v]["point"]]
                for v, _ in nx.find_cycle(own.subgraph(part))
            ]
        )
        for part in nx.connected_components(own)
    ]


def linking_number(first: np.ndarray, second: np.ndarray) -> float:
    """Gauss's integral of two closed polygons: solid angles of pairs of edges."""
    total = 0.0
    for a, b in zip(first, np.roll(first, -1, axis=0), strict=True):
        for c, d in zip(second, np.roll(second, -1, axis=0), strict=True):
            sides = [c - a, d - a, d - b, c - b]
            normals = [np.cross(p, q) for p, q in pairwise([*sides, sides[0]])]
            normals = [n / np.linalg.norm(n) for n in normals]
            angles = [
                np.arcsin(np.clip(p @ q, -1, 1))
                for p, q in pairwise([*normals, normals[0]])
            ]
            total += sum(angles) * np.sign(np.cross(d - c, b - a) @ (c - a))
    return total / (4 * np.pi)


@pytest.mark.parametrize(("distance", "linked"), [(1, 1), (5, 0)])
def test_the_drawing_is_isotopic_to_the_curve(distance: int, linked: int) -> None:
    """Straight edges through the vertices keep the linking number of two circles."""
    graph = graph_isotop(two_circles(distance))
    number = linking_number(*polygons(graph))
    assert abs(number) == pytest.approx(linked, abs=1e-9)


def test_crossings_of_the_projection_are_no_points_of_both_branches() -> None:
    """The two ovals cross in the projection, and are not joined."""
    graph = graph_isotop(KNOWN["two ovals"][0])
    assert len(graph.of_kind("crossing")) == 4
    assert graph.number_of_components == 2


def test_conditions_cut_the_curve() -> None:
    """X > 0 leaves half a circle; x^2 > 0 two halves; y - 1 > 0 nothing."""
    circle = KNOWN["circle"][0]
    assert facts(graph_isotop(circle, [X])) == (1, 1, 2, 0, 0)
    assert facts(graph_isotop(circle, [X**2])) == (2, 2, 4, 0, 0)
    assert facts(graph_isotop(circle, [Y - 1])) == (0, 0, 0, 0, 0)
    assert facts(graph_isotop(circle, [X, Y])) == (1, 1, 2, 0, 0)


def test_a_condition_that_only_touches_zero_removes_one_point() -> None:
    """1 - x > 0 opens the circle at (1, 0); (2 x - y)^2 > 0 cuts it twice."""
    circle = KNOWN["circle"][0]
    assert facts(graph_isotop(circle, [1 - X])) == (1, 1, 2, 0, 0)
    assert facts(graph_isotop(circle, [(2 * X - Y) ** 2])) == (2, 2, 4, 0, 0)


def test_a_condition_that_is_zero_on_a_component_removes_it() -> None:
    """X > 0 on the union of the line x = 0 and the circle leaves half the circle."""
    both = plane(X * (X**2 + Y**2 - 1))
    assert facts(graph_isotop(both, [X])) == (1, 1, 2, 0, 0)
    assert facts(graph_isotop(both, [X * 0 + 1])) == (1, -1, 2, 2, 0)


def test_query_points_become_vertices() -> None:
    """The points of two circles with x = y: one on each half, by component."""
    rings = KNOWN["circles in circles"][0]
    points = solve_zero_dimensional(
        PolynomialSystem(PLANE, (*rings.equations, 3 * X - 4 * Y))
    )
    graph = graph_isotop(rings, points=points)
    found = graph.vert(points)
    parts = [nx.node_connected_component(graph.graph, v) for v in found]
    assert len(found) == 4
    assert [sum(v in part for v in found) for part in parts] == [2, 2, 2, 2]
    balls = [graph.graph.nodes[v]["point"] for v in found]
    assert all((3 * x - 4 * y).contains(0) for x, y in balls)
    assert len(graph_isotop(rings, [X], points).vert(points)) == 2


def test_query_points_on_crossings_are_told_apart() -> None:
    """A point of one of two ovals is a vertex of that oval, wherever it projects to."""
    ovals = KNOWN["two ovals"][0]
    upper = solve_zero_dimensional(PolynomialSystem(SPACE, (*ovals.equations, B)))
    graph = graph_isotop(ovals, points=upper)
    for vertex in graph.vert(upper):
        part = nx.node_connected_component(graph.graph, vertex)
        signs = {graph.graph.nodes[v]["point"][2] > 0 for v in part}
        assert len(signs) == 1


def test_a_point_off_the_curve_is_refused() -> None:
    """Query points must lie on the curve, and be asked for at the start."""
    circle = KNOWN["circle"][0]
    off = solve_zero_dimensional(PolynomialSystem(PLANE, (X, Y)))
    on = solve_zero_dimensional(PolynomialSystem(PLANE, (X, Y - 1)))
    with pytest.raises(NotOnVarietyError):
        graph_isotop(circle, points=off)
    with pytest.raises(NotOnVarietyError):
        graph_isotop(circle).vert(on)


@pytest.mark.parametrize(
    "system",
    [
        plane((X**2 + Y**2 - 1) ** 2),
        space(A**2 + B**2 + C**2 - 1),
        space(A * B, A * C, A * (A - 1)),
        PolynomialSystem(PLANE, (X, Y)),
    ],
    ids=["double", "surface", "surface and point", "point"],
)
def test_what_is_no_reduced_curve_is_refused(system: PolynomialSystem) -> None:
    """A double circle, surfaces and a point have no parametrization as curves."""
    with pytest.raises(UnableError):
        graph_isotop(system)


@pytest.mark.parametrize(
    "name",
    [
        "circle",
        pytest.param("two ovals", marks=pytest.mark.slow),
        pytest.param("one oval", marks=pytest.mark.slow),
    ],
)
def test_pieces_of_a_curve_agree_with_its_roadmap(name: str) -> None:
    """{Delta != 0} has as many components by the topology as by the sheets of R."""
    system = KNOWN[name][0]
    ring = system.ring
    function = ring.gens[0] * ring.gens[1] + 2 * ring.gens[0] - ring.gens[-1] ** 2
    delta = critical_minor(system, function)
    pieces = sum(
        graph_isotop(system, [sign * delta]).number_of_components for sign in (1, -1)
    )
    sheets = roadmap(system, PolynomialMap(ring, (function,)))
    assert sheets.number_of_components == pieces


def critical_minor(system: PolynomialSystem, function: Polynomial) -> Polynomial:
    """Delta, for a curve given by n - 1 equations."""
    (minor,) = crit(system, PolynomialMap(system.ring, (function,)))
    return minor


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(24))
def test_random_space_curves_do_not_depend_on_the_forms(seed: int) -> None:
    """Two projections of the intersection of two random surfaces, cut by h > 0."""
    chance = random.Random(seed)
    monomials = [SPACE.constant(1), A, B, C, A * B, A * C, B * C, A**2, B**2, C**2]
    first, second, h = (
        SPACE.total(chance.randint(-3, 3) * m for m in chance.sample(monomials, 5))
        for _ in range(3)
    )
    try:
        graphs = [graph_isotop(space(first, second), [h], seed=s) for s in (1, 2)]
    except UnableError:
        pytest.skip("no reduced curve")
    assert facts(graphs[0]) == facts(graphs[1])
