from __future__ import annotations

from fractions import Fraction
from itertools import count

from flint import arb, ctx, fmpq
from hypothesis import assume, given
from hypothesis import strategies as st

from cuspaudit.algebra.rationals import (
    exact_rational,
    rationals_between,
    simplest_between,
)

rationals = st.fractions(-5, 5, max_denominator=50)


def flint(value: Fraction) -> fmpq:
    """FLINT's rational."""
    return fmpq(value.numerator, value.denominator)


def searched(low: Fraction, high: Fraction) -> Fraction:
    """The rational of least denominator, then least size, by trying them all."""
    for q in count(1):
        first = -((-low.numerator * q) // low.denominator)
        last = (high.numerator * q) // high.denominator
        if first <= last:
            return Fraction(min(range(first, last + 1), key=abs), q)
    raise AssertionError


@given(rationals, rationals)
def test_the_simplest_rational_is_found_by_search_too(a: Fraction, b: Fraction) -> None:
    """Stern-Brocot's answer is that of trying every denominator."""
    low, high = sorted((a, b))
    found = simplest_between(flint(low), flint(high))
    assert found == flint(searched(low, high))


@given(rationals, rationals)
def test_the_simplest_rational_is_odd(a: Fraction, b: Fraction) -> None:
    """The answer for the mirrored interval is the negative."""
    low, high = (flint(x) for x in sorted((a, b)))
    assert simplest_between(-high, -low) == -simplest_between(low, high)


@given(rationals, rationals)
def test_rationals_between_balls(a: Fraction, b: Fraction) -> None:
    """Every candidate lies strictly between the balls, and all differ."""
    low, high = sorted((a, b))
    assume(low != high)
    ends = arb(flint(low)), arb(flint(high))
    found = list(rationals_between(*ends))
    assert len(set(found)) == len(found) > 3
    assert all(ends[0] < arb(x) and arb(x) < ends[1] for x in found)


def test_gap_of_two_close_balls_is_found_at_any_precision() -> None:
    """Rationals between balls made at 256 bits lie between them at 53 bits too."""
    saved, ctx.prec = ctx.prec, 256
    try:
        low = arb(1) / 3
        high = low + arb(2) ** -120
    finally:
        ctx.prec = saved
    for value in rationals_between(low, high):
        ctx.prec, found = 256, fmpq(value)
        try:
            assert low < arb(found) < high
        finally:
            ctx.prec = saved


def test_rationals_beside_infinity() -> None:
    """An open end is served as well, and no end at all starts at a simple number."""
    assert all(x > 5 for x in rationals_between(arb(5), None))
    assert all(x < -5 for x in rationals_between(None, arb(-5)))
    assert next(rationals_between(None, None)) == 0


def test_the_midpoint_is_exact() -> None:
    """The midpoint of a ball is a dyadic rational."""
    assert exact_rational(arb(0.375)) == fmpq(3, 8)
    assert exact_rational(arb(-5)) == -5
