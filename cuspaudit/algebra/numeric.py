"""Polynomials in floating point, at many points at once, for cross-checks only."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cuspaudit.algebra.ring import Polynomial, Ring

__all__ = ["NumericPolynomial", "numeric_values"]

Array = NDArray[np.float64]


class NumericPolynomial:
    """A polynomial of K[x_1..x_n] with its coefficients rounded to doubles.

    Attributes:
        exponents: (terms, n) exponents in the variables of the ring.
        coefficients: (terms,) coefficients, each correct to a few units in the last
            place; sqrt m is multiplied in.
    """

    def __init__(self, ring: Ring, polynomial: Polynomial) -> None:
        n = len(ring.variables)
        root = math.sqrt(ring.radicand or 0)
        terms = ring.reduce(polynomial).to_dict()
        self.exponents = np.array(
            [[int(e) for e in key[:n]] for key in terms], dtype=np.int64
        )
        self.exponents = self.exponents.reshape(len(terms), n)
        self.coefficients: Array = np.array(
            [
                int(value.p) / int(value.q) * root ** int(sum(key[n:]))
                for key, value in terms.items()
            ],
            dtype=np.float64,
        )

    def __call__(self, points: ArrayLike) -> Array:
        """The values at ``points``, (m, n) in the ring's order: (m,)."""
        x = np.asarray(points, dtype=np.float64)
        terms = np.ones((len(self.coefficients), len(x)))
        for column, exponents in zip(x.T, self.exponents.T, strict=True):
            power = np.ones(len(x))
            for exponent in range(1, exponents.max(initial=0) + 1):
                power = power * column
                terms[exponents == exponent] *= power
        return np.asarray(self.coefficients @ terms)


def numeric_values(
    ring: Ring, polynomials: Sequence[Polynomial], points: ArrayLike
) -> Array:
    """The values of d ``polynomials`` at ``points``, (m, n) in the ring's order.

    Returns:
        (m, d); the error is that of a sum of products in doubles.

    >>> ring = Ring(["c", "s"], radicand=2)
    >>> c, s = ring.gens
    >>> numeric_values(ring, [c**2 + s, 2 * c], [[3.0, 1.0], [0.0, -1.0]])
    array([[10.,  6.],
           [-1.,  0.]])
    """
    columns = [NumericPolynomial(ring, p)(points) for p in polynomials]
    return np.stack(columns, axis=1)
