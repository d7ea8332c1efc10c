"""The search for a witness of a six-joint arm some of whose joints slide.

As for joints that all turn [mathematics 6.2], in floating point: random postures give
poses that are reached, Newton's method meets other postures of each, and two of one
sign of det J are joined straight, or over postures far from singular ones, between
which straight ways are known. Slides are measured in units of the arm's size, and are
looked at a few sizes about 0. What is proposed is proved, or refused, by its
certificate; nothing is decided here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import product

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import FULL_TURN, shortest_turn
from cuspaudit.auditing.evidence import SearchRecord
from cuspaudit.auditing.search.cusps import TaskMap
from cuspaudit.auditing.search.six_joints import PathSearch, Proposal
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.postures.moving import gap
from cuspaudit.robot.chain import Chain

__all__ = ["search_mixed", "way_over_net"]

Array = NDArray[np.float64]
Index = NDArray[np.int64]

_BATCH, _ENOUGH = 8, 32
_STARTS, _NEWTON, _STRIDE = 24, 24, 0.5
_REACHED, _EQUAL = 1e-10, 1e-5
_SAMPLES, _FINE, _CHUNK = 25, 400, 20_000
_RANDOM, _PEAKS, _NEAR = 512, 16, 0.4
_ROUNDING, _WIDE = 1e-6, 0.1
_KEPT = 5


@dataclass(frozen=True, eq=False)
class _Way:
    """A sampled way between two postures of one pose.

    Attributes:
        path: (m, 6) joint values.
        clearance: the smallest |det J| on it over the largest that was met.
    """

    path: Array
    clearance: float


def search_mixed(
    chain: Chain,
    seed: int = 0,
    progress: Callable[[str], None] = lambda step: None,
    most: int = 96,
) -> PathSearch:
    """Look for nonsingular paths between two postures of one pose.

    Args:
        chain: six joints, task "pose"; literal or snapped numbers.
        seed: of the random postures.
        progress: called before each batch of poses; an UnableError it raises ends the
            search, and is kept in the record.
        most: random poses to be tried when no path is met.
    """
    looking = _Looking(chain, seed)
    try:
        progress("search: postures far from singular ones")
        looking.spread()
        while looking.poses < most and not looking.is_done:
            progress(f"search: {looking.poses} poses, {len(looking.ways)} paths")
            looking.look()
    except UnableError as limit:
        looking.stopped = str(limit)
    return looking.result()


def way_over_net(chain: Chain, first: Array, second: Array, seed: int) -> Array | None:
    """A way between two postures of one sign of det J; None where none is met.

    Straight, or over postures far from singular ones. In floating point: proposed.

    Args:
        chain: six joints, task "pose".
        first: joint values.
        second: likewise; the way may end whole turns beside it.
        seed: of the random postures.
    """
    looking = _Looking(chain, seed)
    looking.spread()
    ends = np.array([first, second])
    sign = float(np.sign(looking.heights(ends)[0]))
    target, low = looking.straight(sign, ends[:1], ends[1:])
    if low[0] > 0:
        return np.array([first, target[0]])
    net = looking.nets[sign]
    over = net.path(net.reach(ends), 0, 1)
    return None if over is None else looking.unwound(np.vstack([first, over, second]))


@dataclass(eq=False)
class _Looking:
    """The state of a search."""

    chain: Chain
    seed: int
    poses: int = 0
    pairs: int = 0
    stopped: str | None = None
    counts: Counter[int] = field(default_factory=Counter)
    ways: list[_Way] = field(default_factory=list)
    largest: float = 0.0

    def __post_init__(self) -> None:
        self.rng = np.random.default_rng(self.seed)
        self.map = TaskMap(self.chain)
        self.unit = np.where(self.map.turns, 1.0, self.map.size)
        inner = np.arange(6)[1:-1]
        self.long = [k for k in inner if self.map.turns[k]]

    @property
    def is_done(self) -> bool:
        """Enough poses and a path, or a clear one at once."""
        if self.poses >= _ENOUGH:
            return bool(self.ways)
        return any(way.clearance > _WIDE for way in self.ways)

    def spread(self) -> None:
        """Choose postures of each sign that are far from singular and from another."""
        some = self._random(_RANDOM)
        far = self.map.decomposed(some)[0]
        self.largest = float(np.abs(self.heights(some)).max())
        self.nets = {}
        for sign in (1.0, -1.0):
            peaks: list[Array] = []
            for k in np.argsort(-sign * far):
                if len(peaks) == _PEAKS or sign * far[k] <= 0:
                    break
                if all(self._apart(some[k], peak) > _NEAR for peak in peaks):
                    peaks.append(some[k])
            self.nets[sign] = _Net(self, sign, np.array(peaks).reshape(-1, 6))

    def look(self) -> None:
        """Try one batch of poses."""
        given = self._random(_BATCH)
        for own in self._postures(given):
            self.counts[len(own)] += 1
            self.poses += 1
            signs = np.sign(self.heights(own))
            for sign in (1.0, -1.0):
                postures = own[signs == sign]
                first, second = np.triu_indices(len(postures), 1)
                self.pairs += len(first)
                if len(first):
                    self._join(sign, postures, first, second)

    def _join(self, sign: float, postures: Array, first: Index, second: Index) -> None:
        """Keep the couples that a straight way joins, else one over the net."""
        start, end = postures[first], postures[second]
        target, low = self.straight(sign, start, end)
        net = self.nets[sign]
        to_net = net.reach(postures)
        for k in range(len(first)):
            path = np.array([start[k], target[k]])
            if low[k] <= 0:
                over = net.path(to_net, int(first[k]), int(second[k]))
                if over is None:
                    continue
                path = self.unwound(np.vstack([start[k], over, end[k]]))
            lows = self.lowest(sign, path[:-1], path[1:], _FINE)
            clearance = float(lows.min()) / self.largest
            if clearance > _ROUNDING:
                self.ways.append(_Way(path, clearance))

    def unwound(self, path: Array) -> Array:
        """The path with every joint turning the short way from point to point."""
        moves = self.short(np.diff(path, axis=0))
        return np.asarray(path[0] + np.vstack([np.zeros(6), np.cumsum(moves, axis=0)]))

    def straight(self, sign: float, start: Array, end: Array) -> tuple[Array, Array]:
        """The best straight path of each pair: its end and the lowest s h on it."""
        short = self.short(end - start)
        moves = []
        for turns in product((0, 1), repeat=len(self.long)):
            move = short.copy()
            for k, turn in zip(self.long, turns, strict=True):
                move[:, k] -= turn * FULL_TURN * np.where(short[:, k] > 0, 1.0, -1.0)
            moves.append(move)
        lows = [self.lowest(sign, start, start + move) for move in moves]
        best = np.argmax(lows, axis=0)
        rows = np.arange(len(start))
        return start + np.array(moves)[best, rows], np.array(lows)[best, rows]

    def lowest(
        self, sign: float, start: Array, end: Array, samples: int = _SAMPLES
    ) -> Array:
        """The smallest sampled s h on segments (m, 6) to (m, 6): (m,)."""
        t = np.linspace(0.0, 1.0, samples)[None, :, None]
        points = start[:, None] + t * (end - start)[:, None]
        values = self.heights(points.reshape(-1, 6)).reshape(len(start), samples)
        return np.asarray((sign * values).min(1))

    def short(self, moves: Array) -> Array:
        """Moves with the short way round."""
        return np.where(self.map.turns, shortest_turn(moves), moves)

    def heights(self, q: Array) -> Array:
        """Det J, lengths in units of the arm's size."""
        found = []
        for part in np.array_split(q, len(q) // _CHUNK + 1):
            w, v = self.map.columns(part)
            found.append(np.linalg.det(np.concatenate([v, w], 2)))
        return np.concatenate(found)

    def _random(self, count: int) -> Array:
        """Postures; slides within the size of the arm about 0."""
        share = self.rng.uniform(-1.0, 1.0, (count, 6))
        return np.asarray(share * np.where(self.map.turns, np.pi, self.map.size))

    def _apart(self, a: Array, b: Array) -> float:
        return float(np.abs(self.short(a - b) / self.unit).max())

    def _postures(self, given: Array) -> list[Array]:
        """For each posture those of its pose that Newton's method meets, itself too."""
        goals = np.repeat(self.map.placed(given), _STARTS, axis=0)
        q = self._random(len(goals))
        error = np.full(len(q), np.inf)
        for _ in range(_NEWTON):
            placed = self.map.placed(q)
            missing = gap(placed, goals)[..., 0]
            missing[:, :3] /= self.map.size
            error = np.abs(placed - goals).max((1, 2)) / self.map.size
            w, v = self.map.columns(q)
            J = np.swapaxes(np.concatenate([v, w], 2), 1, 2)
            square = np.swapaxes(J, 1, 2) @ J + 1e-12 * np.eye(6)
            right = np.swapaxes(J, 1, 2) @ missing[..., None]
            step = np.linalg.solve(square, right)[..., 0]
            q = q + np.clip(step, -_STRIDE, _STRIDE) * self.unit
        owner = np.repeat(np.arange(len(given)), _STARTS)
        found = []
        for k, own in enumerate(given):
            met = [own]
            for posture in q[(owner == k) & (error < _REACHED)]:
                if all(self._apart(posture, other) > _EQUAL for other in met):
                    met.append(own + self.short(posture - own))
            found.append(np.array(met))
        return found

    def result(self) -> PathSearch:
        """The record, and the clearest proposals."""
        self.ways.sort(key=lambda way: -way.clearance)
        best = self.ways[0].clearance if self.ways else 0.0
        record = SearchRecord(
            poses=self.poses,
            postures={str(n): self.counts[n] for n in sorted(self.counts)},
            uneven=0,
            pairs=self.pairs,
            joined=len(self.ways),
            clearance=best,
            seed=self.seed,
            stopped=self.stopped,
        )
        slides = int((~self.map.turns).sum())
        unit = self.map.size ** (3 - slides)
        proposals = tuple(
            Proposal(way.path, way.clearance * self.largest * unit, way.clearance)
            for way in self.ways[:_KEPT]
        )
        return PathSearch(record, proposals, self.largest * unit)


class _Net:
    """Postures of one sign of det J far from singular, and ways between them.

    Attributes:
        peaks: (n, 6).
    """

    def __init__(self, looking: _Looking, sign: float, peaks: Array) -> None:
        """Join them by the straight short ways that stay away from zero."""
        self.looking, self.sign, self.peaks = looking, sign, peaks
        n = len(peaks)
        low = self._lows(np.repeat(peaks, n, 0), np.tile(peaks, (n, 1))).reshape(n, n)
        self._low = np.maximum(low, 0.0)
        self._via = np.full((n, n), -1)
        for k in range(n):
            through = np.minimum(self._low[:, k, None], self._low[None, k])
            better = through > self._low
            self._low[better], self._via[better] = through[better], k

    def reach(self, postures: Array) -> Array:
        """The lowest s h on the straight way from each posture to each peak, (m, n)."""
        m, n = len(postures), len(self.peaks)
        start = np.repeat(postures, n, 0)
        return self._lows(start, np.tile(self.peaks, (m, 1))).reshape(m, n)

    def path(self, reach: Array, i: int, j: int) -> Array | None:
        """The widest way from posture i to posture j; None where none is known."""
        if not len(self.peaks):
            return None
        width = np.minimum(np.minimum(reach[i][:, None], reach[j][None]), self._low)
        width[np.diag_indices(len(width))] = np.minimum(reach[i], reach[j])
        a, b = np.unravel_index(int(width.argmax()), width.shape)
        if width[a, b] <= 0:
            return None
        return np.array([*self._between(int(a), int(b))])

    def _between(self, a: int, b: int) -> list[Array]:
        if a == b:
            return [self.peaks[a]]
        middle = int(self._via[a, b])
        if middle < 0:
            return [self.peaks[a], self.peaks[b]]
        return self._between(a, middle) + self._between(middle, b)[1:]

    def _lows(self, start: Array, end: Array) -> Array:
        if not len(start):
            return np.zeros(0)
        move = self.looking.short(end - start)
        return self.looking.lowest(self.sign, start, start + move)
