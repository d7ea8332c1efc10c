"""Samples of {g = 0, h > 0}: every component known by hand or by topology is met."""

from __future__ import annotations

import random
from itertools import product

import networkx as nx
import pytest
from flint import fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import NotEquidimensionalError, NotRadicalError, UnableError
from cuspaudit.geometry.graph_isotop import graph_isotop
from cuspaudit.geometry.sample_points import (
    Sample,
    sample_points,
)

PLANE = Ring(["x", "y"])
X, Y = PLANE.gens
SPACE = Ring(["x", "y", "z"])
A, B, C = SPACE.gens
SPHERE = PolynomialSystem(SPACE, (A**2 + B**2 + C**2 - 1,))
TORUS = PolynomialSystem(SPACE, ((A**2 + B**2 + C**2 + 3) ** 2 - 16 * (A**2 + B**2),))

SLOW = [1, 2, *range(4, 30)]


def signs(
    sample: Sample, ring: Ring, functions: tuple[Polynomial, ...]
) -> set[tuple[int, ...]]:
    """The signs of some functions at the points of a sample."""
    return {tuple(p.sign(f, ring) for f in functions) for p in sample.points}


#: equations, conditions, functions whose signs number the components, those signs
KNOWN = {
    "plane": ((), (), (), {()}),
    "two quadrants": ((), (X * Y,), (X,), {(1,), (-1,)}),
    "inside a hyperbola": ((), (X * Y - 1,), (X,), {(1,), (-1,)}),
    "quadrant": ((), (X, Y), (X, Y), {(1, 1)}),
    "ring and disc": (
        (),
        ((X**2 + Y**2 - 1) * (X**2 + Y**2 - 4),),
        (X**2 + Y**2 - 2,),
        {(1,), (-1,)},
    ),
    "nothing": ((), (-1 - X**2,), (), set()),
    "no real curve": ((X**2 + Y**2 + 1,), (), (), set()),
    "hyperbola": ((X * Y - 1,), (), (X,), {(1,), (-1,)}),
    "parabola": ((Y - X**2,), (X**2 - 1,), (X,), {(1,), (-1,)}),
    "isolated point": ((Y**2 - X**2 * (X - 1),), (), (X,), {(0,), (1,)}),
    "isolated point only": ((Y**2 - X**2 * (X - 1),), (1 - X,), (X,), {(0,)}),
    "points": ((X**2 - 2, Y - X), (), (X,), {(1,), (-1,)}),
    "a point of them": ((X**2 - 2, Y - X), (X,), (X,), {(1,)}),
    "zero on a component": ((X * (Y - 1),), (X**2,), (X,), {(1,), (-1,)}),
}


@pytest.mark.parametrize("name", KNOWN)
@pytest.mark.parametrize("seed", [1, 7])
def test_components_known_by_hand(name: str, seed: int) -> None:
    """The components have different signs, and each sign occurs."""
    equations, conditions, functions, expected = KNOWN[name]
    variety = PolynomialSystem(PLANE, equations)
    sample = sample_points(variety, conditions, seed=seed)
    assert signs(sample, PLANE, functions) == expected


def test_every_octant_of_the_sphere() -> None:
    """{x y z != 0} cuts the sphere into eight; {x y z > 0} keeps four."""
    both = [sample_points(SPHERE, [s * A * B * C]) for s in (1, -1)]
    found = [signs(sample, SPACE, (A, B, C)) for sample in both]
    assert found[0] | found[1] == set(product((1, -1), repeat=3))
    assert not found[0] & found[1]


def test_a_surface_without_conditions() -> None:
    """The two sheets of a hyperboloid, and a torus."""
    sheets = PolynomialSystem(SPACE, (C**2 - A**2 - B**2 - 1,))
    assert signs(sample_points(sheets), SPACE, (C,)) == {(1,), (-1,)}
    assert sample_points(sheets, [1 - C**2]).points == ()
    assert sample_points(TORUS).points


def test_points_are_on_the_variety_with_the_conditions() -> None:
    """Each point of each sample satisfies all that was asked, exactly."""
    condition = A * B - C + fmpq(1, 3)
    sample = sample_points(SPHERE, [condition])
    (g,) = SPHERE.equations
    assert signs(sample, SPACE, (g, condition)) == {(0, 1)}


@pytest.mark.parametrize(
    "seed", [0, 3, *(pytest.param(s, marks=pytest.mark.slow) for s in SLOW)]
)
def test_random_curves_are_met_in_every_component(seed: int) -> None:
    """The topology of {g = 0, h > 0} has a query point in every component."""
    chance = random.Random(seed)
    monomials = [X**i * Y**j for i in range(4) for j in range(4 - i)]
    g, h = (
        PLANE.total(chance.randint(-3, 3) * m for m in monomials[:: 1 + k])
        for k in range(2)
    )
    curve = PolynomialSystem(PLANE, (g,))
    sample = sample_points(curve, [h])
    met = [
        (graph, graph.vert(points))
        for points in sample.parametrizations[1:]
        for graph in [graph_isotop(curve, [h], points)]
    ]
    for graph, vertices in met:
        for part in nx.connected_components(graph.graph):
            assert part & set(vertices)
    assert len(sample.points) >= met[0][0].number_of_components


def test_what_is_not_covered_is_refused() -> None:
    """Two planes meet in infinitely many singular points; a plane and a line mix."""
    with pytest.raises(UnableError):
        sample_points(PolynomialSystem(SPACE, (A * B,)))
    with pytest.raises(NotEquidimensionalError):
        sample_points(PolynomialSystem(SPACE, (A * B, A * C)))
    with pytest.raises((NotRadicalError, UnableError)):
        sample_points(PolynomialSystem(PLANE, (X**2,)))
