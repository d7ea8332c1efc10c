"""Many real numbers at once, each known up to a bound: a middle and a radius.

A sum, difference or product of doubles is off by at most ``UNIT`` times its size, or by
less than the smallest normal double. Radii are sums of products of numbers that are not
negative, so their own rounding is made up for by the factor ``GROWN`` after every
operation. Overflow gives infinite radii, or nan; every comparison with either is false.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from flint import arb
from numpy.typing import NDArray

__all__ = ["GROWN", "UNIT", "Spread"]

Array = NDArray[np.float64]
Truths = NDArray[np.bool_]

UNIT = 2.0**-53
GROWN = 1 + 2.0**-48
_TINY = 1e-300


@dataclass(frozen=True, slots=True, eq=False)
class Spread:
    """Real numbers x with |x - mid| <= rad.

    Attributes:
        mid: doubles.
        rad: of the same shape, or one that spreads to it; not negative.
    """

    mid: Array
    rad: Array

    @classmethod
    def of(cls, ball: arb) -> Spread:
        """One number that lies in a ball."""
        mid = float(ball.mid())
        rest = abs(ball - arb(mid)).upper()
        return cls(np.asarray(mid), np.asarray(float(rest) * GROWN + _TINY))

    def __add__(self, other: Spread) -> Spread:
        mid = self.mid + other.mid
        return Spread(mid, (self.rad + other.rad + UNIT * np.abs(mid)) * GROWN)

    def __sub__(self, other: Spread) -> Spread:
        mid = self.mid - other.mid
        return Spread(mid, (self.rad + other.rad + UNIT * np.abs(mid)) * GROWN)

    def __mul__(self, other: Spread) -> Spread:
        mid = self.mid * other.mid
        rad = np.abs(self.mid) * other.rad + self.rad * (np.abs(other.mid) + other.rad)
        return Spread(mid, (rad + UNIT * np.abs(mid)) * GROWN + _TINY)

    def __neg__(self) -> Spread:
        return Spread(-self.mid, self.rad)

    def doubled(self) -> Spread:
        """Twice the numbers, without rounding."""
        return Spread(2 * self.mid, 2 * self.rad)

    @property
    def high(self) -> Array:
        """Upper bounds."""
        top = self.mid + self.rad
        return np.asarray(top + 2 * UNIT * np.abs(top) + _TINY)

    @property
    def low(self) -> Array:
        """Lower bounds."""
        bottom = self.mid - self.rad
        return np.asarray(bottom - 2 * UNIT * np.abs(bottom) - _TINY)

    def square(self) -> Spread:
        """The squares, no bound of which is below 0 but for rounding."""
        size = np.abs(self.mid)
        largest = (size + self.rad) ** 2
        smallest = np.maximum(size - self.rad, 0) ** 2
        mid = (largest + smallest) / 2
        return Spread(mid, ((largest - smallest) / 2 + 8 * UNIT * mid) * GROWN + _TINY)

    def root(self) -> Spread:
        """The roots of what of the numbers is not negative; 0 where nothing is."""
        top = np.sqrt(np.maximum(self.high, 0)) * GROWN
        bottom = np.sqrt(np.maximum(self.low, 0)) / GROWN
        mid = (top + bottom) / 2
        return Spread(mid, ((top - bottom) / 2 + UNIT * mid) * GROWN)
