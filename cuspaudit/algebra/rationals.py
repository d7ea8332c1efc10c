"""Simple rationals in intervals."""

from __future__ import annotations

from collections.abc import Iterator

from flint import arb, fmpq, fmpz

__all__ = ["exact_rational", "rationals_between", "simplest_between"]

_TRIES = 40


def rationals_between(low: arb | None, high: arb | None) -> Iterator[fmpq]:
    """Rationals strictly between two balls, simple and away from the ends first.

    None stands for an infinite end. Finitely many, all different.
    """
    left, right = fmpq(-1), fmpq(1)
    if low is not None:
        left = exact_rational(low) + exact_rational(low.rad())
        right = fmpq(left.ceil() + 3)
    if high is not None:
        right = exact_rational(high) - exact_rational(high.rad())
        left = fmpq(right.floor() - 3) if low is None else left
    width = right - left
    seen: set[fmpq] = set()
    for k in range(_TRIES):
        start = left + width * (fmpq(1, 3) + fmpq(k, 5 * _TRIES))
        candidate = simplest_between(start, start + width * fmpq(1, 4 + 3 * k))
        if candidate not in seen:
            seen.add(candidate)
            yield candidate


def simplest_between(low: fmpq, high: fmpq) -> fmpq:
    """The rational of least denominator in the closed interval [low, high].

    Odd: the result for [-high, -low] is the negative.

    >>> simplest_between(fmpq(314, 100), fmpq(315, 100))
    22/7
    """
    if low <= 0 <= high:
        return fmpq(0)
    if high < 0:
        return -simplest_between(-high, -low)
    # convergents above/below of the continued fraction that low and high share
    above, below = (fmpz(1), fmpz(0)), (fmpz(0), fmpz(1))
    while True:
        whole = low.floor()
        if whole < low:
            whole += whole + 1 <= high
        above, below = (
            (whole * above[0] + above[1], above[0]),
            (whole * below[0] + below[1], below[0]),
        )
        if low <= whole <= high:
            return fmpq(above[0], below[0])
        low, high = 1 / (high - whole), 1 / (low - whole)


def exact_rational(ball: arb) -> fmpq:
    """The midpoint of a ball, which is a dyadic rational, exactly."""
    mantissa, exponent = ball.mid().man_exp()
    return fmpq(mantissa) * fmpq(2) ** int(exponent)
