"""Matrices over Q or Q(sqrt m), as FLINT's matrices over Q.

An element a + b sqrt m acts on Q + Q sqrt m by the matrix ((a, m b), (b, a)). So a
matrix over Q(sqrt m) is one over Q of twice the size; sums, products and inverses are
those of the larger matrices, and the determinant of the larger one is the norm of the
determinant.

Elements stand in numpy arrays of objects: rationals, or polynomials (FLINT) in sqrt m.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mat, fmpq_poly
from numpy.typing import NDArray

from cuspaudit.algebra.ring import Polynomial, Ring

__all__ = ["QuadraticField"]

Array = NDArray[Any]


@dataclass(frozen=True)
class QuadraticField:
    """K = Q(sqrt ``radicand``), or Q when that is None."""

    radicand: int | None = None

    @property
    def degree(self) -> int:
        """Of K over Q."""
        return 1 if self.radicand is None else 2

    def element(self, ring: Ring, constant: Polynomial) -> Any:
        """A constant of a ring over K as an element.

        >>> ring = Ring(["x"], 3)
        >>> QuadraticField(3).element(ring, ring.surd + 2)
        x + 2
        """
        parts = [
            p.leading_coefficient() if p else fmpq(0) for p in ring.parts(constant)
        ]
        return parts[0] if self.radicand is None else fmpq_poly(parts)

    def reduced(self, array: Array) -> Array:
        """The entries as elements of degree at most 1 in sqrt m."""
        return _mapped(self.reduced_element, array)

    def reduced_element(self, entry: Any) -> Any:
        """One element of degree at most 1 in sqrt m."""
        if self.radicand is None:
            return entry
        return fmpq_poly([1]) * entry % fmpq_poly([-self.radicand, 0, 1])

    def matrix(self, array: Array) -> fmpq_mat:
        """The matrix over Q of a reduced (n, k) array: (n d, k d), d the degree of K.

        >>> QuadraticField(2).matrix(np.array([[1]], dtype=object))
        [1, 0]
        [0, 1]
        """
        n, k = array.shape
        if self.radicand is None:
            return fmpq_mat(n, k, list(array.ravel()))
        wide = np.empty((n, 2, k, 2), dtype=object)
        for i, j in np.ndindex(n, k):
            a, b = (fmpq_poly([1]) * array[i, j])[0], (fmpq_poly([1]) * array[i, j])[1]
            wide[i, :, j] = [[a, self.radicand * b], [b, a]]
        return fmpq_mat(2 * n, 2 * k, list(wide.ravel()))

    def surd_matrix(self, size: int) -> fmpq_mat:
        """Sqrt m times the matrix 1 of (size, size) over K; only when K is not Q."""
        entries = np.full((size, size), 0, dtype=object)
        for i in range(size):
            entries[i, i] = fmpq_poly([0, 1])
        return self.matrix(entries)

    def array(self, matrix: fmpq_mat) -> Array:
        """The array of elements that ``matrix`` came from."""
        wide = np.array(matrix.entries(), dtype=object)
        d = self.degree
        wide = wide.reshape(matrix.nrows() // d, d, matrix.ncols() // d, d)[..., 0]
        if self.radicand is None:
            return wide[:, 0]
        result = np.empty((wide.shape[0], wide.shape[2]), dtype=object)
        for i, j in np.ndindex(result.shape):
            result[i, j] = fmpq_poly(list(wide[i, :, j]))
        return result


def _mapped(function: Any, array: Array) -> Array:
    result = np.empty(array.size, dtype=object)
    for k, entry in enumerate(array.ravel()):
        result[k] = function(entry)
    return result.reshape(array.shape)
