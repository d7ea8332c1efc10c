"""Where a run leaves the limits of a joint, or one of its windings does.

Limits are open intervals, taken 1e-9 shorter at each end: a joint that stands at its
limit to so much has no room, and files write 2 pi with a dozen digits. What balls do
not tell from such an end, within 1e-10 of it, begins outside. A joint value
that differs by whole turns is the same posture in another winding; a joint whose range
is longer than a turn has several inside.

On a tube on which the joint value is monotone the limit is met once, if the two ends
lie on different sides of it, and never, if both lie inside. Other tubes are halved.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from flint import arb
from numpy.typing import NDArray

from cuspaudit.algebra.ring import rational
from cuspaudit.robot.chain import Angle, Joint
from cuspaudit.runtime.clock import time_is_up
from cuspaudit.toolpath.ball_arm import angle_ball
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.runs import FreeRun
from cuspaudit.toolpath.following.strand import TubeLink, settled, split
from cuspaudit.toolpath.following.tube import knot_at
from cuspaudit.toolpath.following.tube_axis import beside

__all__ = ["JointInterval", "Leaving", "first_leaving", "joint_ranges", "windings"]

Array = NDArray[np.float64]

_BRIEFEST = 1e-7
_SLACK = 1e-12
_INWARD = 1e-9
MOST_WINDINGS = 10_000


@dataclass(frozen=True, slots=True)
class JointInterval:
    """The open interval of a joint, in the coordinates of the balls.

    Attributes:
        low: its lower end.
        high: its upper end.
    """

    low: arb
    high: arb

    def shifted(self, turns: int) -> JointInterval:
        """The interval of the winding that has ``turns`` turns less."""
        step = 2 * arb.pi() * turns
        return JointInterval(self.low - step, self.high - step)

    def has(self, value: arb) -> bool | None:
        """Whether a value is inside; None where that cannot be told."""
        if value > self.low and value < self.high:
            return True
        return False if value < self.low or value > self.high else None


@dataclass(frozen=True, slots=True, eq=False)
class Leaving:
    """A run leaves the limits of a joint.

    Attributes:
        joint: its number, from 0.
        low: a lower bound of the parameter of the path.
        high: an upper bound.
        proved: False where it may only touch the limit.
        posture: coordinates there.
    """

    joint: int
    low: float
    high: float
    proved: bool
    posture: Array


def joint_ranges(joints: Sequence[Joint], scales: Array) -> list[JointInterval | None]:
    """The interval of each joint; None where it has no limits."""
    result: list[JointInterval | None] = []
    for joint, scale in zip(joints, scales, strict=True):
        if joint.limits is None:
            result.append(None)
            continue
        low, high = (
            angle_ball(limit)
            if isinstance(limit, Angle)
            else arb(rational(limit)) / scale
            for limit in joint.limits
        )
        result.append(JointInterval(low + _INWARD, high - _INWARD))
    return result


def windings(
    ranges: Sequence[JointInterval | None],
    turning: Sequence[bool],
    values: Sequence[arb],
    usual: Sequence[int],
) -> Iterator[tuple[int, ...]]:
    """The windings of a posture inside the limits.

    Args:
        ranges: of the joints.
        turning: which joints turn.
        values: of the joints.
        usual: turns to add to joints without limits.

    Yields:
        the turns to add to each joint.
    """
    choices: list[list[int]] = []
    for interval, turns, value, own in zip(ranges, turning, values, usual, strict=True):
        if interval is None:
            choices.append([own])
            continue
        reach = [0]
        if turns:
            step = 2 * np.pi
            low = int(np.floor((float(interval.low) - float(value)) / step)) - 1
            high = int(np.ceil((float(interval.high) - float(value)) / step)) + 1
            reach = list(range(low, high + 1))
        choices.append([k for k in reach if interval.has(value + 2 * arb.pi() * k)])
    yield from product(*choices)


def first_leaving(
    legs: Sequence[LegSystem], run: FreeRun, joint: int, interval: JointInterval
) -> Leaving | None:
    """Where ``run`` first leaves the interval of a joint; None if it never does.

    When the time is up, somewhere from there on, not proved.

    Args:
        legs: the equations of each leg.
        run: begins inside.
        joint: its number, from 0.
        interval: in the winding of the run's coordinates.
    """
    for link in run.links:
        if time_is_up():
            return _somewhere(link, joint, False)
        found = _in_link(legs, run, link, joint, interval)
        if found is not None:
            return found
    return None


def _in_link(
    legs: Sequence[LegSystem],
    run: FreeRun,
    link: TubeLink,
    k: int,
    interval: JointInterval,
) -> Leaving | None:
    tube = link.tube
    if tube.low[k] > interval.low and tube.high[k] < interval.high:
        return None
    if tube.trend(k):
        end = run.knots(link)[1]
        inside = interval.has(arb(end.at[k], end.reach[k]))
        if inside:
            return None
        if inside is False:
            return _isolated(legs[link.leg], link, k, interval)
        return _somewhere(link, k, False)
    if tube.length < _BRIEFEST:
        return _somewhere(link, k, False)
    halves = split(legs[link.leg], link)
    if halves is None:
        return _somewhere(link, k, False)
    for half in halves if run.forward else reversed(halves):
        found = _in_link(legs, run, half, k, interval)
        if found is not None:
            return found
    return None


def _isolated(
    system: LegSystem, link: TubeLink, k: int, interval: JointInterval
) -> Leaving:
    """The one place on the link where joint k is at its limit."""
    tube = link.tube
    ends = (link.before.at[k], link.after.at[k])
    low, high = min(ends), max(ends)
    limit = float(interval.high if low < float(interval.high) < high else interval.low)
    row = np.zeros(len(tube.center))
    row[k] = 1.0
    span = link.after.at - link.before.at
    guess = link.before.at + (limit - link.before.at[k]) / span[k] * span
    guess[k] = limit
    y = settled(system, guess, row)
    if y is None:
        return _somewhere(link, k, True)
    y[k] = limit
    knot = knot_at(system, y, beside(row))
    if knot is None or not tube.holds(knot):
        return _somewhere(link, k, True)
    s = link.leg + float(y[-1])
    # the double nearest to the limit is so near: the curve may have to go further
    off = 1e-14 * (1 + abs(limit))
    speed = max(abs(tube.rise_low[-1]), abs(tube.rise_high[-1]))
    own = min(abs(tube.rise_low[k]), abs(tube.rise_high[k]))
    slack = _SLACK * (1 + s) + float(knot.reach[-1]) + off * float(speed / own)
    return Leaving(k, s - slack, s + slack, True, y[:-1])


def _somewhere(link: TubeLink, k: int, proved: bool) -> Leaving:
    low, high = float(link.tube.low[-1]), float(link.tube.high[-1])
    middle = (link.before.at + link.after.at) / 2
    return Leaving(k, link.leg + low, link.leg + high, proved, middle[:-1])
