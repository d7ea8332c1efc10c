from __future__ import annotations

import pytest
from flint import arb, fmpq

from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import DegenerateMapError
from cuspaudit.geometry.heights.height import (
    critical_system,
    heights,
    is_visibly_bounded,
    plain_height,
)

RING = Ring(["x", "y", "z"])
x, y, z = RING.gens
SPHERE = PolynomialSystem(RING, (x**2 + y**2 + z**2 - 1,))


def test_bounded_varieties_are_seen_by_their_leading_forms() -> None:
    """Spheres, tori, ellipses; not cylinders, hyperbolas, the plane."""
    torus = (x**2 + y**2 + z**2 + 3) ** 2 - 16 * (x**2 + y**2)
    assert is_visibly_bounded(SPHERE)
    assert is_visibly_bounded(PolynomialSystem(RING, (torus,)))
    assert is_visibly_bounded(PolynomialSystem(RING, (3 - x**2 - 2 * y**2, z**4 - z)))
    linked = (x**2 + y**2 - 1, (z - 2 * x) ** 2 - y)
    assert is_visibly_bounded(PolynomialSystem(RING, linked))
    loose = (x**2 + y**2 - 1, x * z**2 + z - y)
    assert not is_visibly_bounded(PolynomialSystem(RING, loose))
    assert not is_visibly_bounded(PolynomialSystem(RING, (x**2 + y**2 - 1,)))
    assert not is_visibly_bounded(PolynomialSystem(RING, (x**2 - y**2 + z**2,)))
    assert not is_visibly_bounded(PolynomialSystem(RING, (x**2 * y**2 + z**4 - 1,)))
    assert not is_visibly_bounded(PolynomialSystem(RING))


def test_weights_where_the_variety_is_unbounded() -> None:
    """Then h^2 w tends to 0 at infinity: 2 k > 2 deg P; on the sphere first w = 1."""
    P = x**3 * y - z
    assert all(2 * G.decay > 2 * 4 for G in heights(PolynomialSystem(RING), [P], 1))
    both = list(heights(PolynomialSystem(RING), [P, x], 1))
    assert both[0].power == 1
    assert all(2 * G.decay > 8 for G in both)
    assert [G.decay for G in heights(SPHERE, [P], 1)][:2] == [0, 1]


def test_critical_points_on_the_sphere() -> None:
    """The function z has two on the sphere; log z^2 has no others where z != 0."""
    G = plain_height(RING, [z])
    found = solve_zero_dimensional(critical_system(SPHERE, 2, G), nonzero=z)
    assert found.degree == 2
    assert found.contains([0, 0, 1])
    assert found.contains([0, 0, -1])


def test_blocks_give_one_equation_a_circle() -> None:
    """On a torus: c dP/ds - s dP/dc for each circle, up to factors."""
    ring = Ring(["a", "b", "c", "d"])
    a, b, c, d = ring.gens
    torus = PolynomialSystem(ring, (a**2 + b**2 - 1, c**2 + d**2 - 1))
    system = critical_system(torus, 2, plain_height(ring, [a + 2 * c * b]))
    assert len(system.equations) == 4
    turns = (2 * b - 4 * a * c, 4 * b * d)
    for equation, turn in zip(system.equations[2:], turns, strict=True):
        assert equation in (turn, -turn)


def test_the_value_of_a_height() -> None:
    """G = log P^2 - k log W, and nothing where P may vanish."""
    G = next(heights(PolynomialSystem(RING), [x], 3))
    at = [arb(2), arb(0), arb(0)]
    value, W = G.value(at), G.weight(fmpq(2), fmpq(0), fmpq(0))
    assert value is not None
    assert abs(value - (arb(4).log() - G.decay * arb(W).log())) < 1e-12
    assert G.value([arb(0, 1), arb(0), arb(0)]) is None


def test_no_minors_no_height() -> None:
    """A map that is singular everywhere has no nonsingular points to connect."""
    with pytest.raises(DegenerateMapError):
        plain_height(RING, [])
