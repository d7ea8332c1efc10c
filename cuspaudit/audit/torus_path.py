"""Paths on the torus of joints 2 to 5 that keep h = det J away from zero.

A search in floating point: what it finds is proposed, and proved or refused by its
certificate. Points are (..., 4) angles, paths (m, 4) way points, not reduced modulo
2 pi. Everything is asked for the sign s of h; its height at x is s h(x).
"""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from cuspaudit.kinematics.torus_determinant import TorusDeterminant

__all__ = ["Ridge", "ascents", "height_of", "straight", "tidy"]

Array = NDArray[np.float64]

_SAMPLES = 48
_FINE = 200
_SPACING = 0.01
_STEPS = 60
_STRIDE = 0.2
_EQUAL = 0.05
_MOST_PEAKS = 24
_KEEP = 0.9
_CUTS = 2
_TURNS = np.array(list(product((0, 1), repeat=4)), dtype=np.float64)


def _lowest(
    h: TorusDeterminant, sign: Array, start: Array, end: Array, samples: int = _SAMPLES
) -> Array:
    """The smallest sampled s h on segments (..., 4) to (..., 4): (...)."""
    t = np.linspace(0.0, 1.0, samples)[:, None]
    points = start[..., None, :] + t * (end - start)[..., None, :]
    return np.asarray((sign[..., None] * h(points)).min(-1))


def straight(
    h: TorusDeterminant, sign: Array, start: Array, end: Array
) -> tuple[Array, Array]:
    """The best straight path of each pair: its end (..., 4) and lowest s h on it.

    Each joint may turn the short way or the long way round: sixteen paths a pair.
    """
    short = np.remainder(end - start + np.pi, 2 * np.pi) - np.pi
    long = short - 2 * np.pi * np.where(short > 0, 1.0, -1.0)
    moves = short[..., None, :] * (1 - _TURNS) + long[..., None, :] * _TURNS
    begin = np.broadcast_to(start[..., None, :], moves.shape)
    low = _lowest(h, sign[..., None], begin, begin + moves)
    best = low.argmax(-1)[..., None]
    chosen = np.take_along_axis(moves, best[..., None], -2)[..., 0, :]
    return start + chosen, np.take_along_axis(low, best, -1)[..., 0]


def height_of(h: TorusDeterminant, sign: float, path: Array) -> float:
    """The smallest s h on a path, sampled every 0.01 rad."""
    step = np.diff(path, axis=0)
    counts = np.ceil(np.linalg.norm(step, axis=1) / _SPACING).astype(int) + 1
    which = np.repeat(np.arange(len(step)), counts)
    share = (np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)) / (
        np.repeat(counts, counts)
    )
    points = path[which] + share[:, None] * step[which]
    return float((sign * h(np.vstack([points, path[-1]]))).min())


def ascents(h: TorusDeterminant, points: Array) -> Array:
    """Ways uphill of |h| from points (n, 4): (steps, n, 4), the last ones near maxima.

    Each step of at most 0.2 rad follows the gradient; it is halved for a point whose
    |h| it would lower.
    """
    stride = np.full(len(points), _STRIDE)
    height, ways = np.abs(h(points)), [points]
    sign = np.sign(h(points))
    for _ in range(_STEPS):
        slope = sign[:, None] * h.gradient(points)
        norm = np.linalg.norm(slope, axis=1) + 1e-300
        new = points + (stride / norm)[:, None] * slope
        value = sign * h(new)
        up = value > height
        points = np.where(up[:, None], new, points)
        height = np.where(up, value, height)
        stride = np.where(up, np.minimum(1.3 * stride, _STRIDE), stride / 3)
        ways.append(points)
    return np.array(ways)


class Ridge:
    """Maxima of |h| of one sign and the straight ways between them.

    Attributes:
        h: the determinant.
        sign: of h.
        peaks: (n, 4) maxima, distinct modulo 2 pi.
    """

    def __init__(self, h: TorusDeterminant, sign: float, peaks: Array) -> None:
        """Try the straight ways between all of the distinct ``peaks``."""
        self.h, self.sign = h, sign
        self.peaks = _distinct(peaks)[:_MOST_PEAKS]
        n = len(self.peaks)
        start = np.broadcast_to(self.peaks[:, None], (n, n, 4))
        end = np.broadcast_to(self.peaks[None], (n, n, 4))
        target, self._low = straight(h, np.full((n, n), sign), start, end)
        self._move = target - start
        self._via = _widest(self._low)

    def paths(self, start: Array, end: Array) -> list[Array]:
        """Paths between points (m, 4): uphill, along the ridge, downhill."""
        up, down = ascents(self.h, start), ascents(self.h, end)
        tops = self._nearest(up[-1]), self._nearest(down[-1])
        return [
            self._path(up[:, k], down[::-1, k], int(i), int(j))
            for k, (i, j) in enumerate(zip(*tops, strict=True))
        ]

    def _nearest(self, points: Array) -> NDArray[np.int64]:
        return np.asarray(_apart(points[:, None], self.peaks[None]).argmin(-1))

    def _way(self, i: int, j: int) -> list[tuple[int, int]]:
        """The straight ways that lead from peak i to peak j."""
        if i == j:
            return []
        middle = int(self._via[i, j])
        if middle < 0:
            return [(i, j)]
        return self._way(i, middle) + self._way(middle, j)

    def _path(self, up: Array, down: Array, i: int, j: int) -> Array:
        """One path; where it passes a peak it may turn whole turns further."""
        moves = [self._move[leg] for leg in self._way(i, j)]
        ridge = self.peaks[i] + np.cumsum([np.zeros(4), *moves], axis=0)
        ridge = ridge + _turns(up[-1] - ridge[0])
        return np.vstack([up, ridge, down + _turns(ridge[-1] - down[0])])


def tidy(h: TorusDeterminant, sign: float, path: Array) -> Array:
    """A shorter and smoother path with the same ends, hardly lower than ``path``.

    Way points are left out where the straight way is high enough, then corners are
    cut off (Chaikin), which moves no end.
    """
    floor = _KEEP * height_of(h, sign, path)
    path = _shortened(h, sign, path, floor)
    for _ in range(_CUTS if len(path) > 2 else 0):
        cut = _corners_cut(path)
        if height_of(h, sign, cut) < floor:
            break
        path = cut
    return path


def _shortened(h: TorusDeterminant, sign: float, path: Array, floor: float) -> Array:
    kept, at = [path[0]], 0
    while at < len(path) - 1:
        ahead = path[at + 1 :]
        start, signs = np.broadcast_to(path[at], ahead.shape), np.full(len(ahead), sign)
        high = _lowest(h, signs, start, ahead, _FINE) >= floor
        at += 1 + int(np.nonzero(high)[0].max(initial=0))
        kept.append(path[at])
    return np.array(kept)


def _corners_cut(path: Array) -> Array:
    before, after = path[:-1], path[1:]
    near, far = 0.75 * before + 0.25 * after, 0.25 * before + 0.75 * after
    inner = np.stack([near, far], axis=1).reshape(-1, 4)[1:-1]
    return np.vstack([path[0], inner, path[-1]])


def _turns(apart: Array) -> Array:
    """The whole turns nearest to differences of angles."""
    return np.asarray(2 * np.pi * np.round(apart / (2 * np.pi)))


def _widest(low: Array) -> NDArray[np.int64]:
    """Raise ``low`` to the widest ways; the peak each goes by, -1 for none."""
    via = np.full(low.shape, -1)
    for k in range(len(low)):
        through = np.minimum(low[:, k, None], low[None, k])
        better = through > low
        low[better], via[better] = through[better], k
    return via


def _distinct(points: Array) -> Array:
    kept: list[Array] = []
    for point in points:
        if not kept or _apart(np.array(kept), point).min() > _EQUAL:
            kept.append(point)
    return np.array(kept).reshape(-1, 4)


def _apart(a: Array, b: Array) -> Array:
    """The largest difference of an angle, modulo 2 pi."""
    return np.asarray(np.abs(np.remainder(a - b + np.pi, 2 * np.pi) - np.pi).max(-1))
