from __future__ import annotations

import random
from functools import cache
from itertools import pairwise

import networkx as nx
import numpy as np
import pytest
from flint import arb, fmpq
from numpy.typing import NDArray

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.geometry.torus.components import TorusComponents, torus_components
from cuspaudit.geometry.torus.critical import ascents, critical_points
from cuspaudit.geometry.torus.function import TorusFunction
from cuspaudit.geometry.torus.routing import TorusRouting, torus_routing
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.library import open_robot

Array = NDArray[np.float64]
RING = Ring(["c1", "s1", "c2", "s2"])
CIRCLES = [("c1", "s1"), ("c2", "s2")]
C1, S1, C2, S2 = RING.gens
JOINTS = [(f"c{k}", f"s{k}") for k in range(2, 6)]


def function(polynomial: Polynomial) -> TorusFunction:
    """A function on two circles."""
    return TorusFunction.from_polynomial(RING, CIRCLES, polynomial)


@cache
def of_arm(name: str) -> tuple[TorusComponents, TorusRouting]:
    """The two routes for the determinant of a six-joint arm."""
    model = exact_model(open_robot(name).chain)
    determinant = jacobian_determinant(model)
    exact = torus_components(model.ring, JOINTS, determinant)
    h = TorusFunction.from_polynomial(model.ring, JOINTS, determinant)
    return exact, torus_routing(h, 0, exact.number_of_components)


def test_a_sum_of_cosines_has_a_critical_point_of_every_index() -> None:
    """Of cos x + 2 cos y + 4: one maximum, two saddles of |h|, one minimum."""
    h = function(C1 + 2 * C2 + 4)
    starts = np.random.default_rng(0).uniform(-3, 3, (60, 2))
    found = critical_points(h, starts)
    assert np.allclose(sorted(h(found)), [1, 3, 5, 7])
    routing = torus_routing(h)
    assert (len(routing.maxima), len(routing.saddles), len(routing.others)) == (1, 2, 1)


def test_an_ascent_rises_and_passes_a_saddle_it_is_led_to() -> None:
    """On the axis of symmetry of a saddle the ascent leaves it for a maximum."""
    h = function(C1**2 - S2**2 / 2 + C2 / 4 + 3)
    [way] = ascents(h, np.array([[np.pi / 2, 3.0]]))
    values = h(way)
    assert (np.diff(values) > -1e-9).all()
    assert values[-1] == pytest.approx(3.75, abs=1e-6)


@pytest.mark.parametrize(
    ("name", "maxima", "saddles"),
    [("ur5", 8, 16), ("fanuc-crx-10ia-l", 8, 104), ("abb-gofa-5", 16, 56)],
)
def test_the_graph_of_an_arm_has_the_proved_number_of_components(
    name: str, maxima: int, saddles: int
) -> None:
    """Search and theorem agree; maxima and saddles are those of the prototype."""
    exact, routing = of_arm(name)
    assert routing.number_of_components == exact.number_of_components
    assert (len(routing.maxima), len(routing.saddles)) == (maxima, saddles)


@pytest.mark.parametrize("name", ["ur5", "fanuc-crx-10ia-l", "abb-gofa-5"])
def test_search_and_theorem_agree_on_which_points_are_connected(name: str) -> None:
    """Labels are equal exactly when the ascents end in one group of maxima."""
    exact, routing = of_arm(name)
    points = np.random.default_rng(5).uniform(-np.pi, np.pi, (80, 4))
    groups: dict[tuple[int, ...] | None, set[int]] = {}
    vertices = routing.vert(points)
    roots = {
        v: min(nx.node_connected_component(routing.graph, v)) for v in routing.graph
    }
    for point, vertex in zip(points, vertices, strict=True):
        values = {}
        for (c, s), angle in zip(JOINTS, point, strict=True):
            values |= {c: arb(angle).cos(), s: arb(angle).sin()}
        groups.setdefault(exact.component(values), set()).add(roots[vertex])
    assert len(groups) == exact.number_of_components
    assert all(len(group) == 1 for group in groups.values())


def test_the_maxima_of_a_crx_merge_at_a_clearance_of_0_059() -> None:
    """Pairs of maxima join at 0.0588 of the largest |det J|, all at 0.0188."""
    routing = of_arm("fanuc-crx-10ia-l")[1]
    levels = [merge.level / routing.largest for merge in routing.merges()]
    assert levels == pytest.approx([0.0588] * 4 + [0.0188] * 2, abs=1e-4)
    last = routing.merges()[-1]
    assert len(last.first | last.second) == 4
    assert len({np.sign(routing.function(routing.maxima[i])) for i in last.first}) == 1


@pytest.mark.parametrize("seed", range(4))
def test_the_widest_path_is_the_widest_on_a_fine_grid(seed: int) -> None:
    """On two circles its level is the bottleneck of a grid, up to the step."""
    rng = random.Random(seed)
    h = function(
        C1 * (C2 + fmpq(rng.randint(1, 9), 5))
        + S1 * (S2 * C2 + fmpq(rng.randint(1, 9), 9))
        + fmpq(rng.randint(-3, 3), 10)
    )
    routing = torus_routing(h, seed)
    grid, angles = sampled(h)
    points = np.random.default_rng(seed).integers(0, len(angles), (40, 2))
    compared = 0
    for p, q in zip(points[:20], points[20:], strict=True):
        first, second = angles[p], angles[q]
        if h(first) * h(second) <= 0 or (p == q).all():
            continue
        path, level = routing.widest_path(first, second), bottleneck(grid, p, q)
        if path is None:
            assert level < 0.03 * h.size
            continue
        assert abs(path.level - level) < 0.03 * h.size
        ends = np.abs(np.cos(path.points[[0, -1]]) - np.cos([first, second])).max()
        assert ends < 1e-9
        assert np.abs(np.diff(path.points, axis=0)).max() < 0.11
        assert (np.sign(h(path.points)) == np.sign(h(first))).all()
        compared += 1
    assert compared > 3


def sampled(h: TorusFunction) -> tuple[nx.Graph[tuple[int, ...]], Array]:
    """The maximum spanning tree of |h| on a grid, cut where h changes sign."""
    size = 48
    angles = np.linspace(-np.pi, np.pi, size, endpoint=False)
    value = h(np.stack(np.meshgrid(angles, angles, indexing="ij"), -1))
    grid: nx.Graph[tuple[int, ...]] = nx.grid_2d_graph(size, size, periodic=True)
    for a, b in list(grid.edges):
        both = value[a], value[b]
        if both[0] * both[1] > 0:
            grid.edges[a, b]["level"] = min(abs(x) for x in both)
        else:
            grid.remove_edge(a, b)
    return nx.maximum_spanning_tree(grid, weight="level"), angles


def bottleneck(tree: nx.Graph[tuple[int, ...]], p: Array, q: Array) -> float:
    """The lowest level on the way in the tree, 0 when there is none."""
    first, second = tuple(int(x) for x in p), tuple(int(x) for x in q)
    if not nx.has_path(tree, first, second):
        return 0.0
    way = nx.shortest_path(tree, first, second)
    return float(min(tree.edges[e]["level"] for e in pairwise(way)))


def test_points_of_opposite_signs_have_no_path() -> None:
    """No path is proposed through h = 0, and the seed decides the result alone."""
    h = function(C1 * (C2 + 2) + S1 * S2)
    routing, again = torus_routing(h, 3), torus_routing(h, 3)
    assert not routing.connected(np.array([0.0, 0.0]), np.array([np.pi, 0.0]))
    assert routing.path(np.array([0.0, 0.0]), np.array([np.pi, 0.0])) is None
    assert (routing.maxima == again.maxima).all()
    assert routing.grounds == ("a search in floating point",)
