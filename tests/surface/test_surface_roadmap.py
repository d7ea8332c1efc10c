from __future__ import annotations

import pytest
from flint import arb, fmpq
from surfaces import (
    arm_map,
    cylinder,
    delta_of,
    flood_fill,
    plane,
    road_of,
    torus,
)

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import UnableError
from cuspaudit.surface.graph_isotop import graph_isotop


# the determinant of the ISSAC arm in half-angle tangents of theta2 and theta3
def issac_factor(
    c2: Polynomial, s2: Polynomial, c3: Polynomial, s3: Polynomial
) -> Polynomial:
    """c2 (c3 - 2 s3) - s3."""
    return c2 * (c3 - 2 * s3) - s3


def components(variety: PolynomialSystem, delta: Polynomial) -> int:
    """The number of components of {delta != 0}."""
    return graph_isotop(road_of(variety, delta), delta, []).number_of_aspects


def on_torus(build: object) -> tuple[PolynomialSystem, Polynomial]:
    """The torus and a function on it."""
    variety, mapping = torus(lambda *v: (build(*v),))
    return variety, mapping.components[0]


GENERIC = {
    "ISSAC": lambda c2, s2, c3, s3: issac_factor(c2, s2, c3, s3) * (3 * c3 + 4),
    "bands": lambda c2, s2, c3, s3: 3 * c3 + s3 + c2 * fmpq(1, 2),
    "spots": lambda c2, s2, c3, s3: c2 * c3 + s2 * s3 * fmpq(1, 3) + fmpq(1, 5),
    "one spot": lambda c2, s2, c3, s3: c2 * fmpq(7, 10) + c3 - fmpq(6, 5),
    "positive": lambda c2, s2, c3, s3: c2 * c3 + 2,
    "high": lambda c2, s2, c3, s3: (
        c2 * (c3**3 - 2 * s3) + s2 * c3 * s3 - s3 + fmpq(1, 9)
    ),
    "higher": lambda c2, s2, c3, s3: (
        c2 * (c3**2 * s3 - fmpq(1, 4))
        + s2 * (c3 * s3 + fmpq(1, 3))
        - s3 * c3 * fmpq(1, 2)
    ),
}


@pytest.mark.parametrize("name", GENERIC)
def test_components_are_those_of_a_flood_fill(name: str) -> None:
    """On generic functions the exact count is that of a fine grid."""
    variety, delta = on_torus(GENERIC[name])
    assert components(variety, delta) == flood_fill(variety, delta)


@pytest.mark.parametrize(
    "table",
    [
        ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
        ((1, 3, 4), (0, 3, 0), (-90, 90, 0)),
        ((1, ".7", ".7"), (0, ".3", ".9"), (-90, 90, 0)),
        ((1, 2, 1), (0, 1, 0), (-30, 90, 0)),
        ((1, "1.3", ".9"), (0, ".4", "-.7"), (70, 110, 0)),
        ((1, "3/2", 1), (0, 1, "1/2"), (45, -45, 0)),
    ],
)
def test_aspects_of_arms_are_those_of_a_flood_fill(
    table: tuple[tuple[int, ...], ...],
) -> None:
    """The aspects of generic arms, counted exactly and by a fine grid."""
    pair = arm_map(*table)
    delta = delta_of(pair)
    assert components(pair[0], delta) == flood_fill(pair[0], delta)


def test_the_regression_of_an_affine_chart() -> None:
    """D(t2, t3) of the ISSAC arm: 3 components in the half-angle plane, 2 on the torus.

    A well-known library counts 5 for {D > 0} [dependencies.md, A.4]: in the plane it
    is {D > 0} that has 3.
    """
    variety, delta = on_torus(issac_factor)
    road = road_of(variety, delta)
    graph = graph_isotop(road, delta, [])
    assert graph.number_of_aspects == 2
    flat, mapping = plane(
        lambda t2, t3: (t2**2 * t3**2 + 2 * t2**2 * t3 - t2**2 - t3**2 - 6 * t3 + 1,)
    )
    with pytest.raises(UnableError, match="affine in neither"):
        components(flat, mapping.components[0])
    # cut the torus at t2 = infinity and at t3 = infinity, where the plane ends
    cut = _positive_components_of_the_plane(mapping.components[0])
    assert cut == 3


def _positive_components_of_the_plane(D: Polynomial) -> int:
    """Components of {D > 0} in the half-angle plane, by a grid in the angles."""
    import numpy as np

    t = np.tan(np.linspace(-np.pi / 2, np.pi / 2, 1202)[1:-1] + 1e-7)
    x, y = np.meshgrid(t, t, indexing="ij")
    value = sum(int(c) * x ** int(i) * y ** int(j) for (i, j), c in D.to_dict().items())
    todo = set(map(tuple, np.argwhere(value > 0)))
    count = 0
    while todo:
        count += 1
        stack = [todo.pop()]
        while stack:
            i, j = stack.pop()
            for step in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                if step in todo:
                    todo.remove(step)
                    stack.append(step)
    return count


def test_a_crossing_of_two_curves_lets_nothing_pass() -> None:
    """(s2)(s3) on the torus: four squares that touch at corners are four components."""
    variety, delta = on_torus(lambda c2, s2, c3, s3: s2 * s3)
    assert components(variety, delta) == 4


def test_a_crossing_on_a_tilted_curve() -> None:
    """(c2 - c3) is 0 on two crossing diagonals: two components on the torus."""
    variety, delta = on_torus(lambda c2, s2, c3, s3: c2 - c3)
    assert components(variety, delta) == 2


def test_a_crossing_opened_by_a_hair_passes() -> None:
    """Add 1e-12 and the pieces of one sign join through the two crossings."""
    hair = fmpq(1, 10**12)
    variety, plus = on_torus(lambda c2, s2, c3, s3: c2 * c3 + hair)
    _, minus = on_torus(lambda c2, s2, c3, s3: c2 * c3 - hair)
    _, plain = on_torus(lambda c2, s2, c3, s3: c2 * c3)
    assert components(variety, plain) == 4
    assert components(variety, plus) == 1 + 2
    assert components(variety, minus) == 1 + 2


def test_tangency_without_crossing() -> None:
    """1 + c2 >= 0: its zero curve separates nothing but itself."""
    variety, delta = on_torus(lambda c2, s2, c3, s3: 1 + c2)
    assert components(variety, delta) == 1
    variety, delta = on_torus(lambda c2, s2, c3, s3: (1 + c2) * s3)
    assert components(variety, delta) == 2


def test_a_touching_sign_is_cut_and_the_other_passes() -> None:
    """Over c3 = 1 the function c2 + 2 - c3 keeps one sign but for a point."""
    variety, delta = on_torus(lambda c2, s2, c3, s3: c2 + 2 - c3)
    assert components(variety, delta) == flood_fill(variety, delta) == 1
    variety, delta = on_torus(lambda c2, s2, c3, s3: c2 + c3)
    assert components(variety, delta) == 2


def test_the_point_without_chart_is_no_wall() -> None:
    """Turning the base circle by any rational angle changes no count."""
    for cosine, sine in ((1, 0), (-1, 0), (0, 1), (fmpq(3, 5), fmpq(4, 5))):

        def turned(
            c2: Polynomial, s2: Polynomial, c3: Polynomial, s3: Polynomial
        ) -> Polynomial:
            c, s = cosine * c3 - sine * s3, sine * c3 + cosine * s3  # noqa: B023
            return issac_factor(c2, s2, c, s) * (3 * c + 4)

        assert components(*on_torus(turned)) == 2
        variety, delta = on_torus(
            lambda c2, s2, c3, s3: c2 * (cosine * c3 - sine * s3) + s2 * 0  # noqa: B023
        )
        assert components(variety, delta) == 4


def test_lines() -> None:
    """On the plane and on a cylinder: half planes, quadrants, strips."""
    flat, mapping = plane(
        lambda x, y: (x, x * y, x * (y**2 - 1), x * y - 1, y**2 + x * 0)
    )
    counts = [components(flat, delta) for delta in mapping.components]
    assert counts == [2, 4, 6, 3, 2]
    round_, mapping = cylinder(lambda c, s, q: (q, c, q * c, q * s - 1, 2 + c))
    counts = [components(round_, delta) for delta in mapping.components]
    assert counts == [2, 2, 4, 3, 1]


def test_strips_and_walls() -> None:
    """Signs in strips, what passes, where a point lies."""
    flat, mapping = plane(lambda x, y: (x * y * (y - 2),))
    road = road_of(flat, mapping.components[0])
    assert not road.is_closed
    assert road.passing == (0, 0)
    assert [strip.signs for strip in road.strips] == [(1, -1)] * 3
    assert sorted(map(float, road.walls.values())) == [0.0, 2.0]
    assert [road.strip_of(arb(x), 64) for x in (-1, 1, 3)] == [0, 1, 2]
    assert road.strip_of(arb(0), 64) is None


def test_what_is_affine_in_neither_factor_is_outside() -> None:
    """The complex square has Delta = 4 (x^2 + y^2)."""
    flat, mapping = plane(lambda x, y: (x**2 + y**2,))
    with pytest.raises(UnableError, match="neither"):
        road_of(flat, mapping.components[0])
