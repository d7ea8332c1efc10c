"""Paths of all joints inside limits, over a path of the joints that move det J.

The first joint (of a pose task also the last) shifts both ends of a path alike: only
the difference of its end values counts, and the path goes from one side of the middle
of its range to the other. A wrist keeps still while the first three joints move, then
turns on one side of its singularity; where it stands is tried, as its own limits allow.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import shortest_turn
from cuspaudit.auditing.search.cusps import Interval
from cuspaudit.auditing.search.lift import wrist_at, wrist_middle, wrist_spread
from cuspaudit.errors import RetryableError
from cuspaudit.robot.chain import Chain
from cuspaudit.runtime.clock import check_time

__all__ = ["centred", "lift_wrist_inside"]

Array = NDArray[np.float64]

_TRIES = 48
_ROOMY = 0.3
_TURN = 2 * math.pi


def centred(path: Array, joint: int, limits: Sequence[Interval]) -> Array:
    """The path with a joint that moves no det J about the middle of its range."""
    pair = limits[joint]
    if pair is None:
        return path
    path = path.copy()
    ends = path[0, joint] + path[-1, joint]
    path[:, joint] += (pair[0] + pair[1] - ends) / 2
    return path


@dataclass(frozen=True)
class _Turned:
    """A wrist at both ends of a path, and its least room and spread."""

    first: Array
    last: Array
    room: float


def lift_wrist_inside(
    chain: Chain, regional: Array, limits: Sequence[Interval], seed: int = 0
) -> Array:
    """The path of six joints over a path of the first three, (m + 1, 6).

    Args:
        chain: six joints whose last three axes meet.
        regional: (m, 3), inside their limits.
        limits: of all six joints.
        seed: of the values at which the wrist is tried.

    Raises:
        RetryableError: no wrist was met that brings the hand back inside its limits.
    """
    middle = wrist_middle(chain, regional[0])
    rng = np.random.default_rng(seed)
    best: _Turned | None = None
    for number in range(_TRIES):
        check_time("limits: wrist")
        side = middle + math.pi * (number % 2)
        found = _tried(chain, regional, limits, side, rng.random(2))
        if found is not None and (best is None or found.room > best.room):
            best = found
        if best is not None and best.room > _ROOMY:
            break
    if best is None:
        raise RetryableError("no wrist was met that brings the hand back in its limits")
    still = np.tile(best.first, (len(regional), 1))
    last = np.r_[regional[-1], best.last]
    return np.vstack([np.column_stack([regional, still]), last])


def _tried(
    chain: Chain,
    regional: Array,
    limits: Sequence[Interval],
    side: float,
    shares: Array,
) -> _Turned | None:
    """The wrist that starts at some share of the ranges of joints 4 and 5."""
    fourth = limits[3] or (-math.pi, math.pi)
    fifth = _lobe(side, limits[4])
    if fifth is None:
        return None
    start = np.array(
        [
            low + share * (high - low)
            for (low, high), share in zip((fourth, fifth), shares, strict=True)
        ]
        + [0.0]
    )
    end = wrist_at(chain, np.r_[regional[0], start], regional[-1], side)
    if end is None:
        return None
    end[1] += _TURN * round((start[1] - end[1]) / _TURN)
    end[0] = _nearest(end[0], start[0], limits[3])
    turn = float(shortest_turn(end[2:])[0])
    pair = limits[5]
    centre = 0.0 if pair is None else (pair[0] + pair[1]) / 2
    start[2], end[2] = centre - turn / 2, centre + turn / 2
    room = _room(np.array([start, end]), [limits[3], fifth, pair])
    spread = min(wrist_spread(np.r_[regional[0], w], side) for w in (start, end))
    return _Turned(start, end, min(room, spread)) if min(room, spread) > 0 else None


def _lobe(side: float, pair: Interval) -> tuple[float, float] | None:
    """The largest part of joint 5's range with one sign of its sine about ``side``."""
    if pair is None:
        return side - math.pi / 2, side + math.pi / 2
    first = math.floor((pair[0] - side) / _TURN)
    lobes = []
    for turns in range(first, math.ceil((pair[1] - side) / _TURN) + 1):
        centre = side + _TURN * turns
        low, high = (
            max(pair[0], centre - math.pi / 2),
            min(pair[1], centre + math.pi / 2),
        )
        lobes.append((high - low, low, high))
    width, low, high = max(lobes, default=(0.0, 0.0, 0.0))
    return (low, high) if width > 0 else None


def _nearest(value: float, wanted: float, pair: Interval) -> float:
    """The winding of a value inside limits that is nearest to another value."""
    near = value + _TURN * round((wanted - value) / _TURN)
    if pair is None:
        return near
    inside = [v for v in (near, near - _TURN, near + _TURN) if pair[0] < v < pair[1]]
    return min(inside, key=lambda v: abs(v - wanted), default=near)


def _room(wrists: Array, limits: Sequence[Interval]) -> float:
    """The least distance of the wrists to a limit, at most 1."""
    room = 1.0
    for column, pair in zip(wrists.T, limits, strict=True):
        if pair is not None:
            room = min(room, column.min() - pair[0], pair[1] - column.max())
    return float(room)
