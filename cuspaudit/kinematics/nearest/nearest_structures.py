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

from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.nearest.concurrent import Meeting, concurrent
from cuspaudit.kinematics.nearest.exact_arm import exact_arm
from cuspaudit.kinematics.nearest.links import Link, links_of, reach_of
from cuspaudit.kinematics.nearest.meeting import (
    Move,
    meeting,
    parallel,
    square_and_meeting,
)
from cuspaudit.kinematics.nearest.patterns import Pattern, Relation, Way, patterns_for

__all__ = ["NearStructure", "nearest_structures"]

_TRIED = 4
"""So many ways of a pattern are written out, nearest first, until one passes."""


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
        model: of the arm that has it.
    """

    name: str
    holds: bool
    length: float
    angle: float
    size: float
    way: str
    model: ExactModel


def nearest_structures(model: ExactModel) -> tuple[NearStructure, ...]:
    """The structures that decide arms like that of ``model``, nearest first.

    A structure that no arm near by has (axes that would meet are parallel) is left out.
    """
    chain = model.chain
    links = links_of(chain)
    reach = reach_of(links)
    if reach == 0:
        return ()
    arm = _Arm(model, links, reach)
    found = [_nearest(arm, pattern) for pattern in patterns_for(chain)]
    return tuple(sorted(filter(None, found), key=lambda structure: structure.size))


class _Arm:
    """An arm, and for each relation whether it holds and the least move for it."""

    def __init__(self, model: ExactModel, links: Sequence[Link], reach: float) -> None:
        self.model, self.links, self.reach = model, links, reach
        self._held: dict[Relation, bool] = {}
        self._moves: dict[Relation, Move | Meeting | None] = {}

    def has(self, way: Way) -> bool:
        """Whether all relations of the way hold exactly."""
        for relation in way:
            if relation not in self._held:
                self._held[relation] = relation.holds(self.model)
        return all(self._held[relation] for relation in way)

    def least(self, relation: Relation) -> Move | Meeting | None:
        """The least move that makes the relation hold."""
        if relation not in self._moves:
            self._moves[relation] = self._least(relation)
        return self._moves[relation]

    def _least(self, relation: Relation) -> Move | Meeting | None:
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


def _nearest(arm: _Arm, pattern: Pattern) -> NearStructure | None:
    held = next((way for way in pattern.ways if arm.has(way)), None)
    if held is not None and pattern.holds(arm.model):
        way = _sentence(held)
        return NearStructure(pattern.name, True, 0.0, 0.0, 0.0, way, arm.model)
    ways = sorted(
        (moved for way in pattern.ways if (moved := _moved(way, arm))),
        key=lambda moved: moved.size(arm.reach),
    )
    for moved in ways[:_TRIED]:
        model = exact_model(exact_arm(arm.model.chain, moved.links(arm.links)))
        if pattern.holds(model):
            return NearStructure(
                pattern.name,
                False,
                moved.length,
                moved.angle,
                moved.size(arm.reach),
                _sentence(moved.way),
                model,
            )
    return None


@dataclass(frozen=True, eq=False)
class _Moved:
    """The least moves that meet all relations of a way."""

    way: Way
    moves: tuple[Move | Meeting, ...]

    @property
    def length(self) -> float:
        """The largest shift."""
        return max(move.length for move in self.moves)

    @property
    def angle(self) -> float:
        """The largest tilt."""
        return max(move.angle for move in self.moves)

    def size(self, reach: float) -> float:
        """The larger of length over reach and angle."""
        return max(self.length / reach, self.angle)

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


def _slide_places(links: list[Link], k: int, move: Meeting) -> None:
    """Let the links around three axes begin and end where these meet."""
    if k > 0:
        step = links[k - 1].step + move.before * links[k - 1].next
        links[k - 1] = replace(links[k - 1], step=step)
    if k + 2 < len(links):
        step = links[k + 2].step - move.after * links[k + 2].axis
        links[k + 2] = replace(links[k + 2], step=step)


def _moved(way: Way, arm: _Arm) -> _Moved | None:
    found = [move for relation in way if (move := arm.least(relation)) is not None]
    return _Moved(way, tuple(found)) if len(found) == len(way) else None


def _sentence(way: Way) -> str:
    return "; ".join(str(relation) for relation in way)
