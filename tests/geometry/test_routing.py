from __future__ import annotations

import random
import sys
from itertools import pairwise

import networkx as nx
import numpy as np
import pytest
from flint import fmpq
from surfaces import Build, arm_map, plane, road_of, torus

from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.surface_decision import decide_surface
from cuspaudit.errors import NotOnVarietyError, UnableError
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.geometry.routing import Routing, morse_graph, routing
from cuspaudit.surface.graph_isotop import graph_isotop
from cuspaudit.surface.surface import Surface, product_factors

Pair = tuple[PolynomialSystem, PolynomialMap]

SPACE = Ring(["x", "y", "z"])
X, Y, Z = SPACE.gens
SPHERE = PolynomialSystem(SPACE, (X**2 + Y**2 + Z**2 - 1,))
TORUS = PolynomialSystem(SPACE, ((X**2 + Y**2 + Z**2 + 3) ** 2 - 16 * (X**2 + Y**2),))


def line(build: Build) -> Pair:
    """The map x -> build(x) on the line."""
    ring = Ring(["x"])
    return PolynomialSystem(ring), PolynomialMap(ring, build(*ring.gens))


def routed(pair: Pair, *queries: tuple[int, ...]) -> Routing:
    """The routing of a map."""
    return routing(*pair, crit(*pair), queries)


def circles(number: int) -> tuple[PolynomialSystem, list[Polynomial]]:
    """A torus of some dimension, with its cosines and sines."""
    ring = Ring([f"{x}{i}" for i in range(number) for x in "cs"])
    pairs = zip(ring.gens[::2], ring.gens[1::2], strict=True)
    equations = tuple(c * c + s * s - 1 for c, s in pairs)
    return PolynomialSystem(ring, equations), list(ring.gens)


MAPS: dict[str, tuple[Pair, int]] = {
    "identity": (plane(lambda x, y: (x, y)), 1),
    "cubic": (line(lambda x: (x**3 - 3 * x,)), 3),
    "fold": (plane(lambda x, y: (x**2, y)), 2),
    "Whitney cusp": (plane(lambda x, y: (x**3 + x * y, y)), 2),
    "complex square": (plane(lambda x, y: (x**2 - y**2, 2 * x * y)), 1),
    "not proper": (plane(lambda x, y: (x, x * y**2)), 4),
    "cross": (plane(lambda x, y: (x**3 / 3 - x * y**2, y)), 4),
    "sphere": ((SPHERE, PolynomialMap(SPACE, (X, Y))), 2),
    "torus from above": ((TORUS, PolynomialMap(SPACE, (X, Y))), 2),
    "torus from the side": ((TORUS, PolynomialMap(SPACE, (X, Z))), 4),
    "fold of space": (
        (PolynomialSystem(SPACE), PolynomialMap(SPACE, (X**2, Y, Z))),
        2,
    ),
}


@pytest.mark.parametrize("name", MAPS)
def test_components_known_by_hand(name: str) -> None:
    """The components of V - {Delta = 0}, bounded or not, of dimension 1 to 3."""
    pair, count = MAPS[name]
    found = routed(pair)
    assert found.number_of_components == count
    assert count <= len(found.maxima)
    assert found.grounds


def test_queries_of_the_whitney_cusp() -> None:
    """Delta = 3 x^2 + y: outside the parabola one region holds (1, 1) and (-1, 1)."""
    found = routed(MAPS["Whitney cusp"][0])
    assert found.connected((2, -1), (-2, -1))
    assert found.connected((fmpq(1, 100), 0), (fmpq(-1, 100), 0))
    assert not found.connected((0, -1), (2, -1))
    assert found.component((0, -1)) == found.component((0, -100))


def test_a_path_keeps_clear_of_the_critical_curve() -> None:
    """From (2, -1) to (-2, -1) round the parabola 3 x^2 + y = 0, without touching."""
    found = routed(MAPS["Whitney cusp"][0], (2, -1), (-2, -1))
    way = found.path((2, -1), (-2, -1))
    assert np.allclose(way[0], (2, -1))
    assert np.allclose(way[-1], (-2, -1))
    x, y = np.concatenate(
        [a + np.linspace(0, 1, 50)[:, None] * (b - a) for a, b in pairwise(way)]
    ).T
    assert (3 * x**2 + y).min() > 0


def test_the_boxes_of_a_path_are_linked_and_nonsingular() -> None:
    """Delta has no zero on any box, and each box meets the next."""
    variety, mapping = MAPS["Whitney cusp"][0]
    found = routed((variety, mapping))
    boxes = found.boxes((2, -1), (-2, -1))
    delta = found.landscape.height
    for box, following in pairwise(boxes):
        assert all(a.overlaps(b) for a, b in zip(box, following, strict=True))
    assert all(delta.value(box) is not None for box in boxes)
    assert boxes[0][0] > 1
    assert boxes[-1][0] < -1


def test_clearance_is_the_height_of_the_pass() -> None:
    """The widest way between two maxima goes over the highest saddle.

    For h = 3 x^2 + 2 y^2 + z^2 from (1, 0, 0) to (-1, 0, 0) that is (0, 1, 0), where
    h = 2; from a lower point it is as wide as the point is high.
    """
    found = morse_graph(SPHERE, 2, [3 * X**2 + 2 * Y**2 + Z**2])
    assert found.clearance((1, 0, 0), (-1, 0, 0)) == pytest.approx(2, rel=1e-5)
    low = (0, fmpq(3, 5), fmpq(4, 5))
    assert found.clearance(low, (-1, 0, 0)) == pytest.approx(1.36, rel=1e-5)
    weighted = routed(MAPS["fold"][0])
    with pytest.raises(UnableError, match="clearance"):
        weighted.clearance((1, 0), (2, 0))


def test_points_off_the_complement_are_refused() -> None:
    """A query must lie on V, exactly, and off {Delta = 0}."""
    found = routed(MAPS["sphere"][0])
    with pytest.raises(NotOnVarietyError, match="not on V"):
        found.component((0, 0, fmpq(999, 1000)))
    with pytest.raises(NotOnVarietyError, match="Delta = 0"):
        found.component((1, 0, 0))


def test_algebraic_points_are_queries_too() -> None:
    """The two points of the sphere over (1/2, 1/2), z = +-1/sqrt2: two components."""
    variety, mapping = MAPS["sphere"][0]
    half = fmpq(1, 2)
    system = PolynomialSystem(SPACE, (*variety.equations, X - half, Y - half))
    low, high = solve_zero_dimensional(system).real_points()
    found = routing(variety, mapping, crit(variety, mapping), [low, high])
    assert not found.connected(low, high)
    assert found.connected(high, (0, 0, high.sign(Z, SPACE)))


def test_out_of_time() -> None:
    """No time is no answer."""
    variety, mapping = MAPS["sphere"][0]
    with pytest.raises(UnableError, match="time"):
        routing(variety, mapping, crit(variety, mapping), timeout=0)


def test_the_two_hemispheres() -> None:
    """On the sphere seen from above, z tells the component."""
    found = routed(MAPS["sphere"][0])
    third = fmpq(1, 3)
    north = (2 * third, third, 2 * third)
    south = (2 * third, third, -2 * third)
    assert found.connected(north, (0, 0, 1))
    assert not found.connected(north, south)


def test_a_weight_is_found_where_all_points_are_critical() -> None:
    """On the identity of the torus Delta is constant along circles: w is needed."""
    variety, (c2, _, _, _) = circles(2)
    found = morse_graph(variety, 2, [c2])
    assert found.landscape.height.decay > 0
    assert found.number_of_components == 2


def test_several_minors() -> None:
    """The common zeros of x and y: a line in space, which separates nothing."""
    assert morse_graph(PolynomialSystem(SPACE), 3, [X, Y]).number_of_components == 1
    on_sphere = morse_graph(SPHERE, 2, [X * Z, Y * Z])
    assert on_sphere.number_of_components == 2


def test_one_equation_too_many() -> None:
    """The sphere by two equations, one of them redundant."""
    variety = PolynomialSystem(SPACE, (X * SPHERE.equations[0], *SPHERE.equations))
    found = morse_graph(variety, 2, [X - Y + Z * fmpq(1, 2)])
    assert found.number_of_components == 2


def test_a_field_with_a_square_root() -> None:
    """Over Q(sqrt2): the line x = sqrt2 y, and the strip |x| < sqrt2 of 2 - x^2."""
    pair = plane(lambda x, y: (x, y), radicand=2)
    ring = pair[0].ring
    x, y = ring.gens
    found = morse_graph(pair[0], 2, [x - ring.surd * y])
    assert found.number_of_components == 2
    assert not found.connected((3, 2), (1, 1))
    assert morse_graph(pair[0], 2, [x + ring.surd]).number_of_components == 2


def test_the_polynomial_another_library_miscounts() -> None:
    """{D > 0} has 3 components in the plane of the two half-angle tangents.

    [dependencies.md, A.4]: D is the ISSAC arm's determinant; a cell decomposition that
    lost the cells along a vertical asymptote counted 5.
    """
    pair = plane(lambda x, y: (x**2 * y**2 + 2 * x**2 * y - x**2 - y**2 - 6 * y + 1, x))
    D = pair[1].components[0]
    found = morse_graph(pair[0], 2, [D])
    tops = [top.sign for top in found.maxima]
    parts = list(nx.connected_components(found.graph))
    positive = [part for part in parts if tops[min(part)] > 0]
    assert len(positive) == 3
    assert found.connected((-1, -1), (0, -1))


@pytest.mark.parametrize("seed", [0, 1, 7, 8, 10, 12, 25])
def test_routing_agrees_with_the_roadmap_on_random_functions(seed: int) -> None:
    """Two routes to the components of {D != 0} on the torus, D affine in c2, s2."""
    variety, D = random_function(seed)
    expected = graph_isotop(road_of(variety, D), D, []).number_of_aspects
    assert morse_graph(variety, 2, [D]).number_of_components == expected


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 200))
def test_routing_agrees_with_the_roadmap_on_more(seed: int) -> None:
    """The same on a hundred more."""
    test_routing_agrees_with_the_roadmap_on_random_functions(seed)


def random_function(seed: int) -> tuple[PolynomialSystem, Polynomial]:
    """A function with small random coefficients, bilinear in the two circles."""
    chance = random.Random(seed)

    def build(*v: Polynomial) -> tuple[Polynomial, ...]:
        c2, s2, c3, s3 = v
        total = c2 * 0
        for a in (c2, s2, c3**0):
            for b in (c3**0, c3, s3):
                if chance.random() < 0.75:
                    total = total + a * b * chance.randint(-5, 5)
        return (total,)

    variety, mapping = torus(build)
    return variety, mapping.components[0]


@pytest.mark.parametrize(
    "table",
    [
        ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
        ((1, 3, 4), (0, 3, 0), (-90, 90, 0)),
    ],
)
def test_aspects_of_arms(table: tuple[tuple[int, ...], ...]) -> None:
    """Routing finds the aspects that the roadmap of the arm finds.

    The second arm has a corridor between two of its regions 1000 times narrower than
    the regions.
    """
    variety, mapping = arm_map(*table)
    surface = Surface(variety.ring, *product_factors(variety))
    minors = [surface.reduce(minor) for minor in crit(variety, mapping)]
    found = routing(variety, mapping, minors)
    assert found.number_of_components == decide_surface(variety, mapping).aspects


@pytest.mark.parametrize("dimension", [3, 4])
def test_tori_of_higher_dimension(dimension: int) -> None:
    """{c1 + ... + cd != 0} has two components, {c1 ... cd != 0} has 2^d."""
    variety, gens = circles(dimension)
    cosines = gens[::2]
    product = cosines[0]
    for c in cosines[1:]:
        product = product * c
    total = variety.ring.total(cosines)
    assert morse_graph(variety, dimension, [total]).number_of_components == 2
    assert (
        morse_graph(variety, dimension, [product]).number_of_components == 2**dimension
    )


def test_the_ball_in_space() -> None:
    """Inside and outside of the unit sphere in R^3."""
    found = morse_graph(PolynomialSystem(SPACE), 3, [X**2 + Y**2 + Z**2 - 1])
    assert found.number_of_components == 2
    assert not found.connected((0, 0, 0), (5, 0, 0))
    assert found.connected((-5, 0, 0), (5, 0, 0))


@pytest.mark.slow
def test_the_eight_aspects_of_the_ur5() -> None:
    """8 aspects on T^4, from 8 maxima and 16 saddles [Capco et al., ISSAC 2020].

    In theta2, theta3, theta2 + theta3 + theta4, theta5 its determinant is, up to a
    constant, s3 s5 (a2 c2 + a3 c23 + d5 sin(theta2 + theta3 + theta4)).
    """
    variety, (c2, s2, c3, s3, _, sp, _, s5) = circles(4)
    a2, a3, d5 = fmpq(425, 1000), fmpq(39225, 100000), fmpq(9465, 100000)
    E = a2 * c2 + a3 * (c2 * c3 - s2 * s3) + d5 * sp
    found = morse_graph(variety, 4, [s3 * s5 * E])
    assert found.number_of_components == 8
    assert (len(found.maxima), len(found.saddles)) == (8, 16)


@pytest.mark.slow
def test_functions_on_tori_without_a_symmetry() -> None:
    """On T^3 a generic function cuts two regions, on T^4 a product of two cuts four."""
    variety, (c0, s0, c1, s1, c2, s2) = circles(3)
    P = c0 + 2 * c1 * c2 + s0 * s1 * s2 + fmpq(1, 3)
    assert morse_graph(variety, 3, [P]).number_of_components == 2
    variety, (c0, _, c1, _, _, s2, _, s3) = circles(4)
    P = (c0 + 2 * c1) * (s2 + 2 * s3)
    assert morse_graph(variety, 4, [P]).number_of_components == 4


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100))
def test_aspects_of_random_arms(seed: int) -> None:
    """Routing and the roadmap of the arm, which share no step, on random arms."""
    chance = random.Random(seed)
    a = (1, *(decimal(chance.randint(1, 30)) for _ in range(2)))
    d = (0, *(decimal(chance.randint(-10, 10)) for _ in range(2)))
    alpha = (chance.choice([-90, 90, 60, -60]), chance.choice([90, -90]), 0)
    test_aspects_of_arms((a, d, alpha))


def decimal(tenths: int) -> str:
    """A number of tenths as a decimal."""
    return f"{tenths / 10}"


def test_a_height_whose_critical_points_are_not_listed_is_followed_by_another(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The next weight gives the components; without any, why is said."""
    module = sys.modules["cuspaudit.geometry.routing"]
    true, tried = module.critical_points, []

    def unable(landscape: ChartedHeight, *rest: float) -> object:
        tried.append(landscape.height.decay)
        if len(tried) == 1:
            raise UnableError("solve_zero_dimensional", "not listed")
        return true(landscape, *rest)

    monkeypatch.setattr(module, "critical_points", unable)
    assert morse_graph(SPHERE, 2, [X]).number_of_components == 2
    assert tried == [0, 1]
