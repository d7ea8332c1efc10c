"""A path round a cusp, between two postures of one pose, in floating point.

Near a cusp the map is (x^3 + x y, y, ...), and det J = 3 x^2 + y up to a factor of one
sign. So from the cusp one goes against the gradient of det J to some y < 0, and along
the kernel to x = sqrt(-y) and x = -sqrt(-y): two postures of one pose up to what the
coordinates bend, which Newton's method mends. The way from one to the other leads over
a point on the other side of the cusp, y > 0. The farther one goes the clearer is the
path; the sizes are tried from the largest down.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.search.cusps import Interval, TaskMap
from cuspaudit.auditing.search.lift import close
from cuspaudit.errors import RetryableError
from cuspaudit.robot.chain import Chain

__all__ = ["is_inside", "paths_around", "slack_of"]

Array = NDArray[np.float64]

_SIZES = (1.2, 0.8, 0.5, 0.35, 0.25, 0.15, 0.1, 0.06, 0.03, 0.01, 0.003, 0.001)
_BEYOND = (1.0, 0.5)
_SPREAD = (1.0, 0.75)
_SAMPLES = 40
_APART = 1e-3
_LEVEL = 0.004


def paths_around(
    chain: Chain, cusp: Sequence[float], limits: Sequence[Interval]
) -> Iterator[Array]:
    """Paths of three way points inside the limits whose ends have one pose.

    Sampled, det J keeps its sign along each; the largest come first.
    """
    map_, middle = TaskMap(chain), np.array(cusp)
    rise, along, bend = _directions(map_, middle)
    for size in _SIZES:
        base = middle - size * rise
        depth = abs(float(map_.conditions(base[None])[0][0, 0]))
        reach = np.sqrt(6 * depth / bend) * along
        for beyond in _BEYOND:
            for spread in _SPREAD:
                via = middle + beyond * size * rise
                path = np.array([base - spread * reach, via, base + spread * reach])
                proposal = _closed(chain, map_, path, limits)
                if proposal is not None:
                    yield proposal


def _directions(map_: TaskMap, middle: Array) -> tuple[Array, Array, float]:
    """Where det J rises from the cusp, the kernel, and the bend of det J along it.

    The sign is that in which the bend is positive; the first is a unit vector.
    """
    _, slope = map_.slopes(middle[None])
    *_, k, _ = map_.decomposed(middle[None])
    along = k[0]
    bend = float(slope[0, 1] @ along[map_.moving])
    # g is the slope of f along k up to the sign of u: take it from f itself
    step = 1e-3
    ends = np.array([middle - step * along, middle, middle + step * along])
    f = map_.conditions(ends)[0][:, 0]
    second = (f[0] - 2 * f[1] + f[2]) / step**2
    rise = np.zeros(len(middle))
    rise[map_.moving] = slope[0, 0] * np.sign(second)
    return rise / np.linalg.norm(rise), along, max(abs(bend), 1e-9)


def _closed(
    chain: Chain, map_: TaskMap, path: Array, limits: Sequence[Interval]
) -> Array | None:
    """The path with its ends in one pose, if it is one that may be proved."""
    own = [pair if k in map_.moving else None for k, pair in enumerate(limits)]
    if not is_inside(path, own) or not _keeps_sign(map_, path[[0, 1]]):
        return None
    try:
        path = close(chain, _centred(close(chain, path), map_))
    except RetryableError:
        return None
    moved = np.abs(path[-1] - path[0])
    turned = np.abs(np.remainder(moved + np.pi, 2 * np.pi) - np.pi)
    if max(turned) < _APART or not is_inside(path, limits):
        return None
    return path if _keeps_sign(map_, path) else None


def _centred(path: Array, map_: TaskMap) -> Array:
    """The path with the joints that move no det J going from one side to the other.

    They shift both ends alike, so only the difference of their end values counts; it is
    shared by the two halves of the path, about the value at the cusp.
    """
    path = path.copy()
    for k in set(range(path.shape[1])) - set(map_.moving):
        way = path[-1, k] - path[0, k]
        if map_.turns[k]:
            way = np.remainder(way + np.pi, 2 * np.pi) - np.pi
        path[:, k] = path[1, k] + way * np.linspace(-0.5, 0.5, len(path))
    return path


def _keeps_sign(map_: TaskMap, path: Array) -> bool:
    """Whether det J, sampled, has one sign and stays away from 0 on the path."""
    shares = np.linspace(0, 1, _SAMPLES)[:, None]
    points = np.vstack([a + shares * (b - a) for a, b in pairwise(path)])
    heights = map_.conditions(points)[0][:, 0]
    sizes = np.abs(heights)
    one_sign = (heights > 0).all() or (heights < 0).all()
    return bool(one_sign and sizes.min() > _LEVEL * sizes.max())


def is_inside(path: Array, limits: Sequence[Interval]) -> bool:
    """Whether all way points lie inside the limits."""
    return slack_of(path, limits) > 0


def slack_of(path: Array, limits: Sequence[Interval]) -> float:
    """The distance of the way points to the nearest limit; inf without limits."""
    nearest = np.inf
    for column, pair in zip(np.atleast_2d(path).T, limits, strict=False):
        if pair is not None:
            nearest = min(nearest, column.min() - pair[0], pair[1] - column.max())
    return float(nearest)
