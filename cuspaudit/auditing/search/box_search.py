"""A path inside the limits of six joints, searched in floating point.

Random postures inside the limits give poses that are reached for certain; of the other
postures of each pose all windings inside the limits are taken. Two different postures
of one pose with one sign of det J are a couple if the joints that move no det J, the
first and the last, can follow: a turning one needs a range longer than its shortest
turn, a sliding one a range longer than its way. A couple is joined in the box of the
joints that move det J. Uphill of |det J|, confined to the box, each end leads to a
maximum; maxima, and points high up between them, are joined by straight lines on which
det J keeps its sign, as a box is convex; the widest of these ways is taken, and what a
straight line replaces is left out. What is proposed is proved, or not, afterwards.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise, product

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import shortest_turn
from cuspaudit.auditing.search.cusps import Interval, TaskMap
from cuspaudit.auditing.search.postures_inside import postures_inside
from cuspaudit.auditing.search.widest_ways import WidestWays
from cuspaudit.robot.chain import Chain
from cuspaudit.runtime.clock import check_time

__all__ = ["paths_inside"]

Array = NDArray[np.float64]

_POSES = 48
_HIGH = 160
_DRAWN = 1200
_CLIMBS = 24
_NEIGHBORS = 14
_SAMPLES = 24
_FINE = 160
_STRIDE = 0.25
_STEP = 1e-5
_WINDINGS = 16
_FEW = 3
_COUPLES = 96
_APART = 1e-3
_KEPT = 0.6
_TURN = 2 * math.pi


def paths_inside(
    chain: Chain, limits: Sequence[Interval], seed: int = 0
) -> Iterator[Array]:
    """Paths (m, 6) inside the limits between two postures of one pose, widest first.

    Args:
        chain: six joints, task "pose".
        limits: of each joint, or None.
        seed: of the random postures.
    """
    box = _Box(chain, limits)
    rng = np.random.default_rng(seed)
    couples = _couples(box, chain, rng)
    if not couples:
        return
    ends = np.array([[a[box.moving], b[box.moving]] for a, b in couples])
    flat = ends.reshape(-1, ends.shape[-1])
    hubs = box.climbed(flat)
    nodes = np.vstack([flat, hubs, box.high(rng)])
    ways = WidestWays(len(nodes))
    for i, j, level in _edges(box, nodes, len(flat)):
        ways.join(i, j, level)
    levels = ways.levels([(2 * k, 2 * k + 1) for k in range(len(couples))])
    for k in np.argsort(-levels):
        if not levels[k] > 0:
            return
        check_time("limits: search")
        order = ways.between(2 * k, 2 * k + 1)
        path = box.shortened(box.unrolled(nodes[order]))
        yield box.lifted(couples[k], path)


class _Box:
    """The joints that move det J, inside their limits."""

    def __init__(self, chain: Chain, limits: Sequence[Interval]) -> None:
        self.map = TaskMap(chain)
        self.limits = list(limits)
        self.moving = self.map.moving
        self.outer = [k for k in range(len(limits)) if k not in self.moving]
        inner = [limits[k] for k in self.moving]
        self.circle = np.array(
            [
                p is None and self.map.turns[k]
                for k, p in zip(self.moving, inner, strict=True)
            ]
        )
        ends = [p or (-math.inf, math.inf) for p in inner]
        self.low, self.high_end = np.array(ends).T
        reach = np.where(self.map.turns[self.moving], math.pi, 2 * self.map.size)
        self.start = np.where(np.isfinite(self.low), self.low, -reach)
        self.end = np.where(np.isfinite(self.high_end), self.high_end, reach)
        self.margin = 1e-3 * (self.end - self.start)

    def heights(self, points: Array) -> Array:
        """Det J at points (..., p) of the inner joints, lengths in units of the arm."""
        flat = points.reshape(-1, points.shape[-1])
        q = np.zeros((len(flat), len(self.limits)))
        q[:, self.moving] = flat
        return self.map.determinants(q).reshape(points.shape[:-1])

    def drawn(self, rng: np.random.Generator, count: int) -> Array:
        """Random points inside."""
        low, high = self.start + self.margin, self.end - self.margin
        return rng.uniform(low, high, (count, len(low)))

    def high(self, rng: np.random.Generator) -> Array:
        """Random points where |det J| is large, of both signs."""
        points = self.drawn(rng, _DRAWN)
        heights = self.heights(points)
        parts = []
        for sign in (1, -1):
            own = points[sign * heights > 0]
            best = np.argsort(-np.abs(self.heights(own)))[: _HIGH // 2]
            parts.append(own[best])
        return np.vstack(parts)

    def climbed(self, points: Array) -> Array:
        """Where ascents of log |det J| confined to the box end, one of each place."""
        points, stride = points.copy(), np.full(len(points), _STRIDE)
        height = np.abs(self.heights(points))
        sign = np.sign(self.heights(points))
        shifts = _STEP * np.eye(points.shape[1])
        for _ in range(_CLIMBS):
            check_time("limits: search")
            sides = np.stack([points + e for e in (*shifts, *-shifts)])
            values = sign * self.heights(sides)
            count = len(shifts)
            slope = (values[:count] - values[count:]).T
            length = np.linalg.norm(slope, axis=1, keepdims=True)
            moved = points + stride[:, None] * slope / (length + 1e-300)
            moved = np.clip(moved, self.low + self.margin, self.high_end - self.margin)
            value = sign * self.heights(moved)
            up = value > height
            points = np.where(up[:, None], moved, points)
            height = np.where(up, value, height)
            stride = np.where(up, stride * 1.2, stride / 3)
        return self._distinct(points)

    def _distinct(self, points: Array) -> Array:
        kept: list[Array] = []
        for point in points:
            if not any(np.abs(self.way(point, other)).max() < 0.05 for other in kept):
                kept.append(point)
        return np.array(kept)

    def way(self, start: Array, end: Array) -> Array:
        """From one point to another: the short way round on circles."""
        straight = end - start
        return np.where(self.circle, shortest_turn(straight), straight)

    def lowest(self, start: Array, way: Array, samples: int = _SAMPLES) -> Array:
        """The smallest |det J| on segments (m, p), 0 where its sign changes."""
        shares = np.linspace(0, 1, samples)[:, None, None]
        values = self.heights(start + shares * way)
        one = (values > 0).all(0) | (values < 0).all(0)
        return np.where(one, np.abs(values).min(0), 0.0)

    def unrolled(self, points: Array) -> Array:
        """The same points, each a short way from the one before."""
        found = [points[0]]
        for point in points[1:]:
            found.append(found[-1] + self.way(found[-1], point))
        return np.array(found)

    def shortened(self, path: Array) -> Array:
        """The path without what straight lines replace, hardly lower."""
        starts, ways = path[:-1], np.diff(path, axis=0)
        floor = _KEPT * float(self.lowest(starts, ways, _FINE).min())
        kept, at = [path[0]], 0
        while at < len(path) - 1:
            ahead = path[at + 1 :]
            start = np.broadcast_to(path[at], ahead.shape)
            good = np.flatnonzero(self.lowest(start, ahead - path[at], _FINE) >= floor)
            at += 1 + int(good.max(initial=0))
            kept.append(path[at])
        return np.array(kept)

    def lifted(self, couple: tuple[Array, Array], inner: Array) -> Array:
        """The path of all joints; the outer ones go evenly about their middles."""
        first, last = couple
        length = np.abs(np.diff(inner, axis=0)).max(1)
        share = np.r_[0.0, np.cumsum(length)] / max(length.sum(), 1e-300)
        path = np.zeros((len(inner), len(self.limits)))
        path[:, self.moving] = inner
        for k in self.outer:
            way = self.shift(first, last, k)
            pair = self.limits[k]
            middle = first[k] + way / 2 if pair is None else (pair[0] + pair[1]) / 2
            path[:, k] = middle + (share - 0.5) * way
        return path

    def shift(self, first: Array, last: Array, k: int) -> float:
        """How far an outer joint has to go, the short way."""
        way = last[k] - first[k]
        return float(shortest_turn(np.array(way))) if self.map.turns[k] else float(way)

    def follows(self, first: Array, last: Array) -> bool:
        """Whether the outer joints have room for what a couple asks."""
        return all(
            pair is None or abs(self.shift(first, last, k)) < pair[1] - pair[0]
            for k, pair in ((k, self.limits[k]) for k in self.outer)
        )

    def windings(self, posture: Array) -> list[Array]:
        """The posture in each winding inside the limits of the inner joints."""
        choices = []
        for k in self.moving:
            pair, value = self.limits[k], float(posture[k])
            if pair is None:
                choices.append([value])
            elif not self.map.turns[k]:
                choices.append([value] if pair[0] < value < pair[1] else [])
            else:
                first = math.ceil((pair[0] - value) / _TURN)
                last = math.floor((pair[1] - value) / _TURN)
                turns = [value + _TURN * n for n in range(first, last + 1)]
                choices.append([v for v in turns if pair[0] < v < pair[1]])
        found = []
        for values in list(product(*choices))[:_WINDINGS]:
            winding = posture.copy()
            winding[self.moving] = values
            found.append(winding)
        return found


def _couples(
    box: _Box, chain: Chain, rng: np.random.Generator
) -> list[tuple[Array, Array]]:
    """Different postures of one pose, of one sign of det J, inside the limits."""
    starts = np.zeros((_POSES, len(box.limits)))
    starts[:, box.moving] = box.drawn(rng, _POSES)
    found: list[tuple[Array, Array]] = []
    for postures in postures_inside(chain, box.limits, starts, rng):
        if len(postures) < 2:
            continue
        signs = np.sign(box.heights(postures[:, box.moving]))
        windings = [box.windings(q) for q in postures]
        for i, j in combinations(range(len(postures)), 2):
            if signs[i] == signs[j]:
                pairs = list(product(windings[i], windings[j]))
                chosen = rng.permutation(len(pairs))[:_FEW]
                found += [pairs[k] for k in chosen if box.follows(*pairs[k])]
    return [found[k] for k in rng.permutation(len(found))[:_COUPLES]]


def _edges(box: _Box, nodes: Array, ends: int) -> Iterator[tuple[int, int, float]]:
    """Straight lines between near nodes on which det J keeps its sign, and couples."""
    away = np.abs(box.way(nodes[:, None], nodes[None])).max(-1)
    sign = np.sign(box.heights(nodes))
    away[sign[:, None] != sign[None]] = np.inf
    np.fill_diagonal(away, np.inf)
    near = np.argsort(away, axis=1)[:, :_NEIGHBORS]
    pairs = {
        (min(i, int(j)), max(i, int(j)))
        for i, row in enumerate(near)
        for j in row
        if np.isfinite(away[i, j])
    }
    pairs |= {(k, k + 1) for k in range(0, ends, 2)}
    for part in _batches(sorted(pairs)):
        check_time("limits: search")
        start = nodes[part[:, 0]]
        levels = box.lowest(start, box.way(start, nodes[part[:, 1]]))
        for (i, j), level in zip(part.tolist(), levels.tolist(), strict=True):
            if level > 0:
                yield i, j, level


def _batches(pairs: list[tuple[int, int]]) -> Iterator[NDArray[np.int64]]:
    for start, stop in pairwise([*range(0, len(pairs), 1000), len(pairs)]):
        yield np.array(pairs[start:stop])
