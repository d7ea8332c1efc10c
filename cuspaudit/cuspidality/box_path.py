"""A path inside joint limits between the two postures of a couple, cell by cell.

The aspects of a box are components of a graph of cells (`surface.box_aspects`): a cell
is a piece of the fiber over an interval of the base between two events, and two cells
are joined over an event by a *gate*, a point of the fiber at which Delta is not 0 from
one side to the other. So a couple in one aspect is joined by cells, and the path
follows them: the middle of the piece along each interval, across to the gate, and
through it. Then stretches that a straight one replaces are left out.

In floating point: the path is a proposal, and a certificate proves it.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise
from typing import TYPE_CHECKING

import numpy as np
from flint import arb, fmpq
from numpy.typing import NDArray

from cuspaudit.algebra.angles import beside
from cuspaudit.algebra.rationals import exact_rational
from cuspaudit.cuspidality.box_decision import angle_at
from cuspaudit.cuspidality.pair_decision import PairEnd
from cuspaudit.cuspidality.surface_path import (
    SignedDelta,
    SurfacePath,
    is_swapped,
    resampled,
    shortened,
)
from cuspaudit.surface.box_aspects import BoxAspects, Place
from cuspaudit.surface.box_edges import start_of
from cuspaudit.surface.box_events import Gate, gates
from cuspaudit.surface.fiber_pieces import AtRational, AtRoot
from cuspaudit.surface.sample_points import FiberPosture
from cuspaudit.surface.surface import Factor, Surface

if TYPE_CHECKING:
    from cuspaudit.cuspidality.box_decision import BoxCouple, BoxDecision
    from cuspaudit.cuspidality.box_values import ValueCouple, ValuesDecision

    Decided = BoxDecision | ValuesDecision
    Couple = BoxCouple | ValueCouple

__all__ = ["box_paths"]

Array = NDArray[np.float64]

_BITS = 128
_ALONG = 9
_HAIR = 1e-3
_KEPT = 0.7
_BEST_OF = 6
_TURN = 2 * math.pi


def box_paths(decision: Decided) -> Iterator[SurfacePath]:
    """Paths for the couples of a box, the widest of the first few before the others.

    Way points are not reduced: joint values of the model, windings included.
    """
    found = (_path(decision, couple) for couple in _by_height(decision))
    first = [path for path in islice(found, _BEST_OF) if path is not None]
    yield from sorted(first, key=lambda path: -path.smallest)
    yield from (path for path in found if path is not None)


def _by_height(decision: Decided) -> list[Couple]:
    """The couples, those with ends farthest from the singular set first."""
    land = SignedDelta(decision.surface, decision.delta, 1)

    def height(couple: Couple) -> float:
        ends = np.array([_End.of(decision.surface, couple, k).point for k in (0, 1)])
        return float(np.abs(land.height(ends)).min())

    return sorted(decision.couples, key=height, reverse=True)


def _path(decision: Decided, couple: Couple) -> SurfacePath | None:
    """The path of a couple; None where samples of it are singular."""
    surface = decision.surface
    land = SignedDelta(surface, decision.delta, couple.sign)
    start, goal = (_End.of(surface, couple, k) for k in (0, 1))
    path = _Walk(decision.found, land).between(start, goal)
    smallest = float(land.height(resampled(path)).min())
    if not smallest > 0:
        return None
    keep = _KEPT * min(smallest, *land.height(path[[0, -1]]))
    path = shortened(path, lambda piece: land.height(resampled(piece)).min() >= keep)
    smallest = float(land.height(resampled(path)).min())
    order = [1, 0] if is_swapped(surface) else [0, 1]
    first = float(land.height(path[:1])[0])
    return SurfacePath(path[:, order], couple.sign, first, smallest, land.largest)


@dataclass(frozen=True)
class _End:
    """One posture of a couple: its cell, and where it is, turns included."""

    place: Place
    fiber: float
    base: float

    @property
    def point(self) -> Array:
        return np.array([self.fiber, self.base])

    @classmethod
    def of(cls, surface: Surface, couple: Couple, k: int) -> _End:
        posture, winding = couple.postures[k], couple.windings[k]
        place, turns = winding.place, winding.turns
        base = _angle(surface.base, posture.chart(_BITS)[1])
        return cls(
            place,
            _on_fiber(surface.fiber, posture) + _TURN * turns,
            base + _TURN * place[0],
        )


def _on_fiber(fiber: Factor, posture: PairEnd | FiberPosture) -> float:
    """The angle (or coordinate) that the windings of a posture count from."""
    if isinstance(posture, PairEnd):
        return float(angle_at(posture)(_BITS).mid())
    return _angle(fiber, posture.chart(_BITS)[0])


def _angle(factor: Factor, t: arb | fmpq) -> float:
    """The angle (or coordinate) at a chart coordinate, turns left out."""
    value = float(t.mid()) if isinstance(t, arb) else float(int(t.p) / int(t.q))
    if factor.kind == "line":
        return value
    return float(start_of(factor).mid()) + 2 * math.atan(value)


class _Walk:
    """Ways from cell to cell; points are (fiber, base) with turns included."""

    def __init__(self, found: BoxAspects, land: SignedDelta) -> None:
        self.found, self.land = found, land
        self.base = land.surface.base
        self.events = [_angle(self.base, e.enclosure(_BITS)) for e in found.events]
        self.limited = found.pieces.limits is not None
        self.ends = [float(e.ball(_BITS).mid()) for e in found.box.base or ()]

    def between(self, start: _End, goal: _End) -> Array:
        """The way between two ends in one component of the cells."""
        self.points = [start.point]
        self.turned, at = 0, start.base
        for cell, following in pairwise(self._cells(start.place, goal.place)):
            gate = self._gate(cell, following)
            leave, enter = self._sides(cell, following, gate)
            self._along(cell, at, leave)
            if gate is not None:
                through = float(gate.edge.ball(_BITS).mid())
                self._put(np.array([[through, leave], [through, enter]]))
            self.turned += self._wraps(cell, following, gate)
            at = enter
        last = goal.base + _TURN * self.turned
        self._along(goal.place, at, last)
        end = np.array([[goal.fiber, last]])
        if not self.limited and self.land.surface.fiber.kind == "circle":
            end[:, 0] = beside(end[:, 0], np.array(self.points[-1][0]))
        self._put(end)
        return np.array(self.points)

    def _cells(self, start: Place, goal: Place) -> list[Place]:
        """The fewest cells from one to the other."""
        before: dict[Place, Place] = {start: start}
        waiting = deque([start])
        while goal not in before:
            cell = waiting.popleft()
            for other in self.found.neighbors[cell]:
                if other not in before:
                    before[other] = cell
                    waiting.append(other)
        way = [goal]
        while way[-1] != start:
            way.append(before[way[-1]])
        return way[::-1]

    def _gate(self, cell: Place, following: Place) -> Gate | None:
        """The gate between two cells, if it is over an event and the fiber limited."""
        (turn, here, name), (other, there, then) = cell, following
        if not self.limited or turn != other or abs(here - there) != 1:
            return None
        names = (name, then) if here < there else (then, name)
        every = gates(self.found.pieces, self.found.events, min(here, there))
        return next((gate for gate in every if gate.names == names), None)

    def _sides(
        self, cell: Place, following: Place, gate: Gate | None
    ) -> tuple[float, float]:
        """Where on the base one cell is left and the next one entered."""
        (turn, here, _), (other, there, _) = cell, following
        shift = _TURN * (turn + self.turned)
        if turn == other and not self._wraps(cell, following, gate):
            k = min(here, there)
            low, high = self._beside(k, shift)
            if gate is not None:
                sides = [_angle(self.base, side) + shift for side in gate.sides]
                low, high = max(low, sides[0]), min(high, sides[1])
            return (low, high) if there > here else (high, low)
        forward = other > turn or (turn == other and here > there)
        end = float(start_of(self.base).mid()) + shift
        end += math.pi if forward else -math.pi
        hair = _HAIR if forward else -_HAIR
        return end - hair, end + hair

    def _beside(self, k: int, shift: float) -> tuple[float, float]:
        """Places left and right of an event, on the way to what comes next there."""
        event, others = self.events[k] + shift, [e + shift for e in self.events]
        others += self.ends
        below = max((e for e in others if e < event), default=-math.inf)
        above = min((e for e in others if e > event), default=math.inf)
        hair = math.inf if self.limited else _HAIR
        left = min(hair, (event - below) / 2, 1.0)
        return event - left, event + min(hair, (above - event) / 2, 1.0)

    def _wraps(self, cell: Place, following: Place, gate: Gate | None) -> int:
        """1 or -1 where a base without limits is left at an end of its chart."""
        (turn, here, name), (other, there, _) = cell, following
        last = len(self.events)
        if self.found.box.base is not None or self.base.kind == "line":
            return 0
        if turn != other or gate is not None or {here, there} != {0, last}:
            return 0
        if last == 1 and not self.limited and self._is_open_at(0, name):
            return 0
        return 1 if here > there else -1

    def _is_open_at(self, event: int, sign: int) -> bool:
        """Whether the piece of a sign goes on over an event."""
        return sign in self.found.pieces.signs(AtRoot(self.found.events[event]))

    def _along(self, cell: Place, start: float, end: float) -> None:
        """The middle of a cell's piece from one place of the base to another."""
        base = np.linspace(start, end, _ALONG)
        if self.limited:
            middle = np.array([self._middle(cell, float(b)) for b in base])
        else:
            middle = self.land.silhouette(base)
            if self.land.surface.fiber.kind == "circle":
                middle = beside(middle, np.array(self.points[-1][0]))
        self._put(np.stack([middle, base], axis=1))

    def _middle(self, cell: Place, at: float) -> float:
        """The middle of a cell's piece over a place of the base."""
        x = AtRational(self._chart(at))
        limits = self.found.pieces.limits
        assert limits is not None, "asked of fibers with limits"
        low, high = (edge.ball(_BITS) for edge in limits)
        marks = [low, *self.found.pieces.zeros(x), high]
        a, b = (float(mark.mid()) for mark in marks[cell[2] : cell[2] + 2])
        return (a + b) / 2

    def _chart(self, at: float) -> fmpq:
        if self.base.kind == "line":
            return exact_rational(arb(at))
        local = at - float(start_of(self.base).mid())
        return exact_rational(arb(math.tan(local / 2)))

    def _put(self, points: Sequence[Array] | Array) -> None:
        self.points.extend(points)
