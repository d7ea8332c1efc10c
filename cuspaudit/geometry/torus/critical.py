"""Critical points of a function on a torus, and ways uphill, in floating point.

A search: nothing here is proved. What rests on it is checked by other means: the
components by ``geometry.torus.components``, a path by its certificate.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import separation, shortest_turn
from cuspaudit.runtime.clock import check_time

__all__ = [
    "FAST",
    "FINE",
    "Pace",
    "TorusHeight",
    "ascents",
    "climb",
    "critical_points",
    "critical_sheets",
]

Array = NDArray[np.float64]
Solve = Callable[[Array, Array], Array]

_NEWTON_STEPS = 60
_LONGEST_STEP = 0.5
_CONVERGED = 1e-12
_ABOVE_ZERO = 1e-7
_SAME = 1e-6
_FLAT = 1e-9
_PUSH = 1e-3
_PUSHES = 4
_SHEET_STEPS = 40
_SHEET_STEP = 0.3
_SETTLED = 1e-7
_RCOND = 1e-3
_LOWEST = 1e-12


class TorusHeight(Protocol):
    """A function h on a torus T^k, at many points (..., k) at once."""

    @property
    def dimension(self) -> int:
        """The dimension k."""

    @property
    def size(self) -> float:
        """A bound of |h|."""

    def __call__(self, points: Array) -> Array:
        """The values."""

    def gradient(self, points: Array) -> Array:
        """The gradients, (..., k)."""

    def hessian(self, points: Array) -> Array:
        """The Hessian matrices, (..., k, k)."""


@dataclass(frozen=True)
class Pace:
    """How one climbs.

    Attributes:
        steps: the most steps.
        first: the length of the first step, rad.
        longest: the largest length of a step, rad.
        flat: a point whose slope is at most this part of the bound of |h| stays.
    """

    steps: int
    first: float
    longest: float
    flat: float = 0.0


FINE = Pace(400, 0.1, 0.1, _FLAT)
"""To the maximum, in steps whose way can be followed."""
FAST = Pace(60, 0.02, 0.2)
"""Near to the maximum, soon."""


def critical_points(h: TorusHeight, starts: Array) -> Array:
    """Critical points with h != 0 that Newton's method finds from ``starts``, (m, k).

    Distinct, in [-pi, pi); |h| there is at least 1e-7 of its bound.
    """
    # a tiny multiple of 1 keeps exactly singular Hessians solvable
    shift = 1e-14 * h.size * np.eye(h.dimension)

    def solve(bend: Array, slope: Array) -> Array:
        return np.asarray(np.linalg.solve(bend + shift, slope[..., None])[..., 0])

    found, x = [np.empty((0, h.dimension))], starts
    for _ in range(_NEWTON_STEPS):
        check_time("critical points")
        done = np.abs(h.gradient(x)).max(1) < _CONVERGED * h.size
        found.append(x[done])
        x = x[~done]
        if not len(x):
            break
        x, _ = _newton_step(h, x, solve, _LONGEST_STEP)
    points = np.concatenate(found)
    points = points[np.abs(h(points)) > _ABOVE_ZERO * h.size]
    return _distinct(shortest_turn(points))


def critical_sheets(h: TorusHeight, starts: Array) -> Array:
    """Critical points with h != 0, those of whole sheets of them too, from ``starts``.

    Pseudo-inverses make Newton's method settle as well where critical points are not
    isolated. Not distinct, and not reduced modulo 2 pi.
    """

    def solve(bend: Array, slope: Array) -> Array:
        inverse = np.linalg.pinv(bend, rcond=_RCOND, hermitian=True)
        return np.asarray((inverse @ slope[..., None])[..., 0])

    points, settled = starts, np.zeros(len(starts))
    for _ in range(_SHEET_STEPS):
        check_time("critical points")
        points, settled = _newton_step(h, points, solve, _SHEET_STEP)
    height = np.abs(h(points))
    good = (settled < _SETTLED) & (height > _LOWEST * height.max(initial=0.0))
    return np.asarray(points[good])


def _newton_step(
    h: TorusHeight, points: Array, solve: Solve, longest: float
) -> tuple[Array, Array]:
    """The points after a step of at most ``longest``, and how long a full one was."""
    step = solve(h.hessian(points), h.gradient(points))
    length = np.linalg.norm(step, axis=1)
    shrink = np.minimum(1.0, longest / np.maximum(length, _LOWEST))
    return points - step * shrink[:, None], length


def ascents(h: TorusHeight, starts: Array) -> list[Array]:
    """Ways of rising |h| from ``starts`` (m, k) to maxima.

    Each (steps, k), steps at most 0.1 rad, angles not reduced. An ascent that ends at
    a saddle, as happens inside a plane of symmetry, is pushed off it and goes on.
    """
    ways = _moving(climb(h, starts, FINE))
    for _ in range(_PUSHES):
        ends = np.array([way[-1] for way in ways]).reshape(starts.shape)
        bend = h.hessian(ends) * np.sign(h(ends))[:, None, None]
        values, vectors = np.linalg.eigh(bend)
        stuck = np.flatnonzero(values[:, -1] > _FLAT * h.size)
        if not len(stuck):
            break
        pushed = ends[stuck] + _PUSH * vectors[stuck, :, -1]
        for i, more in zip(stuck, _moving(climb(h, pushed, FINE)), strict=True):
            ways[i] = np.concatenate([ways[i], more])
    return ways


def climb(h: TorusHeight, starts: Array, pace: Pace) -> Array:
    """Ways of rising |h| from ``starts`` (m, k): (steps, m, k).

    Steps follow the gradient; they grow, and shrink for a point whose |h| they would
    lower. The ways end before the most steps when all points stay.
    """
    x, sign = starts.copy(), np.sign(h(starts))
    stride, height = np.full(len(x), pace.first), np.abs(h(starts))
    ways = [x]
    for _ in range(pace.steps):
        check_time("ascents")
        slope = sign[:, None] * h.gradient(x)
        length = np.linalg.norm(slope, axis=1) + 1e-300
        active = np.ones(len(x), dtype=bool)
        if pace.flat:
            active = (length > pace.flat * h.size) & (stride > _SAME)
            if not active.any():
                break
        new = x + (stride * active / length)[:, None] * slope
        value = sign * h(new)
        up = active & (value > height)
        x, height = np.where(up[:, None], new, x), np.where(up, value, height)
        stride = np.where(up, np.minimum(1.3 * stride, pace.longest), stride / 3)
        ways.append(x)
    return np.array(ways)


def _moving(history: Array) -> list[Array]:
    """Each way without the steps in which its point stayed."""
    moved = [np.abs(np.diff(way, axis=0)).max(1) > 0 for way in history.swapaxes(0, 1)]
    return [
        np.concatenate([history[:1, i], history[1:, i][moved[i]]])
        for i in range(history.shape[1])
    ]


def _distinct(points: Array) -> Array:
    """One of each group of points that agree to 1e-6, by sorting on a circle each."""
    kept: list[Array] = []
    for point in points[np.lexsort(points.round(4).T)]:
        others = np.array(kept).reshape(-1, points.shape[1])
        if not (separation(others, point).max(1) < _SAME).any():
            kept.append(point)
    return np.array(kept).reshape(-1, points.shape[1])
