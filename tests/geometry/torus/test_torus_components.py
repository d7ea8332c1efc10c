from __future__ import annotations

import random

import numpy as np
import pytest
from flint import arb, fmpq
from short_tables import Number, arm
from surfaces import Array, road_of

from cuspaudit.algebra.numeric import NumericPolynomial
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.errors import DegenerateMapError, UnableError
from cuspaudit.geometry.torus.components import TorusComponents, torus_components
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.library import open_robot
from cuspaudit.surface.graph_isotop import graph_isotop

TWO = Ring(["c1", "s1", "c2", "s2"])
FOUR = Ring([x for i in range(1, 5) for x in (f"c{i}", f"s{i}")])


def circles(ring: Ring) -> list[tuple[str, str]]:
    """The circles of all variables in pairs."""
    return [(f"c{k}", f"s{k}") for k in range(1, len(ring.variables) // 2 + 1)]


def components(ring: Ring, function: Polynomial) -> TorusComponents:
    """The components of {function != 0} on the torus of all variables."""
    return torus_components(ring, circles(ring), function)


def of_arm(chain: Chain) -> TorusComponents:
    """The aspects of a six-joint arm."""
    model = exact_model(chain)
    pairs = [(f"c{k}", f"s{k}") for k in range(1, 7)]
    return torus_components(model.ring, pairs, jacobian_determinant(model))


def random_function(ring: Ring, pair: int, rng: random.Random) -> Polynomial:
    """A random trigonometric polynomial of degree 1 of one circle."""
    c, s = ring.gens[2 * pair : 2 * pair + 2]
    return rng.randint(-4, 4) * c + rng.randint(-4, 4) * s + rng.randint(-4, 4)


@pytest.mark.parametrize("seed", range(30))
def test_on_two_circles_the_count_is_that_of_the_roadmap(seed: int) -> None:
    """With h = G (P c + Q s) two independent exact routes count the same."""
    rng = random.Random(seed)
    c1, s1, *_ = TWO.gens
    g, p, q = (random_function(TWO, 1, rng) for _ in range(3))
    h = g**2 * g * (p * c1 + q * s1)
    if h == 0:
        h = c1
    names = circles(TWO)
    rings = tuple(TWO.gen(c) ** 2 + TWO.gen(s) ** 2 - 1 for c, s in names)
    road = road_of(PolynomialSystem(TWO, rings), h)
    expected = graph_isotop(road, h, []).number_of_aspects
    assert components(TWO, h).number_of_components == expected


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("ur5", 8),
        ("fanuc-crx-10ia-l", 2),
        ("kinova-jaco-gen2", 2),
        ("ufactory-xarm6", 2),
        ("abb-gofa-5", 2),
        ("puma-560", 8),
    ],
)
def test_the_aspects_of_published_arms(name: str, count: int) -> None:
    """UR5 has 8 aspects, a CRX or a JACO 2."""
    assert of_arm(open_robot(name).chain).number_of_components == count


UR = [
    ("-0.425", "-0.39225", "0.09465", 8),
    ("-0.425", "-0.39225", 0, 8),
    (1, 1, "0.2", 8),
    (1, 1, 0, 8),
    (1, -1, 0, 8),
    (1, 2, "0.5", 8),
    (1, "0.5", 3, 8),
]


@pytest.mark.parametrize(("a2", "a3", "d5", "count"), UR)
def test_the_ur_family_has_eight_aspects_on_the_torus(
    a2: Number, a3: Number, d5: Number, count: int
) -> None:
    """Eight, also where axes 4, 5, 6 meet and where the two links are equal."""
    table = ((0, a2, a3, 0, 0, 0), ("0.1", 0, 0, "0.1", d5, "0.1"))
    chain = arm(*table, (90, 0, 0, 90, -90, 0))
    assert of_arm(chain).number_of_components == count
    aspects = answer(exact_model(chain)).aspects
    assert aspects is not None
    assert (aspects.count, aspects.proved) == (count, True)


@pytest.mark.parametrize("seed", range(2))
def test_labels_are_constant_along_paths_and_as_many_as_counted(seed: int) -> None:
    """A walk that never meets h = 0 keeps its label; every label occurs."""
    rng = random.Random(seed)
    c1, s1, c2, s2, c3, s3, *_ = FOUR.gens
    p = c2 * c3 + s3 * fmpq(rng.randint(1, 9), 7) - fmpq(1, 4)
    q = s2 * s3 + c3 * fmpq(rng.randint(1, 9), 5)
    h = (p * c1 + q * s1) * (s2 if seed % 2 else 1 + c2) * (3 * FOUR.gens[6] + seed)
    found = components(FOUR, h)
    labels = set()
    generator = np.random.default_rng(seed)
    value = NumericPolynomial(FOUR, found.function)
    bound = float(np.abs(value.coefficients).sum())
    for _ in range(60):
        at = generator.uniform(-np.pi, np.pi, 4)
        label = label_at(found, at)
        for _ in range(30):
            step = at + generator.normal(size=4) * 0.05
            way = np.linspace(at, step, 60)
            low = float(np.abs(value(points(way))).min())
            # 8 bounds every degree, so no sign changes between two way points
            if low > 8 * bound * float(np.abs(step - at).sum()) / 60:
                assert label_at(found, step) == label
                at = step
        labels.add(label)
    assert len(labels) == found.number_of_components


def points(angles: Array) -> Array:
    """(m, 4) angles as (m, 8) cosines and sines."""
    return np.stack([np.cos(angles), np.sin(angles)], axis=2).reshape(len(angles), -1)


def label_at(found: TorusComponents, at: Array) -> tuple[int, ...] | None:
    """The label of a point given by its angles."""
    values = points(at[None, :])[0]
    balls = [arb(float(x)) for x in values]
    return found.component(dict(zip(FOUR.variables, balls, strict=True)))


def test_a_zero_of_codimension_two_does_not_count() -> None:
    """P = Q = 0 in isolated points leaves two components; on a curve it may not."""
    c1, s1, c2, s2, c3, s3, *_ = FOUR.gens
    assert components(FOUR, c1 * s2 + s1 * s3).number_of_components == 2
    assert components(FOUR, c1 * s2 + s1 * s2 * c3).number_of_components == 4
    assert components(FOUR, c1 * (1 + c2) + s1 * s2).number_of_components == 2
    touching = c1 * (1 + c2) * (1 + c3) + s1 * s2 * s3
    assert components(FOUR, touching).number_of_components == 2


def test_what_the_theorem_does_not_cover_is_refused() -> None:
    """A constant beside the linear part, however small, or a wall in two circles."""
    c1, s1, c2, s2, c3, s3, *_ = FOUR.gens
    with pytest.raises(UnableError, match="linear along no circle"):
        components(FOUR, (c2 + 2) * c1 + (s3 + c3**2) * s1 + fmpq(1, 10**12))
    wall = c2 * c3 + fmpq(1, 3) * s2 * s3 + fmpq(1, 5)
    with pytest.raises(UnableError, match="several circles"):
        components(FOUR, wall * (c1 * c2 + s1 * (c3 + 3)))
    with pytest.raises(DegenerateMapError):
        components(FOUR, c1 * 0)


def test_factors_of_separate_circles_multiply() -> None:
    """Cos(theta1 - theta3) cos(theta2): two regions of each; a helix of zeros: two."""
    c1, s1, c2, s2, c3, s3, *_ = FOUR.gens
    assert components(FOUR, (c1 * c3 + s1 * s3) * c2).number_of_components == 4
    helix = (c1 * c2 + s1 * s2) * (c3 + 2) + (c1 * s2 - s1 * c2) * s3
    assert components(FOUR, helix).number_of_components == 2


def test_a_point_on_the_zero_set_has_no_label() -> None:
    """A ball that meets h = 0 is in no component."""
    c1, s1, c2, _, *_ = FOUR.gens
    found = components(FOUR, c1 * (c2 + 2) + s1 * c2)
    at = dict.fromkeys(FOUR.variables, arb(0)) | {"s1": arb(0, 1e-9), "c2": arb(1)}
    assert found.component(at) is None
    assert found.connected(at, at) is None
