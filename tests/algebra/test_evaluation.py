from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from cuspaudit.algebra.evaluation import Differentiable, Evaluator, Jets
from cuspaudit.algebra.ring import Ring

RING = Ring(["x", "y"])
x, y = RING.gens
SOME = [x**3 * y - 2 * x * y + fmpq(1, 3), y**2, RING.constant(7), x * 0]

numbers = st.fractions(-3, 3, max_denominator=9)


@settings(max_examples=25, deadline=None)
@given(numbers, numbers)
def test_values_are_those_of_exact_substitution(a: Fraction, b: Fraction) -> None:
    """Balls hold the exact value, doubles are close to it."""
    at = [fmpq(v.numerator, v.denominator) for v in (a, b)]
    exact = [p(*at) for p in SOME]
    evaluator = Evaluator(RING, SOME)
    with ctx.workprec(200):
        balls = evaluator.balls([arb(v) for v in at])
        assert all(
            abs(ball - arb(e)) < 1e-50 for ball, e in zip(balls, exact, strict=True)
        )
    floats = evaluator.floats([float(v.p) / float(v.q) for v in at])
    assert floats == pytest.approx([float(e.p) / float(e.q) for e in exact])


def test_a_box_around_zero_has_finite_powers() -> None:
    """x^3 over [-1, 1] is enclosed, not nan."""
    (value,) = Evaluator(RING, [x**3]).balls([arb(0, 1), arb(0)])
    assert value.is_finite()
    assert value.contains(-1)
    assert value.contains(1)


def test_the_square_root_of_the_field() -> None:
    """Over Q(sqrt2) the generator is evaluated as the positive root."""
    ring = Ring(["x"], radicand=2)
    p = ring.surd * ring.gens[0] + ring.surd
    assert Evaluator(ring, [p]).floats([2.0]) == pytest.approx([3 * math.sqrt(2)])
    (ball,) = Evaluator(ring, [p]).balls([arb(2)])
    assert abs(ball - 3 * arb(2).sqrt()) < 1e-14


def test_derivatives_are_those_of_differences() -> None:
    """Jacobian and Hessian against central differences, in doubles and in balls."""
    at, step = np.array([0.7, -1.3]), 1e-5
    values, gradients, hessians = Jets(RING, SOME).floats(at)
    assert values == pytest.approx(Evaluator(RING, SOME).floats(at))
    for i, e in enumerate(np.eye(2)):
        ahead, back = (Jets(RING, SOME).floats(at + s * step * e) for s in (1, -1))
        assert (ahead[0] - back[0]) / (2 * step) == pytest.approx(
            gradients[:, i], abs=1e-8
        )
        assert (ahead[1] - back[1]) / (2 * step) == pytest.approx(
            hessians[:, :, i], abs=1e-8
        )
    box = [arb(float(v)) for v in at]
    enclosed = Jets(RING, SOME).balls(box)
    for table, rough in zip(enclosed, (values, gradients, hessians), strict=True):
        assert table.astype(float) == pytest.approx(rough)
    first = Differentiable(RING, SOME)
    assert first.floats(at)[1] == pytest.approx(gradients)
    assert np.array(first.jacobian(box)).astype(float) == pytest.approx(gradients)


@pytest.mark.parametrize("radicand", [None, 2])
def test_many_terms_have_the_same_values(radicand: int | None) -> None:
    """Arrays and the loop agree; polynomials without terms are 0 among others."""
    ring = Ring(["x", "y"], radicand)
    u, v = ring.gens
    many = [ring.constant(0), (u + 2 * v - 1) ** 30, u * 0, u**3 - v, ring.constant(5)]
    if radicand:
        many[3] += ring.surd * u
    evaluator = Evaluator(ring, many)
    assert evaluator._count > 400
    at = (0.3, -0.7)
    root = math.sqrt(radicand) if radicand else 0.0
    expected = [0.0, (0.3 - 1.4 - 1) ** 30, 0.0, 0.027 + 0.7 + root * 0.3, 5.0]
    assert evaluator.floats(at) == pytest.approx(expected, rel=1e-9)
