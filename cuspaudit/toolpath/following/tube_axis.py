"""The curved axis of a tube: a parabola that leaves the curve of zeros slowly."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.toolpath.following.expansion import Expansion, expansion_at
from cuspaudit.toolpath.following.leg_system import LegSystem

__all__ = ["TubeAxis", "axis_at", "beside", "inverse"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class TubeAxis:
    """The axis of a tube, without its ends.

    Attributes:
        here: the expansion at c.
        along: a.
        across: N.
        bow: e.
        Y: the inverse of K(c) N, nearly.
    """

    here: Expansion
    along: Array
    across: Array
    bow: Array
    Y: Array

    def point(self, t: float) -> Array:
        """C + t a + t^2 e."""
        return self.here.at + t * self.along + t * t * self.bow


def axis_at(system: LegSystem, at: Array, heading: Array) -> TubeAxis | None:
    """The axis through ``at``, a zero nearly, on the side of ``heading``."""
    here = expansion_at(system, at)
    if not here.sound:
        return None
    square = np.vstack([here.slope, heading])
    right = np.zeros(len(at))
    right[-1] = 1.0
    try:
        along = np.linalg.solve(square, right)
    except np.linalg.LinAlgError:
        return None
    along = along / np.sqrt(along @ along)
    across = beside(along)
    Y = inverse(here.slope @ across)
    if Y is None or not np.isfinite(along).all():
        return None
    bow = across @ (Y @ (here.bend @ along @ along)) / -2
    return TubeAxis(here, along, across, bow, Y)


def beside(direction: Array) -> Array:
    """N directions that make a basis with ``direction``, orthonormal to rounding."""
    u = direction / np.sqrt(direction @ direction)
    k = int(np.argmax(np.abs(u)))
    w = u.copy()
    w[k] += math.copysign(1.0, u[k])
    mirror = np.eye(len(u)) - np.outer(w, w * (2.0 / (w @ w)))
    return np.asarray(np.delete(mirror, k, axis=1))


def inverse(matrix: Array) -> Array | None:
    """The inverse, nearly; None where there is none."""
    try:
        result = np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        return None
    return np.asarray(result, np.float64) if np.isfinite(result).all() else None
