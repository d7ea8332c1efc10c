"""The nearest arm of each structure that a theorem decides, and how far it is.

A structure is a set of arms, and an arm is the set of its links (`links`). The distance
of two arms is a length and an angle: the largest shift and the largest tilt of an axis
in its link, seen from the axis before it. A nearest arm is one for which the larger of
length over reach and angle is least, up to the preference for plain moves that
`meeting` states. Relations in different links are met one by one; three axes that meet
in one point bind two links.

What is found in floating point is written as a chain in exact numbers, and the theorem
tests its exact model: an arm that does not pass is not listed. The nearest arm is
another arm. Nothing about it is said of the robot itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.nearest.concurrent import CommonPoint, concurrent
from cuspaudit.kinematics.nearest.exact_arm import exact_arm
from cuspaudit.kinematics.nearest.links import Link, links_of, reach_of
from cuspaudit.kinematics.nearest.meeting import (
    Move,
    meeting,
    parallel,
    square_and_meeting,
)
from cuspaudit.kinematics.nearest.patterns import (
    AxisRelation,
    Pattern,
    Way,
    patterns_for,
    way_words,
)
from cuspaudit.kinematics.theorems.theorem import Reduction
from cuspaudit.robot.chain import Chain
from cuspaudit.runtime.clock import check_time

__all__ = ["AxisMove", "NearStructure", "nearest_structures"]

_ROUNDING = 1e-12
_LONGEST = 1e100
"""Lengths beyond it overflow in floating point: such arms get no list."""
_TRIED = 4
"""So many ways of a pattern are written out, nearest first, until one passes."""


@dataclass(frozen=True)
class AxisMove:
    """How an axis moves, seen from the one before it.

    Attributes:
        axis: its number, from 1; a virtual joint counts.
        length: of its shift, in the chain's unit.
        angle: of its tilt, in rad.
    """

    axis: int
    length: float
    angle: float


@dataclass(frozen=True, eq=False)
class NearStructure:
    """An arm that has a structure exactly, nearest to another one.

    Attributes:
        name: of the structure.
        holds: whether the arm itself has it; then both distances are 0.
        length: the largest shift of an axis, in the chain's unit.
        angle: the largest tilt of an axis, in rad.
        size: the larger of length over reach and angle.
        way: how the axes stand then.
        moves: the axes that move.
        model: of the arm that has it.
        reduction: what the theorem says of that arm.
    """

    name: str
    holds: bool
    length: float
    angle: float
    size: float
    way: str
    moves: tuple[AxisMove, ...]
    model: ExactModel
    reduction: Reduction


def nearest_structures(model: ExactModel) -> tuple[NearStructure, ...]:
    """The structures that decide arms like that of ``model``, nearest first.

    A structure that no arm near by has (axes that would meet are parallel) is left out.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        moves = _Moves(model.chain)
    if not 0 < moves.reach < _LONGEST:
        return ()
    held: dict[AxisRelation, bool] = {}
    found = (
        _held(model, pattern, held) or _nearest(model, pattern, moves)
        for pattern in patterns_for(model.chain)
    )
    return tuple(sorted(filter(None, found), key=lambda structure: structure.size))


def _held(
    model: ExactModel, pattern: Pattern, held: dict[AxisRelation, bool]
) -> NearStructure | None:
    """The arm itself, if it has the structure; relations are tested once."""
    for way in pattern.ways:
        for relation in way:
            if relation not in held:
                held[relation] = relation.holds(model)
        if all(held[relation] for relation in way):
            reduction = pattern.theorem.apply(model)
            if reduction is not None:
                return NearStructure(
                    pattern.theorem.name,
                    True,
                    0.0,
                    0.0,
                    0.0,
                    way_words(way),
                    (),
                    model,
                    reduction,
                )
    return None


def _nearest(
    model: ExactModel, pattern: Pattern, moves: _Moves
) -> NearStructure | None:
    for moved in _ways(pattern, moves)[:_TRIED]:
        check_time("structures")
        near = exact_model(exact_arm(model.chain, moved.links(moves.links)))
        reduction = pattern.theorem.apply(near)
        if reduction is not None:
            return NearStructure(
                pattern.theorem.name,
                False,
                moved.length,
                moved.angle,
                moved.size,
                way_words(moved.way),
                moved.axes,
                near,
                reduction,
            )
    return None


def _ways(pattern: Pattern, moves: _Moves) -> list[_Moved]:
    """The ways to a structure, each with its least moves, nearest first."""
    found = (_moved(way, moves) for way in pattern.ways)
    return sorted(filter(None, found), key=lambda moved: moved.size)


class _Moves:
    """The links of an arm, and the least move for each relation, found once."""

    def __init__(self, chain: Chain) -> None:
        self.links = links_of(chain)
        self.reach = reach_of(self.links)
        self._found: dict[AxisRelation, Move | CommonPoint | None] = {}

    def least(self, relation: AxisRelation) -> Move | CommonPoint | None:
        """The least move that makes the relation hold."""
        if relation not in self._found:
            self._found[relation] = self._least(relation)
        return self._found[relation]

    def _least(self, relation: AxisRelation) -> Move | CommonPoint | None:
        k, reach = relation.first - 1, self.reach
        match relation.kind:
            case "parallel":
                return parallel(self.links[k])
            case "meet":
                return meeting(self.links[k], reach)
            case "meet at right angles":
                return square_and_meeting(self.links[k], reach)
            case _:
                return concurrent(self.links[k], self.links[k + 1], reach)


@dataclass(frozen=True, eq=False)
class _Moved:
    """The least moves that meet all relations of a way."""

    way: Way
    moves: tuple[Move | CommonPoint, ...]
    reach: float

    @cached_property
    def axes(self) -> tuple[AxisMove, ...]:
        """The axes that move by more than rounding, base to tip."""
        found = []
        for relation, move in zip(self.way, self.moves, strict=True):
            if isinstance(move, Move):
                found.append((relation.first + 1, move.length, move.angle))
            else:
                first, second = zip(move.lengths, move.angles, strict=True)
                found.append((relation.first + 1, *first))
                found.append((relation.first + 2, *second))
        clean = (
            AxisMove(
                axis,
                length if length > _ROUNDING * self.reach else 0.0,
                angle if angle > _ROUNDING else 0.0,
            )
            for axis, length, angle in sorted(found)
        )
        return tuple(axis for axis in clean if axis.length or axis.angle)

    @property
    def length(self) -> float:
        """The largest shift."""
        return max((axis.length for axis in self.axes), default=0.0)

    @property
    def angle(self) -> float:
        """The largest tilt."""
        return max((axis.angle for axis in self.axes), default=0.0)

    @property
    def size(self) -> float:
        """The larger of length over reach and angle."""
        return max(self.length / self.reach, self.angle)

    def links(self, links: Sequence[Link]) -> list[Link]:
        """All links of the arm after the moves."""
        moved = list(links)
        for relation, move in zip(self.way, self.moves, strict=True):
            k = relation.first - 1
            if isinstance(move, Move):
                moved[k] = move.link
            else:
                moved[k : k + 2] = move.first, move.second
                _slide_places(moved, k, move)
        return moved


def _slide_places(links: list[Link], k: int, move: CommonPoint) -> None:
    """Let the links around three axes begin and end where these meet."""
    if k > 0:
        step = links[k - 1].step + move.before * links[k - 1].next
        links[k - 1] = replace(links[k - 1], step=step)
    if k + 2 < len(links):
        step = links[k + 2].step - move.after * links[k + 2].axis
        links[k + 2] = replace(links[k + 2], step=step)


def _moved(way: Way, moves: _Moves) -> _Moved | None:
    found = [move for relation in way if (move := moves.least(relation)) is not None]
    return _Moved(way, tuple(found), moves.reach) if len(found) == len(way) else None
