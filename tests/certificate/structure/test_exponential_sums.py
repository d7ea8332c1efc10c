from __future__ import annotations

import cmath
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.certificate.cover import Refusal
from cuspaudit.certificate.structure.exponential_sums import (
    MOST_TERMS,
    ExponentialSum,
    cosine_and_sine,
    root,
)

turns = st.builds(Fraction, st.integers(-60, 60), st.sampled_from([1, 4, 6, 12, 7]))
radians = st.builds(Fraction, st.integers(-30, 30), st.sampled_from([1, 10, 7]))
sums = st.builds(
    lambda t, r, c: ExponentialSum.power(t, r).times(c),
    turns,
    radians,
    st.integers(-3, 3).map(Fraction),
)


def value(exact: ExponentialSum) -> complex:
    """The number in floating point."""
    return sum(
        (
            float(c) * cmath.exp(1j * (cmath.pi * (float(t) + k / 12) + float(r)))
            for (t, r, k), c in exact.terms.items()
        ),
        0j,
    )


@given(sums, sums, sums)
def test_sums_and_products_are_those_of_the_numbers(
    a: ExponentialSum, b: ExponentialSum, c: ExponentialSum
) -> None:
    """The normal form has the value of the number it stands for."""
    assert abs(value(a * b + c) - (value(a) * value(b) + value(c))) < 1e-9
    assert (a * b - b * a).is_zero
    assert (a * (b + c) - a * b - a * c).is_zero


@given(turns, radians)
def test_every_cosine_and_sine_lies_on_the_circle(t: Fraction, r: Fraction) -> None:
    """Sin^2 + cos^2 is 1 exactly, whatever the angle, and their values are right."""
    c, s = cosine_and_sine(t, r)
    assert (c * c + s * s - ExponentialSum.of(Fraction(1))).is_zero
    angle = cmath.pi * float(t) + float(r)
    assert abs(value(c) - cmath.cos(angle)) + abs(value(s) - cmath.sin(angle)) < 1e-9


@pytest.mark.parametrize(
    ("first", "second", "equal"),
    [
        ((Fraction(1, 3), Fraction(0)), (Fraction(-1, 3), Fraction(0)), True),
        ((Fraction(1, 12), Fraction(0)), (Fraction(25, 12), Fraction(0)), True),
        ((Fraction(0), Fraction(1)), (Fraction(0), Fraction(-1)), True),
        ((Fraction(0), Fraction(355, 113)), (Fraction(1), Fraction(0)), False),
        ((Fraction(1, 4), Fraction(0)), (Fraction(1, 6), Fraction(0)), False),
    ],
)
def test_equal_cosines_are_found_and_only_they(
    first: tuple[Fraction, Fraction], second: tuple[Fraction, Fraction], equal: bool
) -> None:
    """355/113 is not pi, though it is close."""
    difference = cosine_and_sine(*first)[0] - cosine_and_sine(*second)[0]
    assert difference.is_zero == equal


@pytest.mark.parametrize("square", ["2", "3", "6", "9/2", "1/3", "0.75", "4"])
def test_roots_of_two_three_and_six_are_exact(square: str) -> None:
    """The square of the root is the number, and the root is positive."""
    number = Fraction(square)
    found = root(number)
    assert found is not None
    assert (found * found - ExponentialSum.of(number)).is_zero
    assert value(found).real > 0


def test_other_roots_are_none_here() -> None:
    """The root of 5, 7 or 10 is not claimed to be known."""
    assert all(root(Fraction(k)) is None for k in (5, 7, 10))


def test_long_products_are_refused() -> None:
    """A product that would have thousands of terms stops the proof, not the machine."""
    long = ExponentialSum.of(Fraction(1))
    for k in range(1, 60):
        long = long + ExponentialSum.power(Fraction(0), Fraction(k))
    assert len(long.terms) ** 2 > MOST_TERMS
    with pytest.raises(Refusal, match="too long"):
        _ = long * long
