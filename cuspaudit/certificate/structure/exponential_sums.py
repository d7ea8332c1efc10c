"""Numbers made of cosines and sines, exactly, and the test whether one of them is 0.

A sum of terms c e^(i pi t) e^(i r), with c, t and r rational, is kept in a form in
which equal sums have equal terms as far as is known here:

- t is t0 + k/12 with 0 <= t0 < 1/12, and the powers of z = e^(i pi / 12), a primitive
  24th root of unity, are written in 1, z, ..., z^7 by z^8 = z^4 - 1, z^12 = -1;
- terms with the same (t0, r, k) are added, and those with c = 0 dropped.

**A sum without terms is 0**: that is all the proofs need. The converse holds where
every t0 is 0: then the sum is a combination of e^(i r), the r distinct and rational,
with coefficients in the field of z, not all 0; by the theorem of Lindemann and
Weierstrass (exponentials of distinct algebraic numbers are linearly independent over
the algebraic numbers) it is not 0. So a relation of a robot whose angles are multiples
of 15 degrees plus any rational numbers of radians is found whenever it holds. With
other parts of pi a relation may be missed: then it counts as not proved.

The square roots of 2, 3 and 6 are such sums: 2 cos(pi/4), 2 cos(pi/6), their product.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from cuspaudit.certificate.cover import Refusal

__all__ = ["ExponentialSum", "cosine_and_sine", "root"]

Exponent = tuple[Fraction, Fraction, int]

MOST_TERMS = 2000
"""A sum with more terms is refused: no file may keep its checker busy for long."""

_NONE = Fraction(0)


@dataclass(frozen=True, slots=True)
class ExponentialSum:
    """A sum of c e^(i pi (t0 + k/12)) e^(i r), by its exponents (t0, r, k).

    Attributes:
        terms: each c, not 0, with its exponents in the form above.
    """

    terms: Mapping[Exponent, Fraction]

    @staticmethod
    def of(number: Fraction) -> ExponentialSum:
        """A rational number."""
        return ExponentialSum({(_NONE, _NONE, 0): number} if number else {})

    @staticmethod
    def power(half_turns: Fraction, radians: Fraction) -> ExponentialSum:
        """e^(i (half_turns pi + radians))."""
        return _collected([(half_turns, radians, Fraction(1))])

    @property
    def is_zero(self) -> bool:
        """Whether the sum has no terms, hence is 0."""
        return not self.terms

    def __add__(self, other: ExponentialSum) -> ExponentialSum:
        if not self.terms or not other.terms:
            return self if self.terms else other
        terms = dict(self.terms)
        for key, c in other.terms.items():
            terms[key] = terms.get(key, _NONE) + c
        return ExponentialSum({key: c for key, c in terms.items() if c})

    def __neg__(self) -> ExponentialSum:
        return ExponentialSum({key: -c for key, c in self.terms.items()})

    def __sub__(self, other: ExponentialSum) -> ExponentialSum:
        return self + -other

    def __mul__(self, other: ExponentialSum) -> ExponentialSum:
        """The product.

        Raises:
            Refusal: it might have more than `MOST_TERMS` terms.
        """
        if len(self.terms) * len(other.terms) > MOST_TERMS:
            raise Refusal("a relation is too long to be tested exactly")
        return _collected(
            (t + u + Fraction(k + j, 12), r + s, c * d)
            for (t, r, k), c in self.terms.items()
            for (u, s, j), d in other.terms.items()
        )

    def times(self, number: Fraction) -> ExponentialSum:
        """The product with a rational number."""
        if not number:
            return ExponentialSum({})
        return ExponentialSum({key: c * number for key, c in self.terms.items()})


def cosine_and_sine(
    half_turns: Fraction, radians: Fraction
) -> tuple[ExponentialSum, ExponentialSum]:
    """Cosine and sine of half_turns pi + radians."""
    there = ExponentialSum.power(half_turns, radians)
    back = ExponentialSum.power(-half_turns, -radians)
    over_i = ExponentialSum.power(Fraction(-1, 2), _NONE)
    half = Fraction(1, 2)
    return (there + back).times(half), ((there - back) * over_i).times(half)


def root(square: Fraction) -> ExponentialSum | None:
    """The square root of a positive number, 1, 2, 3 or 6 times a square; else None.

    >>> (root(Fraction(9, 2)) * root(Fraction(9, 2)) - ExponentialSum.of(Fraction(9, 2))
    ...     ).is_zero
    True
    """
    whole = square.numerator * square.denominator
    for d in (1, 2, 3, 6):
        side = isqrt(whole // d)
        if side * side * d == whole:
            scale = Fraction(side, square.denominator)
            return _root_of_divisor_of_six(d).times(scale)
    return None


def _root_of_divisor_of_six(d: int) -> ExponentialSum:
    value = ExponentialSum.of(Fraction(1))
    for prime, half_turns in ((2, Fraction(1, 4)), (3, Fraction(1, 6))):
        if d % prime == 0:
            value = value * cosine_and_sine(half_turns, _NONE)[0].times(Fraction(2))
    return value


def _collected(parts: Iterable[tuple[Fraction, Fraction, Fraction]]) -> ExponentialSum:
    """The sum of c e^(i pi t) e^(i r) over the parts (t, r, c), in the form above."""
    terms: dict[Exponent, Fraction] = {}
    for t, r, c in parts:
        k = (12 * t).__floor__()
        rest, k = t - Fraction(k, 12), k % 24
        if k >= 12:
            k, c = k - 12, -c
        for j, d in ((k, c),) if k < 8 else ((k - 4, c), (k - 8, -c)):
            key = (rest, r, j)
            terms[key] = terms.get(key, _NONE) + d
    return ExponentialSum({key: c for key, c in terms.items() if c})
