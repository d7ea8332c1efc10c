from __future__ import annotations

import pytest
from flint import arb, fmpq
from hypothesis import given
from hypothesis import strategies as st
from surfaces import cylinder, plane, torus

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import UnableError
from cuspaudit.surface.surface import ROTATIONS, Factor, Surface, product_factors

charts = st.fractions(-4, 4, max_denominator=9).map(
    lambda t: fmpq(t.numerator, t.denominator)
)


def surface_of(pair: tuple[PolynomialSystem, object]) -> Surface:
    """The surface of a variety."""
    return Surface(pair[0].ring, *product_factors(pair[0]))


def nothing(*gens: Polynomial) -> tuple[Polynomial, ...]:
    """Some map."""
    return gens[:2]


@given(charts, st.sampled_from(ROTATIONS))
def test_a_chart_stays_on_the_circle(t: fmpq, rotation: tuple[fmpq, fmpq]) -> None:
    """The chart of a circle has c^2 + s^2 = 1, and coordinate 0 is the rotation."""
    factor = Factor("circle", ("c", "s"), rotation)
    at = factor.coordinates(arb(t))
    assert (at["c"] * at["c"] + at["s"] * at["s"] - 1).contains(0)
    start = factor.coordinates(arb(0))
    assert start["c"].contains(rotation[0])
    assert start["s"].contains(rotation[1])


@given(charts, charts, st.sampled_from(ROTATIONS))
def test_a_charted_function_is_the_function(
    y: fmpq, x: fmpq, rotation: tuple[fmpq, fmpq]
) -> None:
    """Numerator over denominator at (y, x) is the function at the point there."""
    for pair in (torus(nothing), cylinder(nothing), plane(nothing)):
        surface = surface_of(pair)
        fiber = Factor(surface.fiber.kind, surface.fiber.names, rotation)
        surface = Surface(surface.ring, fiber, surface.base)
        ring, gens = surface.ring, surface.ring.gens
        function = gens[0] ** 2 * gens[-1] - 3 * gens[1] + 2 + gens[0] * gens[-1] ** 2
        above, below = surface.chart(function)
        chart = {"y": arb(y), "x": arb(x)}
        at = surface.coordinates(chart["y"], chart["x"])
        direct = ring.evaluate(function, at)
        denominator = surface.chart_ring.evaluate(below, chart)
        charted = surface.chart_ring.evaluate(above, chart) / denominator
        assert denominator > 0
        assert direct.overlaps(charted)
        assert (direct - charted).rad() < 1e-6


def test_reduction_keeps_the_function_and_its_affine_parts() -> None:
    """c^2 becomes 1 - s^2; an affine function is P c + Q s + S again."""
    surface = surface_of(torus(nothing))
    c2, s2, c3, s3 = surface.ring.gens
    assert surface.reduce(c2**2 + s2**2 + c3) == c3 + 1
    function = c2 * c3 - 2 * s2 * s3 + s3 + c2**2 * c3 + s2**2 * c3
    assert surface.affine_parts(function) == (c3, -2 * s3, s3 + c3)
    assert surface.affine_parts(c2**2 * c3) is None
    assert surface.affine_parts(c3) == (0, 0, c3)


def test_functions_on_the_base_share_a_positive_denominator() -> None:
    """Numerators over one common denominator."""
    surface = surface_of(torus(nothing))
    _, _, c3, s3 = surface.ring.gens
    (first, second), below = surface.on_base([c3 * s3, c3 + 1])
    x = {"x": arb(fmpq(1, 3))}
    ring, at = surface.chart_ring, surface.base.coordinates(arb(fmpq(1, 3)))
    assert (ring.evaluate(first, x) / ring.evaluate(below, x)).overlaps(
        at["c3"] * at["s3"]
    )
    assert (ring.evaluate(second, x) / ring.evaluate(below, x)).overlaps(at["c3"] + 1)


def test_factors_come_in_the_ring_s_order() -> None:
    """Circles and lines, in the order of their first variable."""
    ring = Ring(["q", "c", "s"])
    _, c, s = ring.gens
    first, second = product_factors(PolynomialSystem(ring, (c**2 + s**2 - 1,)))
    assert (first.kind, first.names) == ("line", ("q",))
    assert (second.kind, second.names) == ("circle", ("c", "s"))


def test_other_varieties_are_outside() -> None:
    """An ellipse, a shared variable or a wrong dimension is UnableError."""
    ring = Ring(["x", "y", "z"])
    x, y, z = ring.gens
    with pytest.raises(UnableError, match="not a circle"):
        product_factors(PolynomialSystem(ring, (x**2 + 2 * y**2 - 1,)))
    with pytest.raises(UnableError, match="not a circle"):
        product_factors(PolynomialSystem(ring, (x**2 + y**2 + z**2 - 1,)))
    with pytest.raises(UnableError, match="not a circle"):
        pair = (x**2 + y**2 - 1, y**2 + z**2 - 1)
        product_factors(PolynomialSystem(ring, pair))
    with pytest.raises(UnableError, match="dimension 3"):
        product_factors(PolynomialSystem(ring))
