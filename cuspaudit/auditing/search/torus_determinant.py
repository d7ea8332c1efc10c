"""det J of a six-joint arm as a function on the torus of joints 2 to 5, in doubles.

det J does not depend on the first and the last joint. In the link between joints 3 and
4 it is a sum of products of a 3x3 minor of the screws of joints 1, 2, 3 and one of
those of joints 4, 5, 6 [mathematics 9]. Carried there, the screw of joint 3 is
constant, that of joint 2 has degree 1 in (c_3, s_3), that of joint 1 degree 1 in (c_2,
s_2) and in (c_3, s_3); so a minor has degree at most (1, 2) in joints 2, 3, and the
other half (2, 1) in joints 4, 5. The values on a grid of 3 x 5 x 5 x 3 angles determine
it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.kinematics.postures.numeric import PostureSolver

__all__ = ["TorusDeterminant"]

Array = NDArray[np.float64]

_DEGREES = (1, 2, 2, 1)
_DIFFERENCE = 1e-5


@dataclass(frozen=True, eq=False)
class TorusDeterminant:
    """h = det J on the torus of joints 2, 3, 4, 5.

    Attributes:
        table: (15, 15) coefficients; rows the products of the bases of joints 2 and 3,
            columns those of joints 4 and 5; a basis is 1, cos, sin, (cos 2, sin 2).
    """

    table: Array

    @classmethod
    def of(cls, solver: PostureSolver) -> TorusDeterminant:
        """The determinant of the solver's arm, in the solver's unit of length."""
        angles = [2 * np.pi * np.arange(2 * d + 1) / (2 * d + 1) for d in _DEGREES]
        grid = np.stack(np.meshgrid(*angles, indexing="ij"), -1)
        still = np.zeros((*grid.shape[:-1], 1))
        values = solver.determinants(np.concatenate([still, grid, still], -1))
        for axis, (degree, nodes) in enumerate(zip(_DEGREES, angles, strict=True)):
            fit = np.linalg.inv(_basis(nodes, degree))
            values = np.moveaxis(np.tensordot(fit, values, (1, axis)), 0, axis)
        return cls(values.reshape(15, 15))

    @property
    def dimension(self) -> int:
        """The dimension of the torus."""
        return len(_DEGREES)

    @property
    def size(self) -> float:
        """A bound of |h|: no product of bases is larger than 1."""
        return float(np.abs(self.table).sum())

    def __call__(self, points: Array) -> Array:
        """The values at points (..., 4)."""
        first, second = self._halves(points, ())
        return np.asarray((first @ self.table * second).sum(-1))

    def gradient(self, points: Array) -> Array:
        """The gradients at points (..., 4): (..., 4)."""
        parts: list[Any] = []
        for axis in range(4):
            first, second = self._halves(points, (axis,))
            parts.append((first @ self.table * second).sum(-1))
        return np.stack(parts, -1)

    def hessian(self, points: Array) -> Array:
        """The Hessian matrices at points (..., 4): (..., 4, 4), by differences."""
        columns = [
            (self.gradient(points + e) - self.gradient(points - e)) / (2 * _DIFFERENCE)
            for e in _DIFFERENCE * np.eye(4)
        ]
        result = np.stack(columns, -1)
        return np.asarray((result + np.swapaxes(result, -1, -2)) / 2)

    def _halves(self, points: Array, derived: tuple[int, ...]) -> tuple[Array, Array]:
        """The products of the bases, those of the joints in ``derived`` derived."""
        bases = [
            _basis(points[..., k], degree, k in derived)
            for k, degree in enumerate(_DEGREES)
        ]
        return _products(*bases[:2]), _products(*bases[2:])


def _basis(angles: Array, degree: int, derived: bool = False) -> Array:
    """1, cos, sin, for degree 2 cos 2, sin 2, at angles (...); or the derivatives."""
    c, s = np.cos(angles), np.sin(angles)
    result = np.empty((*angles.shape, 2 * degree + 1))
    result[..., 0] = 0.0 if derived else 1.0
    result[..., 1], result[..., 2] = (-s, c) if derived else (c, s)
    if degree == 2:
        double = (2 * c * c - 1, 2 * s * c)
        result[..., 3] = -2 * double[1] if derived else double[0]
        result[..., 4] = 2 * double[0] if derived else double[1]
    return result


def _products(a: Array, b: Array) -> Array:
    product = a[..., :, None] * b[..., None, :]
    return product.reshape(*product.shape[:-2], a.shape[-1] * b.shape[-1])
