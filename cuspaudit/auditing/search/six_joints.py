"""The search for a witness of a six-joint arm, in floating point [mathematics 6.2, 7].

Seeded random postures give poses that are reached for certain; all postures of each
pose are solved numerically; two of them with one sign of det J are a candidate couple.
A candidate is joined straight, each joint turning the short way or the long way round,
or uphill of |det J| to a maximum, along straight ways between maxima, and down again.
What is proposed is proved, or refused, by its certificate; nothing is decided here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import shortest_turn
from cuspaudit.auditing.evidence import SearchRecord
from cuspaudit.auditing.search.torus_determinant import TorusDeterminant
from cuspaudit.auditing.search.torus_path import height_of, straight, tidy
from cuspaudit.auditing.search.torus_ridge import Ridge
from cuspaudit.errors import UnableError
from cuspaudit.geometry.torus.critical import FAST, climb, critical_sheets
from cuspaudit.kinematics.postures.numeric import PostureSolver, is_even
from cuspaudit.robot.chain import Chain

__all__ = ["PathSearch", "Proposal", "search"]

Array = NDArray[np.float64]
Index = NDArray[np.int64]

_BATCH = 32
_ENOUGH = 64
_MOST = 192
_STARTS = 256
_CLIMBS = 64
_CLIMBED = 8
_KEPT = 5
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Proposal:
    """A path that may be a witness.

    Attributes:
        path: (m, 6) joint values; its ends have one pose.
        height: smallest |det J| on it, sampled.
        clearance: that over the largest |det J|, sampled.
    """

    path: Array
    height: float
    clearance: float


@dataclass(frozen=True, eq=False)
class PathSearch:
    """What came out of a search.

    Attributes:
        record: what was tried.
        proposals: paths, the widest first.
        largest: the largest |det J| met, in the chain's unit of length cubed.
    """

    record: SearchRecord
    proposals: tuple[Proposal, ...]
    largest: float


def search(
    chain: Chain,
    seed: int = 0,
    progress: Callable[[str], None] = lambda step: None,
    most: int = _MOST,
    kept: int = _KEPT,
) -> PathSearch:
    """Look for nonsingular paths between two postures of one pose.

    Args:
        chain: six revolute joints, task "pose"; literal or snapped numbers.
        seed: of the random postures and of the ascents.
        progress: called before each batch of poses; an UnableError it raises ends the
            search, and is kept in the record.
        most: random poses to be tried when no wide path is met; 64 otherwise.
        kept: proposals at most.

    Raises:
        UnableError: the chain is not of this kind.
    """
    looking = _Looking(chain, seed, most)
    try:
        progress("search: maxima of |det J|")
        looking.climb()
        while not looking.is_done:
            progress(f"search: {looking.poses} poses, {len(looking.joined)} paths")
            looking.look()
    except UnableError as limit:
        looking.stopped = str(limit)
    return looking.result(kept)


@dataclass(frozen=True, eq=False)
class _Couple:
    """Two postures of one pose and what joins them; ``height`` is of that way."""

    first: Array
    second: Array
    sign: float
    height: float
    on_torus: Array


@dataclass(eq=False)
class _Looking:
    """The state of a search."""

    chain: Chain
    seed: int
    most: int
    poses: int = 0
    pairs: int = 0
    uneven: int = 0
    stopped: str | None = None
    counts: Counter[int] = field(default_factory=Counter)
    couples: list[_Couple] = field(default_factory=list)
    joined: set[tuple[tuple[float, ...], ...]] = field(default_factory=set)
    largest: float = 0.0

    def __post_init__(self) -> None:
        self.rng = np.random.default_rng(self.seed)
        self.solver = PostureSolver.of(self.chain)
        self.h = TorusDeterminant.of(self.solver)

    @property
    def is_done(self) -> bool:
        """Enough poses, and a path; or the most poses."""
        return self.poses >= (min(_ENOUGH, self.most) if self.couples else self.most)

    def climb(self) -> None:
        """Find maxima of |det J| and the ways between them."""
        starts = self.rng.uniform(-np.pi, np.pi, (_STARTS, 4))
        critical = critical_sheets(self.h, starts)
        critical = np.vstack([critical, climb(self.h, starts[:_CLIMBS], FAST)[-1]])
        self.largest = float(np.abs(self.h(critical)).max())
        self.ridges = {s: Ridge(self.h, s, critical) for s in (1.0, -1.0)}

    def look(self) -> None:
        """Try one batch of poses."""
        given = self.rng.uniform(-np.pi, np.pi, (_BATCH, 6))
        found = self.solver.solve(self.solver.poses(given))
        self.poses += _BATCH
        postures = np.vstack(found)
        heights = self.solver.determinants(postures)
        owner = np.repeat(np.arange(_BATCH), [len(f) for f in found])
        for k, own in enumerate(found):
            self.counts[len(own)] += 1
            self.uneven += not is_even(heights[owner == k])
        same = (owner[:, None] == owner) & (heights[:, None] * heights > 0)
        first, second = np.nonzero(np.triu(same, 1))
        self.pairs += len(first)
        if len(first):
            self._join_straight(postures, heights, first, second)
            self._join_uphill(postures, heights, first, second)

    def _join_straight(
        self, postures: Array, heights: Array, first: Index, second: Index
    ) -> None:
        """Keep the couples that a straight path joins."""
        start, end = postures[first, 1:5], postures[second, 1:5]
        target, low = straight(self.h, np.sign(heights[first]), start, end)
        for k in np.nonzero(low > 0)[0]:
            way = np.array([start[k], target[k]])
            self._keep(postures[first[k]], postures[second[k]], way)

    def _join_uphill(
        self, postures: Array, heights: Array, first: Index, second: Index
    ) -> None:
        """Keep the couples whose way by the ridge is promised to be the highest."""
        ways = climb(self.h, postures[:, 1:5], FAST)
        for sign, ridge in self.ridges.items():
            if not len(ridge.peaks):
                continue
            level = ridge.levels(ways[-1])[first, second]
            level = np.minimum(level, np.abs(heights[first]))
            level = np.minimum(level, np.abs(heights[second]))
            level = np.where(np.sign(heights[first]) == sign, level, 0.0)
            for k in np.argsort(-level)[:_CLIMBED]:
                if level[k] > 0:
                    i, j = first[k], second[k]
                    way = ridge.path(ways[:, i], ways[::-1, j])
                    self._keep(postures[i], postures[j], way)

    def _keep(self, first: Array, second: Array, way: Array) -> None:
        """Keep a couple if no sample of its way is singular."""
        sign = float(np.sign(self.h(way[0])))
        height = height_of(self.h, sign, way)
        if height > _ROUNDING * self.largest:
            self.joined.add((tuple(first), tuple(second)))
            self.couples.append(_Couple(first, second, sign, height, way))

    def result(self, kept: int) -> PathSearch:
        """The record, and the widest proposals."""
        self.couples.sort(key=lambda couple: -couple.height)
        scale = self.solver.scale**3
        record = SearchRecord(
            poses=self.poses,
            postures={str(n): self.counts[n] for n in sorted(self.counts)},
            uneven=self.uneven,
            pairs=self.pairs,
            joined=len(self.joined),
            clearance=self.couples[0].height / self.largest if self.couples else 0.0,
            seed=self.seed,
            stopped=self.stopped,
        )
        proposals = tuple(map(self._proposal, self.couples[:kept]))
        return PathSearch(record, proposals, self.largest * scale)

    def _proposal(self, couple: _Couple) -> Proposal:
        on_torus = tidy(self.h, couple.sign, couple.on_torus)
        height = height_of(self.h, couple.sign, on_torus)
        path = _with_ends(couple.first, couple.second, on_torus)
        return Proposal(path, height * self.solver.scale**3, height / self.largest)


def _with_ends(first: Array, second: Array, on_torus: Array) -> Array:
    """The path of six joints; joints 1 and 6 turn evenly, the short way."""
    length = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(on_torus, axis=0), axis=1))]
    share = (length / length[-1])[:, None]
    outer = [0, 5]
    turn = shortest_turn(second[outer] - first[outer])
    ends = first[outer] + share * turn
    return np.column_stack([ends[:, 0], on_torus, ends[:, 1]])
