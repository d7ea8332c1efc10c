"""Maxima of |h| on the torus of joints 2 to 5 and the widest ways between them.

Two maxima of one sign are joined by the two ascents from a pass, a critical point of h
with a direction in which |h| rises both ways; its height is the clearance of that way
[mathematics 4, routing]. The critical points are those of `critical_sheets`: where two
factors of h nearly vanish together there is a whole sheet of passes, as low as the
arm's numbers are off the ones for which h would factor.

In floating point and incomplete: what is found is proposed, and proved elsewhere.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import beside, separation
from cuspaudit.auditing.search.torus_determinant import TorusDeterminant
from cuspaudit.auditing.search.torus_path import straight
from cuspaudit.geometry.torus.critical import FAST, climb

__all__ = ["Ridge"]

Array = NDArray[np.float64]

_SETTLED = 1e-7
_STRAIGHT = 0.02
_BESIDE = 0.02
_EQUAL = 0.05
_MOST_PEAKS = 24
_MOST_PASSES = 96


class Ridge:
    """The maxima of |h| of one sign and the ways between them.

    Attributes:
        h: the determinant.
        sign: of h.
        peaks: (n, 4) where ascents end, distinct modulo 2 pi, the highest first:
            maxima, and where h is symmetric also passes between them.
    """

    def __init__(self, h: TorusDeterminant, sign: float, critical: Array) -> None:
        """Take the critical points of this sign for peaks and passes."""
        self.h, self.sign = h, sign
        own = critical[sign * h(critical) > 0]
        own = own[np.argsort(-sign * h(own))]
        rise, direction = _steepest(h, sign, own)
        flat = rise <= _SETTLED * np.abs(h(own)).max(initial=0.0)
        passes = _distinct(own[~flat], _MOST_PASSES)
        _, direction = _steepest(h, sign, passes)
        off = np.vstack([passes - _BESIDE * direction, passes + _BESIDE * direction])
        ways = climb(h, off, FAST)
        tops = np.vstack([own[flat], ways[-1]])
        tops = tops[np.argsort(-sign * h(tops))] if len(tops) else tops
        self.peaks = _distinct(tops, _MOST_PEAKS)
        self._join(passes, ways)

    def _join(self, passes: Array, ways: Array) -> None:
        """Fill the table of ways: straight ones that are high, else over a pass."""
        n, m = len(self.peaks), len(passes)
        self._low: Array = np.zeros((n, n))
        self._ways: dict[tuple[int, int], Array] = {}
        above, below = np.triu_indices(n, 1)
        start, end = self.peaks[above], self.peaks[below]
        target, low = straight(self.h, np.full(len(start), self.sign), start, end)
        floor = _STRAIGHT * np.abs(self.h(self.peaks)).max(initial=0.0)
        for k in np.nonzero(low > floor)[0]:
            way = np.array([start[k], target[k]])
            self._keep(int(above[k]), int(below[k]), float(low[k]), way)
        near = self._nearest(ways[-1]) if n else np.zeros(0, dtype=np.int64)
        for t in range(m if n else 0):
            i, j = int(near[t]), int(near[m + t])
            level = self.sign * float(self.h(passes[t]))
            if i != j and level > self._low[i, j]:
                way = np.vstack([ways[::-1, t], passes[t], ways[:, m + t]])
                self._keep(int(i), int(j), level, way)
        self._via = _widest(self._low)

    def _keep(self, i: int, j: int, level: float, way: Array) -> None:
        self._low[i, j] = self._low[j, i] = level
        self._ways[i, j], self._ways[j, i] = way, way[::-1]

    def levels(self, tops: Array) -> Array:
        """The smallest |h| on the widest way between tops of ascents, (m, m)."""
        near = self._nearest(tops)
        level = self._low.copy()
        np.fill_diagonal(level, np.inf)
        return np.asarray(level[near[:, None], near[None, :]])

    def path(self, up: Array, down: Array) -> Array:
        """Up an ascent, along the widest way, and down another ascent, (k, 4)."""
        i, j = self._nearest(np.array([up[-1], down[0]]))
        path = up
        for leg in self._legs(int(i), int(j)):
            path = np.vstack([path, beside(self._ways[leg], path[-1])])
        return np.vstack([path, beside(down, path[-1])])

    def _nearest(self, points: Array) -> NDArray[np.int64]:
        return np.asarray(
            separation(points[:, None], self.peaks[None]).max(-1).argmin(-1)
        )

    def _legs(self, i: int, j: int) -> list[tuple[int, int]]:
        """The ways that lead from peak i to peak j."""
        if i == j:
            return []
        middle = int(self._via[i, j])
        return [(i, j)] if middle < 0 else self._legs(i, middle) + self._legs(middle, j)


def _steepest(h: TorusDeterminant, sign: float, points: Array) -> tuple[Array, Array]:
    """The largest eigenvalue of the Hessian of s h, and its unit eigenvector."""
    values, vectors = np.linalg.eigh(sign * h.hessian(points))
    return values[..., -1], vectors[..., -1]


def _widest(low: Array) -> NDArray[np.int64]:
    """Raise ``low`` to the widest ways; the peak each goes by, -1 for none."""
    via = np.full(low.shape, -1)
    for k in range(len(low)):
        through = np.minimum(low[:, k, None], low[None, k])
        better = through > low
        low[better], via[better] = through[better], k
    return via


def _distinct(points: Array, most: int) -> Array:
    kept: list[Array] = []
    for point in points:
        if len(kept) == most:
            break
        if not kept or separation(np.array(kept), point).max(-1).min() > _EQUAL:
            kept.append(point)
    return np.array(kept).reshape(-1, 4)
