"""Doubles with bounds, against exact fractions."""

from __future__ import annotations

import random
from fractions import Fraction

import numpy as np
import pytest
from flint import arb

from cuspaudit.surface.spreads import Spread

rng = random.Random(3)


def spread() -> tuple[Spread, Fraction]:
    """A few bits of a number and the number, anywhere in its bounds."""
    mid, rad = rng.uniform(-2, 2), rng.choice((0.0, 1e-17, 1e-3, 1.0)) * rng.random()
    number = Fraction(mid) + Fraction(rad) * rng.choice((-1, 1, 0, Fraction(1, 3)))
    return Spread(np.array([mid]), np.array([rad])), number


def holds(found: Spread, number: Fraction) -> bool:
    """Whether the bounds hold, exactly."""
    mid, rad = (Fraction(float(x[0])) for x in (found.mid, found.rad))
    return abs(number - mid) <= rad


@pytest.mark.parametrize("operation", ["+", "-", "*", "square", "doubled"])
def test_bounds_hold_after_an_operation(operation: str) -> None:
    """Of 500 random numbers each result lies in its bounds, to the last bit."""
    for _ in range(500):
        (a, x), (b, y) = spread(), spread()
        found, number = {
            "+": (a + b, x + y),
            "-": (a - b, x - y),
            "*": (a * b, x * y),
            "square": (a.square(), x * x),
            "doubled": (a.doubled(), 2 * x),
        }[operation]
        assert holds(found, number)
        assert Fraction(float(found.low[0])) <= number <= Fraction(float(found.high[0]))


def test_roots_hold_what_is_not_negative() -> None:
    """The root of a number that is not negative lies in the bounds of the roots."""
    for _ in range(500):
        a, x = spread()
        found = a.root()
        mid, rad = (Fraction(float(v[0])) for v in (found.mid, found.rad))
        if x >= 0:
            assert max(mid - rad, 0) ** 2 <= x <= (mid + rad) ** 2


def test_a_ball_keeps_its_number() -> None:
    """A third, which no double is, lies in the bounds made of its ball."""
    found = Spread.of(arb(1) / 3)
    gap = abs(Fraction(float(found.mid)) - Fraction(1, 3))
    assert 0 < gap <= Fraction(float(found.rad)) < Fraction(1, 10**15)
