"""Ascents in floating point: proposals of paths uphill, to be proved elsewhere.

Each step goes, in a tangent chart, along the Newton step of G with the signs of the
eigenvalues made negative (uphill towards a maximum, away from a saddle), cut to a
given length in the norm of |Hess G|. G = log h^2 + ... is a barrier: in that norm the
singular surface stays out of reach. G increases from each way point to the next.
"""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from cuspaudit.geometry.heights.charted_height import ChartedHeight, Tangent
from cuspaudit.runtime.clock import check_time

__all__ = ["climb"]

Array = NDArray[np.float64]

_MOST_STEPS = 400
_FLAT = 1e-9
_NUDGE = 0.05


def climb(
    landscape: ChartedHeight, start: Array, reach: float, chance: Generator
) -> tuple[Array, bool]:
    """Way points from ``start`` uphill, and whether the last is close to a maximum.

    Args:
        landscape: V and G.
        start: a point on V, (n,).
        reach: the length of a step in the norm of |Hess G|, about 1 at most.
        chance: for the direction in which a saddle is left.

    Returns:
        (m, n) way points on V, ``start`` first.
    """
    points = [np.asarray(start, dtype=np.float64)]
    for _ in range(_MOST_STEPS):
        check_time("ascent")
        tangent = landscape.tangent(points[-1])
        gradient, hessian = landscape.slopes(tangent, points[-1])
        if not (np.isfinite(gradient).all() and np.isfinite(hessian).all()):
            return np.array(points), False
        step, rest, at_top = _uphill(gradient, hessian, chance)
        if at_top and rest < _FLAT:
            return np.array(points), True
        moved = _advance(landscape, tangent, points[-1], min(1.0, reach / rest) * step)
        if moved is None:
            return np.array(points), at_top and rest < 1e-6
        points.append(moved)
    return np.array(points), False


def _uphill(
    gradient: Array, hessian: Array, chance: Generator
) -> tuple[Array, float, bool]:
    """The step, its length in the norm of |Hess G|, and whether Hess G < 0."""
    values, vectors = np.linalg.eigh(hessian)
    sizes = np.maximum(np.abs(values), 1e-9 * np.abs(values).max() + 1e-300)
    slopes = vectors.T @ gradient
    steps = slopes / sizes
    length = float(np.sqrt(np.sum(sizes * steps**2)))
    rising = values > 0
    if length < _NUDGE and rising.any():
        signs = np.where(slopes != 0, np.sign(slopes), chance.choice([-1.0, 1.0]))
        steps = steps + np.where(rising, _NUDGE * signs / np.sqrt(sizes), 0.0)
        length = float(np.sqrt(np.sum(sizes * steps**2)))
    return vectors @ steps, max(length, 1e-300), not rising.any()


def _advance(
    landscape: ChartedHeight, tangent: Tangent, point: Array, step: Array
) -> Array | None:
    """The step, halved until G increases without a change of the sign of P."""
    level, sign = landscape.value_at(point), landscape.sign_at(point)
    for _ in range(40):
        moved = landscape.retract(tangent, point + step @ tangent.forms.matrix)
        if (
            moved is not None
            and landscape.sign_at(moved) == sign
            and landscape.value_at(moved) > level
        ):
            return moved
        step = step / 2
    return None
