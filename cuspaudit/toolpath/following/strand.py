"""Strands: the curves of zeros of a tool path's legs, followed tube by tube.

The postures and parameters (q, s) with the tip on the path form a curve. It is smooth
where its tangent is unique, at singular postures too: there the curve turns back in s,
and goes on as another run of the path, towards smaller s. So a strand passes through
the deaths and births of runs, and no step has to shrink near them.

What joins two tubes is a knot that lies in both (`tube`), and a proof that both go the
same way there; what joins two legs is a knot at their common waypoint.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from cuspaudit.runtime.clock import time_is_up
from cuspaudit.toolpath.ball_arm import BallArm
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.tube import Knot, Tube, knot_at, tube_round
from cuspaudit.toolpath.following.tube_axis import TubeAxis, axis_at, beside

__all__ = [
    "Strand",
    "TubeLink",
    "followed",
    "looped",
    "refined",
    "settled",
    "split",
    "unwound",
]

Array = NDArray[np.float64]
Exit = Literal["start", "end", "stuck"]

_FIRST, _LONGEST, _SHORTEST = 0.5, 1.5, 1e-6
_STILL = 1e-3
_COMFORT = 0.45
_MOST = 2_000
_FLAT = 1e-9
_BRIEFEST = 1e-6
_NEWTON = 8
_SETTLED = 1e-14
_SHIFT = 1e-14


@dataclass(frozen=True, slots=True, eq=False)
class TubeLink:
    """A tube of a leg, and the knots at its ends, in the order of the strand."""

    leg: int
    tube: Tube
    before: Knot
    after: Knot

    @property
    def trend(self) -> int:
        """1 where s grows along the strand, -1 where it falls, 0 if not proved."""
        return self.tube.trend(-1)


@dataclass(frozen=True, slots=True, eq=False)
class Strand:
    """A curve of zeros from a knot on.

    Attributes:
        links: its tubes.
        exit: "end" and "start" of the path, or "stuck" where no step can be proved, or
            the time was up.
        leg: the leg where it ends.
        last: its last knot.
    """

    links: tuple[TubeLink, ...]
    exit: Exit
    leg: int
    last: Knot

    @property
    def at(self) -> float:
        """The parameter of the path where it ends."""
        return self.leg + float(self.last.at[-1])


def followed(legs: Sequence[LegSystem], leg: int, knot: Knot, forward: bool) -> Strand:
    """The strand from a knot to an end of the path.

    Args:
        legs: the equations of each leg.
        leg: where the knot is.
        knot: with a regular posture at its zero.
        forward: whether the strand is to begin with growing s.
    """
    links: list[TubeLink] = []
    while True:
        pieces = list(_along(legs[leg], leg, knot, forward))
        links += pieces
        if pieces:
            knot = pieces[-1].after
            forward = bool(pieces[-1].trend > 0)
        step = _leaves(knot, forward) if pieces else 0
        if step == 0:
            return Strand(tuple(links), "stuck", leg, knot)
        if not 0 <= leg + step < len(legs):
            return Strand(tuple(links), "end" if step > 0 else "start", leg, knot)
        leg += step
        at = knot.at.copy()
        at[-1] = 0.0 if step > 0 else 1.0
        knot = Knot(at, knot.reach)


def looped(legs: Sequence[LegSystem], leg: int, knot: Knot) -> list[TubeLink] | None:
    """The tubes of a closed strand through a knot inside a leg, once round.

    Joints may have made whole turns when it comes back.

    Returns:
        None if it is not closed, or a step cannot be proved.
    """
    links: list[TubeLink] = []
    here, start, forward, away = leg, knot, True, False
    while len(links) < _MOST:
        pieces = []
        for piece in _along(legs[here], here, knot, forward):
            pieces.append(piece)
            back = here == leg and piece.tube.holds(
                unwound(legs[leg].arm, start, piece.tube)
            )
            if back and away:
                return [*links, *pieces]
            away = away or not back
        links += pieces
        if not pieces:
            return None
        knot, forward = pieces[-1].after, pieces[-1].trend > 0
        step = _leaves(knot, forward)
        if step == 0 or not 0 <= here + step < len(legs):
            return None
        here += step
        at = knot.at.copy()
        at[-1] = 0.0 if step > 0 else 1.0
        knot = Knot(at, knot.reach)
    return None


def unwound(arm: BallArm, knot: Knot, tube: Tube) -> Knot:
    """The knot in the winding nearest to a tube: a box round the same posture."""
    gap = tube.center[:-1] - knot.at[:-1]
    turns = np.where(arm.turns, np.round(gap / (2 * np.pi)), 0.0)
    at = knot.at.copy()
    at[:-1] += 2 * np.pi * turns
    # the turns are rounded
    reach = knot.reach + np.append(_SHIFT * np.abs(turns) * (1 + np.abs(at[:-1])), 0.0)
    return Knot(at, reach)


def refined(system: LegSystem, link: TubeLink) -> list[TubeLink]:
    """The link in pieces that are monotone in s, but for some that hardly move in s."""
    tube = link.tube
    thin = float(tube.high[-1] - tube.low[-1]) < _FLAT
    if link.trend or thin or tube.length < _BRIEFEST:
        return [link]
    halves = split(system, link)
    if halves is None:
        return [link]
    return [piece for half in halves for piece in refined(system, half)]


def split(system: LegSystem, link: TubeLink) -> tuple[TubeLink, TubeLink] | None:
    """The link in two halves, proved anew; None if they are too short for that."""
    tube, points = link.tube, []
    for share in (0.25, 0.5, 0.75):
        t = tube.span[0] + share * tube.length
        guess = tube.center + t * tube.along + t * t * tube.bow
        y = settled(system, guess, tube.along)
        if y is None:
            return None
        points.append(y)
    knot = knot_at(system, points[1], tube.across)
    if knot is None or not tube.holds(knot):
        return None
    result = []
    for middle, ends in (
        (points[0], (link.before, knot)),
        (points[2], (knot, link.after)),
    ):
        axis = axis_at(system, middle, tube.along)
        half = None if axis is None else tube_round(axis, (ends[0].at, ends[1].at))
        if half is None or not all(half.holds(end) for end in ends):
            return None
        result.append(TubeLink(link.leg, half, *ends))
    return result[0], result[1]


def _leaves(knot: Knot, forward: bool) -> int:
    s = float(knot.at[-1])
    if forward:
        return 1 if s == 1.0 else 0
    return -1 if s == 0.0 else 0


def _along(
    system: LegSystem, leg: int, knot: Knot, forward: bool
) -> Iterator[TubeLink]:
    """Tubes from ``knot`` to an end of the leg, or as far as they can be proved."""
    heading = np.zeros(system.size + 1)
    heading[-1] = 1.0 if forward else -1.0
    size, most, last = _FIRST, _LONGEST, None
    axis = axis_at(system, knot.at, heading)
    for _ in range(_MOST):
        if axis is None or time_is_up():
            return
        found = None
        while found is None:
            found = _step(system, leg, knot, axis, size, last)
            if found is None:
                size, most = size / 2, 0.7 * size
            if size < _SHORTEST:
                return
        link, axis = found
        yield link
        knot, last = link.after, link.tube
        if knot.at[-1] in (0.0, 1.0):
            return
        growth = _COMFORT / (link.tube.strain + 1e-9)
        most = min(1.1 * most, _LONGEST)
        size = min(size * float(min(max(growth, 0.7), 1.5)), most)


def _step(
    system: LegSystem,
    leg: int,
    knot: Knot,
    axis: TubeAxis,
    size: float,
    last: Tube | None,
) -> tuple[TubeLink, TubeAxis | None] | None:
    """A tube of about ``size`` from ``knot``, or to the end of the leg.

    Sizes are those of the bounds (`Expansion.length`): how far the joints move.

    Args:
        system: the equations.
        leg: its number.
        knot: where the tube begins.
        axis: of the curve there.
        size: wanted.
        last: the tube before.

    Returns:
        The link, and the axis at its last knot; None if this size is too large.
    """
    size /= axis.here.length(axis.along) + _STILL
    goal, row, wall = axis.point(size), axis.along, None
    if not 0.0 < goal[-1] < 1.0:
        wall = 1.0 if goal[-1] >= 1.0 else 0.0
        share = _to_wall(axis, wall - knot.at[-1], size)
        if share is None:
            return None
        size, goal = share, axis.point(share)
        row = np.zeros(len(goal))
        row[-1], goal[-1] = 1.0, wall
    half = settled(system, axis.point(size / 2), axis.along)
    end = settled(system, goal, row)
    if half is None or end is None:
        return None
    if wall is not None:
        end[-1] = wall
    elif not 0.0 < end[-1] < 1.0:
        return None
    center = axis_at(system, half, axis.along)
    tube = None if center is None else tube_round(center, (knot.at, end))
    if tube is None or not _is_safe(tube, axis, last):
        return None
    after = knot_at(system, end, beside(row))
    if after is None or not tube.holds(knot) or not tube.holds(after):
        return None
    following = None if wall is not None else axis_at(system, end, tube.along)
    return TubeLink(leg, tube, knot, after), following


def _to_wall(axis: TubeAxis, gap: float, size: float) -> float | None:
    """The t at which the axis has come ``gap`` further in s, at most ``size``."""
    rise, bow = float(axis.along[-1]), float(axis.bow[-1])
    inside = rise * rise + 4 * bow * gap
    if inside < 0:
        return None
    # rise t + bow t^2 = gap, the root of smaller size without cancellation
    steep = rise + math.copysign(math.sqrt(inside), rise)
    shares = [2 * gap / steep] if steep else []
    if bow:
        shares.append(-steep / (2 * bow))
    ahead = [t for t in shares if t > 0]
    return min(ahead) if ahead and min(ahead) <= size * (1 + 1e-9) else None


def _is_safe(tube: Tube, axis: TubeAxis, last: Tube | None) -> bool:
    """Whether the tube stays on the leg, and goes on the way the strand came."""
    trend = tube.trend(-1)
    if trend == 0 and not (tube.low[-1] > 0.0 and tube.high[-1] < 1.0):
        return False
    if last is None:
        # from a waypoint the strand leaves the way it was asked to
        return trend * float(axis.along[-1]) > 0
    return last.trend(-1) * trend > 0 or last.heads_with(tube)


def settled(system: LegSystem, y: Array, row: Array) -> Array | None:
    """Newton's method in the plane through ``y`` across ``row``; None if it fails."""
    last = np.inf
    for _ in range(_NEWTON):
        value, slope = system.plain(y)
        try:
            step = np.linalg.solve(np.vstack([slope, row]), np.append(value, 0.0))
        except np.linalg.LinAlgError:
            return None
        y = y - step
        size = float(np.abs(step).max())
        if not size < 1.0 or (size > last and size > 1e-6):
            return None
        if size < _SETTLED or (size < 1e-9 and size >= last):
            return np.asarray(y)
        last = size
    return np.asarray(y) if last < 1e-10 else None
