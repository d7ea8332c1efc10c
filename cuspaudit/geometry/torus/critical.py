"""Critical points of a function on a torus, and ways uphill, in floating point.

A search: nothing here is proved. What rests on it is checked by other means: the
components by ``geometry.torus.components``, a path by its certificate.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cuspaudit.geometry.torus.function import TorusFunction

__all__ = ["ascents", "critical_points", "shortest_turn"]

Array = NDArray[np.float64]

_NEWTON_STEPS = 60
_LONGEST_STEP = 0.5
_CONVERGED = 1e-12
_ABOVE_ZERO = 1e-7
_SAME = 1e-6
_CLIMB_STEPS = 400
_STRIDE = 0.1
_FLAT = 1e-9
_PUSH = 1e-3
_PUSHES = 4


def critical_points(h: TorusFunction, starts: Array) -> Array:
    """Critical points with h != 0 that Newton's method finds from ``starts``, (m, k).

    Distinct, in [-pi, pi); |h| there is at least 1e-7 of its bound.
    """
    x, found = starts, [np.empty((0, h.dimension))]
    for _ in range(_NEWTON_STEPS):
        slope, bend = h.gradient(x), h.hessian(x)
        done = np.abs(slope).max(1) < _CONVERGED * h.size
        found.append(x[done])
        x, slope, bend = x[~done], slope[~done], bend[~done]
        if not len(x):
            break
        # a tiny multiple of 1 keeps exactly singular Hessians solvable
        bend = bend + 1e-14 * h.size * np.eye(h.dimension)
        step = np.linalg.solve(bend, slope[..., None])[..., 0]
        length = np.linalg.norm(step, axis=1, keepdims=True)
        x = x - step * np.minimum(1, _LONGEST_STEP / (length + 1e-300))
    points = np.concatenate(found)
    points = points[np.abs(h(points)) > _ABOVE_ZERO * h.size]
    return _distinct(shortest_turn(points))


def ascents(h: TorusFunction, starts: Array) -> list[Array]:
    """Ways of rising |h| from ``starts`` (m, k) to maxima.

    Each (steps, k), steps at most 0.1 rad, angles not reduced. An ascent that ends at
    a saddle, as happens inside a plane of symmetry, is pushed off it and goes on.
    """
    ways = _climb(h, starts)
    for _ in range(_PUSHES):
        ends = np.array([way[-1] for way in ways]).reshape(starts.shape)
        values, vectors = np.linalg.eigh(_bend(h, ends))
        stuck = np.flatnonzero(values[:, -1] > _FLAT * h.size)
        if not len(stuck):
            break
        pushed = ends[stuck] + _PUSH * vectors[stuck, :, -1]
        for i, more in zip(stuck, _climb(h, pushed), strict=True):
            ways[i] = np.concatenate([ways[i], more])
    return ways


def _bend(h: TorusFunction, points: Array) -> Array:
    """The Hessians of |h|."""
    return h.hessian(points) * np.sign(h(points))[:, None, None]


def _climb(h: TorusFunction, starts: Array) -> list[Array]:
    """Ways of rising |h| to where it is flat."""
    x, sign = starts.copy(), np.sign(h(starts))
    stride, height = np.full(len(x), _STRIDE), np.abs(h(starts))
    ways = [x.copy()]
    for _ in range(_CLIMB_STEPS):
        slope = sign[:, None] * h.gradient(x)
        length = np.linalg.norm(slope, axis=1)
        active = (length > _FLAT * h.size) & (stride > _SAME)
        if not active.any():
            break
        new = x + (stride * active / (length + 1e-300))[:, None] * slope
        value = sign * h(new)
        up = active & (value > height)
        x, height = np.where(up[:, None], new, x), np.where(up, value, height)
        stride = np.where(up, np.minimum(1.3 * stride, _STRIDE), stride / 3)
        ways.append(x.copy())
    history = np.array(ways)
    moved = [np.abs(np.diff(way, axis=0)).max(1) > 0 for way in history.swapaxes(0, 1)]
    return [
        np.concatenate([history[:1, i], history[1:, i][moved[i]]])
        for i in range(len(starts))
    ]


def shortest_turn(angles: Array) -> Array:
    """``angles`` reduced to [-pi, pi)."""
    return np.asarray(np.remainder(angles + np.pi, 2 * np.pi) - np.pi)


def _distinct(points: Array) -> Array:
    """One of each group of points that agree to 1e-6, by sorting on a circle each."""
    kept: list[Array] = []
    for point in points[np.lexsort(points.round(4).T)]:
        others = np.array(kept).reshape(-1, points.shape[1])
        if not (np.abs(shortest_turn(others - point)).max(1) < _SAME).any():
            kept.append(point)
    return np.array(kept).reshape(-1, points.shape[1])
