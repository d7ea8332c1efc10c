"""Trigonometric polynomials on T^k as sums of waves, in doubles, many points at once.

h(theta) = sum over frequencies n of A_n cos(n . theta) + B_n sin(n . theta).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import acb, arb, ctx
from numpy.typing import NDArray

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import Circle

__all__ = ["TorusFunction"]

Array = NDArray[np.float64]
Waves = dict[tuple[int, ...], acb]

_BITS = 128


@dataclass(frozen=True, eq=False)
class TorusFunction:
    """A trigonometric polynomial h on T^k.

    Attributes:
        frequencies: (w, k) whole numbers, one of n and -n each.
        even: (w,) the A_n, each the nearest double but for the last place.
        odd: (w,) the B_n, likewise.
    """

    frequencies: NDArray[np.int64]
    even: Array
    odd: Array

    @classmethod
    def from_polynomial(
        cls, ring: Ring, circles: Sequence[Circle], polynomial: Polynomial
    ) -> TorusFunction:
        """The function of a polynomial in the variables of k circles (c_i, s_i)."""
        saved, ctx.prec = ctx.prec, _BITS
        try:
            waves = _waves(ring, circles, polynomial)
        finally:
            ctx.prec = saved
        half = sorted(n for n in waves if n >= tuple(-x for x in n)) or [
            (0,) * len(circles)
        ]
        values = [waves.get(n, acb(0)) * (2 if any(n) else 1) for n in half]
        return cls(
            np.array(half, dtype=np.int64).reshape(len(half), len(circles)),
            np.array([float(value.real.mid()) for value in values]),
            np.array([float(-value.imag.mid()) for value in values]),
        )

    @property
    def dimension(self) -> int:
        """The dimension k of the torus."""
        return int(self.frequencies.shape[1])

    @cached_property
    def size(self) -> float:
        """A bound of |h|: the sum of the |A_n| + |B_n|."""
        return float((np.abs(self.even) + np.abs(self.odd)).sum())

    def __call__(self, points: Array) -> Array:
        """The values at points (..., k): (...)."""
        c, s = self._turned(points)
        return np.asarray(c @ self.even + s @ self.odd)

    def __neg__(self) -> TorusFunction:
        """-h."""
        return TorusFunction(self.frequencies, -self.even, -self.odd)

    def gradient(self, points: Array) -> Array:
        """The gradients at points (..., k): (..., k)."""
        c, s = self._turned(points)
        return np.asarray((c * self.odd - s * self.even) @ self.frequencies)

    def hessian(self, points: Array) -> Array:
        """The Hessian matrices at points (..., k): (..., k, k)."""
        c, s = self._turned(points)
        n = self.frequencies
        squares = (n[:, :, None] * n[:, None, :]).reshape(len(n), -1)
        flat = -(c * self.even + s * self.odd) @ squares
        return np.asarray(flat.reshape(*flat.shape[:-1], *n.shape[1:] * 2))

    def _turned(self, points: Array) -> tuple[Array, Array]:
        angles = np.asarray(points) @ self.frequencies.T
        return np.cos(angles), np.sin(angles)


def _waves(ring: Ring, circles: Sequence[Circle], polynomial: Polynomial) -> Waves:
    """The coefficients of e^(i n . theta)."""
    names = [name for circle in circles for name in circle]
    total: Waves = {}
    for powers, rest in ring.coefficients(polynomial, names).items():
        term: Waves = {(): acb(ring.evaluate(rest, {}))}
        for i in range(len(circles)):
            factor = _powers(powers[2 * i], powers[2 * i + 1])
            term = {(*n, k): x * y for n, x in term.items() for k, y in factor.items()}
        for n, x in term.items():
            total[n] = total.get(n, acb(0)) + x
    return {n: x for n, x in total.items() if x != 0}


def _powers(a: int, b: int) -> dict[int, acb]:
    """The coefficients of e^(i k theta) in cos^a sin^b."""
    result = {0: acb(1)}
    half, turned = acb(arb(1) / 2), acb(0, arb(1) / 2)
    for step in [{1: half, -1: half}] * a + [{1: -turned, -1: turned}] * b:
        grown: dict[int, acb] = {}
        for k, x in result.items():
            for m, y in step.items():
                grown[k + m] = grown.get(k + m, acb(0)) + x * y
        result = grown
    return result
