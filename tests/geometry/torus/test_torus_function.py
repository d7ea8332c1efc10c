from __future__ import annotations

import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cuspaudit.algebra.numeric import NumericPolynomial
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.geometry.torus.function import TorusFunction

NAMES = ["c1", "s1", "c2", "s2", "c3", "s3"]
CIRCLES = [("c1", "s1"), ("c2", "s2"), ("c3", "s3")]


def random_polynomial(ring: Ring, seed: int) -> Polynomial:
    """A few random terms of degree up to 3 in each variable."""
    rng = random.Random(seed)
    terms = ring.constant(rng.randint(-3, 3))
    for _ in range(6):
        term = ring.constant(rng.randint(-5, 5))
        for x in rng.sample(list(ring.gens), 3):
            term *= x ** rng.randint(0, 3)
        terms += term * (ring.surd if ring.radicand and rng.random() < 0.5 else 1)
    return terms


@pytest.mark.parametrize("radicand", [None, 2])
@settings(max_examples=20)
@given(seed=st.integers(0, 10**6))
def test_waves_have_the_values_of_the_polynomial(
    radicand: int | None, seed: int
) -> None:
    """The sum of waves and the polynomial agree, over Q and over Q(sqrt 2)."""
    ring = Ring(NAMES, radicand)
    p = random_polynomial(ring, seed)
    h = TorusFunction.from_polynomial(ring, CIRCLES, p)
    angles = np.random.default_rng(seed).uniform(-4, 4, (7, 3))
    points = np.stack([np.cos(angles), np.sin(angles)], 2).reshape(7, 6)
    expected = NumericPolynomial(ring, p)(points)
    assert np.allclose(h(angles), expected, rtol=0, atol=1e-10)
    assert (np.abs(expected) <= h.size + 1e-9).all()


def test_derivatives_are_limits_of_differences() -> None:
    """Gradient and Hessian against central differences."""
    h = TorusFunction.from_polynomial(
        Ring(NAMES), CIRCLES, random_polynomial(Ring(NAMES), 3)
    )
    x, step = np.random.default_rng(0).uniform(-3, 3, (5, 3)), 1e-5
    for j, e in enumerate(np.eye(3) * step):
        slope = (h(x + e) - h(x - e)) / (2 * step)
        bend = (h.gradient(x + e) - h.gradient(x - e)) / (2 * step)
        assert np.allclose(h.gradient(x)[:, j], slope, atol=1e-5)
        assert np.allclose(h.hessian(x)[:, j], bend, atol=1e-5)


def test_a_constant_and_zero_are_functions() -> None:
    """No wave at all is the zero function."""
    ring = Ring(NAMES)
    for value in (0, 5):
        h = TorusFunction.from_polynomial(ring, CIRCLES, ring.constant(value))
        assert h(np.zeros((2, 3))).tolist() == [value, value]
