"""Three trigonometric polynomials at dyadic angles, with a bound for the rounding.

At the angles 2 pi j / 2^m the phases n . theta are whole multiples of 2 pi / 2^m, so
the cosines come from a table of correctly rounded doubles, and what remains is one
product of matrices: sums of w products, each with an error of at most (w + 3) units in
the last place of the sum of sizes [Higham, Accuracy and Stability, 3.1].
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, lru_cache

import numpy as np
from flint import arb, ctx, fmpq
from numpy.typing import NDArray

from cuspaudit.geometry.torus.function import TorusFunction

__all__ = ["BoxWaves"]

Array = NDArray[np.float64]
Whole = NDArray[np.int64]


class BoxWaves:
    """Functions f_1..f_r on T^k with values and derivatives at dyadic angles.

    Attributes:
        dimension: k.
        twist: (r, k, k, k) bounds of the third derivatives on the whole torus.
        slack: (r,) bounds of the rounding of a value, a first or a second derivative.
    """

    def __init__(self, functions: Sequence[TorusFunction]) -> None:
        """Gather the frequencies of all ``functions``."""
        every = np.concatenate([f.frequencies for f in functions])
        self._n = np.unique(every, axis=0)
        self._even, self._odd = (
            np.stack([_spread(self._n, f, part) for f in functions], 1)
            for part in ("even", "odd")
        )
        self.dimension = self._n.shape[1]
        size, n = np.abs(self._even) + np.abs(self._odd), np.abs(self._n).astype(float)
        grown = 1 + 1e-12
        self.twist: Array = grown * np.einsum("wr,wi,wj,wk->rijk", size, n, n, n)
        largest = float(max(1, n.max())) ** 2
        unit = float(np.finfo(float).eps)
        self.slack: Array = 8 * (len(n) + 8) * unit * largest * size.sum(0)

    @cached_property
    def _first(self) -> tuple[Array, Array]:
        """What turns cosines and sines into values and gradients."""
        n = np.concatenate([np.ones((len(self._n), 1)), self._n], 1)
        even = self._even[:, :, None] * n[:, None, :]
        odd = self._odd[:, :, None] * n[:, None, :]
        cosine, sine = odd.copy(), -even
        cosine[:, :, 0], sine[:, :, 0] = self._even, self._odd
        return cosine, sine

    @cached_property
    def _second(self) -> tuple[Array, Array]:
        n = self._n
        squares = n[:, :, None] * n[:, None, :]
        return (
            -self._even[:, :, None, None] * squares[:, None],
            -self._odd[:, :, None, None] * squares[:, None],
        )

    def first(self, angles: Whole, bits: int) -> tuple[Array, Array]:
        """Values (m, r) and gradients (m, r, k) at angles 2 pi ``angles`` / 2^bits."""
        both = self._product(angles, bits, self._first)
        return both[:, :, 0], both[:, :, 1:]

    def second(self, angles: Whole, bits: int) -> Array:
        """Hessian matrices (m, r, k, k)."""
        return self._product(angles, bits, self._second)

    def _product(self, angles: Whole, bits: int, parts: tuple[Array, Array]) -> Array:
        c, s = _table(bits)
        phase = (angles @ self._n.T) % (1 << bits)
        cosine, sine = (part.reshape(len(self._n), -1) for part in parts)
        flat = c[phase] @ cosine + s[phase] @ sine
        return np.asarray(flat.reshape(len(angles), *parts[0].shape[1:]))


def _spread(n: Whole, function: TorusFunction, part: str) -> Array:
    """The coefficients of a function in the common list of frequencies."""
    place = {tuple(row): i for i, row in enumerate(n.tolist())}
    result = np.zeros(len(n))
    for row, value in zip(
        function.frequencies.tolist(), getattr(function, part), strict=True
    ):
        result[place[tuple(row)]] += value
    return result


@lru_cache
def _table(bits: int) -> tuple[Array, Array]:
    """Cosines and sines of 2 pi j / 2^bits, each right to half a unit or so."""
    saved, ctx.prec = ctx.prec, 80
    try:
        turns = [arb(fmpq(2 * j, 1 << bits)) for j in range(1 << bits)]
        pairs = [(turn.cos_pi(), turn.sin_pi()) for turn in turns]
    finally:
        ctx.prec = saved
    c, s = (np.array([float(pair[i].mid()) for pair in pairs]) for i in (0, 1))
    return c, s
