"""Runs: the pieces of strands on which the parameter of the path grows.

A strand turns back in s where it meets a singular posture: s' = 0 along it means that
the tangent (q', 0) is in the kernel of F', so J q' = 0 with q' != 0. Where s grows
before a short piece and falls after it (or the other way round), s' has a zero on the
piece: a run dies there, and its partner too (or both are born). Where s grows on both
sides of a piece on which s' may have zeros, the strand may only touch: undecided.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.strand import Strand, TubeLink, refined
from cuspaudit.toolpath.following.tube import Knot

__all__ = ["FreeRun", "RunEnd", "loop_runs", "runs_of"]

Array = NDArray[np.float64]

_STEP, _MOST_BETWEEN = 0.04, 12


@dataclass(frozen=True, slots=True)
class RunEnd:
    """Where and of what a run begins or ends.

    Attributes:
        kind: "path" at an end of the tool path, else "singular" or "undecided".
        low: a lower bound of the parameter, in legs from the start of the path.
        high: an upper bound.
    """

    kind: str
    low: float
    high: float

    @property
    def at(self) -> float:
        """The middle of the two."""
        return (self.low + self.high) / 2


@dataclass(frozen=True, eq=False)
class FreeRun:
    """A run, limits of the joints left out of account.

    Attributes:
        links: in the order of growing s; the knots of a link keep the strand's order.
        begin: where it is born.
        end: where it dies.
        forward: whether the strand was followed with growing s.
    """

    links: tuple[TubeLink, ...]
    begin: RunEnd
    end: RunEnd
    forward: bool

    def knots(self, link: TubeLink) -> tuple[Knot, Knot]:
        """The knots of a link, by growing s."""
        if self.forward:
            return link.before, link.after
        return link.after, link.before

    @property
    def first(self) -> Knot:
        """Its first knot."""
        return self.knots(self.links[0])[0]

    @property
    def last(self) -> Knot:
        """Its last knot."""
        return self.knots(self.links[-1])[1]

    @cached_property
    def points(self) -> Array:
        """Joint coordinates and parameter of the path along it, (m, n + 1).

        Between knots, points of the axes of the tubes, close together.
        """
        rows = [_row(self.links[0], self.first.at)]
        for link in self.links:
            first, last = self.knots(link)
            rows += [_row(link, point) for point in _between(link, first.at, last.at)]
            rows.append(_row(link, last.at))
        return np.array(rows)


def _row(link: TubeLink, point: Array) -> Array:
    row = point.copy()
    row[-1] += link.leg
    return row


def _between(link: TubeLink, first: Array, last: Array) -> list[Array]:
    """Points of the axis of a tube between two of its ends."""
    tube = link.tube
    count = min(int(np.abs(last[:-1] - first[:-1]).max() / _STEP), _MOST_BETWEEN)
    if not count:
        return []
    ends = [float(tube.along @ (end - tube.center)) for end in (first, last)]
    places = np.linspace(ends[0], ends[1], count + 2)[1:-1]
    return [tube.center + t * tube.along + t * t * tube.bow for t in places]


def runs_of(
    legs: Sequence[LegSystem], strand: Strand, from_start: bool
) -> list[FreeRun]:
    """The runs that a strand is made of.

    Args:
        legs: the equations of each leg.
        strand: begun at an end of the path.
        from_start: whether that is the start of the path.
    """
    links = [piece for link in strand.links for piece in refined(legs[link.leg], link)]
    if not links:
        return []
    groups = [(trend, list(some)) for trend, some in groupby(links, lambda k: k.trend)]
    first = 0.0 if from_start else float(len(legs))
    left = RunEnd("path", first, first)
    runs = []
    for index, (trend, group) in enumerate(groups):
        if trend == 0:
            continue
        right = _right(groups, index, strand)
        forward = trend > 0
        pieces = tuple(group if forward else reversed(group))
        begin, end = (left, right) if forward else (right, left)
        runs.append(FreeRun(pieces, begin, end, forward))
        left = right
    return runs


def loop_runs(legs: Sequence[LegSystem], links: Sequence[TubeLink]) -> list[FreeRun]:
    """The runs of a closed strand, once round.

    Args:
        legs: the equations of each leg.
        links: from a knot on, where s grows, back to it; the last one holds that knot.
    """
    pieces = [p for link in links for p in refined(legs[link.leg], link)]
    turn = next((k for k, piece in enumerate(pieces) if piece.trend == 0), None)
    if turn is None:
        return []
    pieces = pieces[turn:] + pieces[:turn]
    flat = [*pieces]
    # begun and ended on the flat piece where the strand first turns back
    strand = Strand((*flat, pieces[0]), "stuck", pieces[0].leg, pieces[0].before)
    groups = [
        (trend, list(some)) for trend, some in groupby(strand.links, lambda k: k.trend)
    ]
    runs = []
    for index, (trend, group) in enumerate(groups):
        if trend == 0 or not 0 < index < len(groups) - 1:
            continue
        left, right = (_window(groups[k][1]) for k in (index - 1, index + 1))
        forward = trend > 0
        ordered = tuple(group if forward else reversed(group))
        begin, end = (left, right) if forward else (right, left)
        runs.append(FreeRun(ordered, begin, end, forward))
    return runs


def _window(flat: list[TubeLink]) -> RunEnd:
    low = min(link.leg + float(link.tube.low[-1]) for link in flat)
    high = max(link.leg + float(link.tube.high[-1]) for link in flat)
    # the sums are rounded
    return RunEnd(
        "singular", math.nextafter(low, -math.inf), math.nextafter(high, math.inf)
    )


def _right(
    groups: list[tuple[int, list[TubeLink]]], index: int, strand: Strand
) -> RunEnd:
    """What stands after a group, in the order of the strand."""
    trend = groups[index][0]
    rest = groups[index + 1 :]
    if not rest:
        if strand.exit == "stuck":
            return RunEnd("undecided", strand.at, strand.at)
        return RunEnd("path", strand.at, strand.at)
    window = _window(rest[0][1])
    turned = len(rest) > 1 and rest[1][0] == -trend
    return window if turned else replace(window, kind="undecided")
