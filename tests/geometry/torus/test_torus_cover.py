from __future__ import annotations

import random

import networkx as nx
import numpy as np
import pytest
from flint import fmpq
from surfaces import road_of

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import UnableError
from cuspaudit.geometry.torus.arcs import Arcs, arcs
from cuspaudit.geometry.torus.box_waves import BoxWaves
from cuspaudit.geometry.torus.boxes import Boxes
from cuspaudit.geometry.torus.components import torus_components
from cuspaudit.geometry.torus.cover import cover_count
from cuspaudit.geometry.torus.function import TorusFunction
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.library import open_robot
from cuspaudit.surface.graph_isotop import graph_isotop

RING = Ring([x for i in range(1, 4) for x in (f"c{i}", f"s{i}")])
CIRCLES = [(f"c{i}", f"s{i}") for i in range(1, 4)]
C1, S1, C2, S2, C3, S3 = RING.gens


def random_function(rng: random.Random, gens: tuple[Polynomial, ...]) -> Polynomial:
    """A trigonometric polynomial of degree 2 in each circle given."""
    result = RING.constant(0)
    for _ in range(2):
        term = RING.constant(1)
        for c, s in zip(gens[::2], gens[1::2], strict=True):
            for _ in range(2):
                term *= rng.randint(-5, 5) * c + rng.randint(-5, 5) * s
                term += rng.randint(-5, 5)
        result += term
    return result


@pytest.mark.parametrize("seed", range(12))
def test_on_two_circles_the_count_is_that_of_the_roadmap(seed: int) -> None:
    """Covers of a circle and an exact cell decomposition count the same."""
    rng = random.Random(seed)
    p, q, s = (random_function(rng, (C2, S2)) for _ in range(3))
    h = p * C1 + q * S1 + 2 * s
    ring = Ring(RING.variables[:4])
    h = ring.from_other(h, RING)
    equations = tuple(ring.gen(c) ** 2 + ring.gen(s) ** 2 - 1 for c, s in CIRCLES[:2])
    road = road_of(PolynomialSystem(ring, equations), h)
    expected = graph_isotop(road, h, []).number_of_aspects
    assert arcs(ring, CIRCLES[:2], h, 20).number_of_components == expected


@pytest.mark.parametrize("seed", range(4))
def test_on_three_circles_the_count_is_that_of_a_flood_fill(seed: int) -> None:
    """Covers of T^2 against components of a fine grid on T^3."""
    rng = random.Random(seed)
    p, q = (random_function(rng, (C2, S2, C3, S3)) for _ in range(2))
    h = p * C1 + q * S1 + 2 * random_function(rng, (C3, S3, C2, S2))
    found = arcs(RING, CIRCLES, h, 20)
    numeric = TorusFunction.from_polynomial(RING, CIRCLES, h)
    assert found.number_of_components == flood_fill(numeric)


def flood_fill(h: TorusFunction, size: int = 44) -> int:
    """The components of cells of one sign on a grid, tiny ones left out."""
    angles = np.linspace(-np.pi, np.pi, size, endpoint=False)
    positive = h(np.stack(np.meshgrid(*[angles] * 3, indexing="ij"), -1)) > 0
    index = np.arange(size**3).reshape(positive.shape)
    graph: nx.Graph[int] = nx.Graph()
    graph.add_nodes_from(index.ravel().tolist())
    for axis in range(3):
        same = positive == np.roll(positive, -1, axis)
        other = np.roll(index, -1, axis)
        graph.add_edges_from(
            zip(index[same].tolist(), other[same].tolist(), strict=True)
        )
    return sum(len(part) > 8 for part in nx.connected_components(graph))


def test_a_level_cuts_the_maxima_apart() -> None:
    """The sets {2 + cos y > level}: the whole circle, one arc, nothing."""
    for level, count in ((fmpq(1, 2), 1), (fmpq(2), 1), (fmpq(7, 2), 0)):
        assert count_above((2 + C2) * C1, level) == count
    two = 2 + C2**2 * 2
    assert [count_above(two * C1, fmpq(k)) for k in (1, 3, 5)] == [1, 2, 0]


def count_above(h: Polynomial, level: fmpq) -> int:
    """The components of {h > level} for h = P c1 on two circles."""
    [p] = RING.coefficients(h, ("c1", "s1")).values()
    base = CIRCLES[1:2]
    parts = [p, RING.constant(0), RING.constant(-level)]
    functions = [TorusFunction.from_polynomial(RING, base, part) for part in parts]
    return cover_count(BoxWaves(functions), 20).components


def test_components_that_touch_are_not_counted() -> None:
    """Two arcs that meet in a point end in an error, not in a number."""
    with pytest.raises(UnableError, match="not settled"):
        arcs(RING, CIRCLES[:2], C1 * fmpq(1, 2) + C2**2 - fmpq(1, 2), 10)


def test_no_time_is_no_number() -> None:
    """A timeout ends in the named error."""
    h = C1 * C2 + S1 * (C3 + S2) + S3 * fmpq(1, 2)
    with pytest.raises(UnableError, match="cover_count: not settled in 0 s"):
        arcs(RING, CIRCLES, h, 0)


@pytest.mark.parametrize("depth", [5, 6])
def test_what_a_box_claims_holds_at_sampled_points(depth: int) -> None:
    """Inside: f > 0; outside: f < 0; and no sampled f rises to a maximum within."""
    rng = random.Random(7)
    p, q, s = (random_function(rng, (C2, S2, C3, S3)) for _ in range(3))
    parts = [TorusFunction.from_polynomial(RING, CIRCLES[1:], x) for x in (p, q, s)]
    corner = np.random.default_rng(0).integers(0, 1 << depth, (300, 2))
    boxes = Boxes.at(BoxWaves(parts), depth, corner)
    edge = 2 * np.pi / (1 << depth)
    grid = np.stack(np.meshgrid(*[np.linspace(0, 1, 9)] * 2, indexing="ij"), -1)
    points = edge * (corner[:, None, None] + grid)
    f = np.hypot(parts[0](points), parts[1](points)) + parts[2](points)
    inside, outside, rising = boxes.inside(), boxes.outside(), boxes.no_maximum()
    assert (f[inside] > 0).all()
    assert (f[outside] < 0).all()
    assert inside.any()
    assert outside.any()
    assert not rising.all()
    interior = f[:, 1:-1, 1:-1].max((1, 2))
    peaks = (interior > f.max((1, 2)) - 1e-12) & (interior > 0)
    assert not (peaks & rising).any()
    assert (~peaks & rising & ~outside).any()


def test_values_and_derivatives_at_dyadic_angles() -> None:
    """The table of waves gives the values of the functions within its slack."""
    rng = random.Random(3)
    parts = [
        TorusFunction.from_polynomial(
            RING, CIRCLES, random_function(rng, (C1, S1, C2, S2)) + S3 * C3
        )
        for _ in range(3)
    ]
    waves = BoxWaves(parts)
    angles = np.random.default_rng(1).integers(0, 64, (20, 3))
    value, slope = waves.first(angles, 6)
    second, points = waves.second(angles, 6), angles * 2 * np.pi / 64
    for i, part in enumerate(parts):
        assert np.abs(value[:, i] - part(points)).max() < waves.slack[i]
        assert np.abs(slope[:, i] - part.gradient(points)).max() < waves.slack[i]
        assert np.abs(second[:, i] - part.hessian(points)).max() < waves.slack[i]
        step = np.abs(part.hessian(points + 0.01) - part.hessian(points))
        assert (step <= 0.01 * waves.twist[i].sum(2)).all()
    assert waves.slack.max() < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("name", ["hyperplane-6r", "raghavan-roth"])
def test_the_aspects_of_general_arms_are_counted_by_covers(name: str) -> None:
    """No two axes parallel: two aspects, told apart by the sign of det J."""
    model = exact_model(open_robot(name).chain)
    pairs = [(f"c{k}", f"s{k}") for k in range(2, 6)]
    found = torus_components(model.ring, pairs, jacobian_determinant(model), 300)
    assert found.number_of_components == 2
    assert isinstance(found.parts[0], Arcs)
    assert found.grounds == (
        "a cover of the torus by boxes, in doubles with bounded rounding",
    )


@pytest.mark.slow
@pytest.mark.parametrize(("share", "count"), [("0.5", 4), ("0.01", 1)])
def test_covers_prove_between_which_levels_the_maxima_of_a_crx_merge(
    share: str, count: int
) -> None:
    """Four maxima of det J > 0 join in pairs at 0.0588 and all at 0.0188 of 0.4184."""
    model = exact_model(open_robot("fanuc-crx-10ia-l").chain)
    parts = model.ring.coefficients(jacobian_determinant(model), ("c2", "s2"))
    numerator, _, decimals = share.partition(".")
    level = fmpq(int(numerator + decimals), 10 ** len(decimals)) * fmpq(4184, 10**4)
    base = [(f"c{k}", f"s{k}") for k in range(3, 6)]
    ring = model.ring
    functions = [
        TorusFunction.from_polynomial(ring, base, part)
        for part in (parts[1, 0], parts[0, 1], ring.constant(-level))
    ]
    assert cover_count(BoxWaves(functions), 600).components == count
