"""The runs of a path within joint limits, each in every winding of its own.

A run ends where it first leaves the limits; without limits it ends where the free run
does.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from flint import arb
from numpy.typing import NDArray

from cuspaudit.errors import UnableError
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.runs import FreeRun
from cuspaudit.toolpath.following.strands import Followed, turns_between
from cuspaudit.toolpath.known import Known
from cuspaudit.toolpath.limits import (
    MOST_WINDINGS,
    JointInterval,
    Leaving,
    first_leaving,
    windings,
)
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.traced_path import End, Run

__all__ = ["bounded_runs"]

Array = NDArray[np.float64]


def bounded_runs(
    arm: TracedArm,
    legs: Sequence[LegSystem],
    starts: Sequence[Known],
    found: Followed,
    ranges: Sequence[JointInterval | None],
) -> list[Run]:
    """The runs from each start, one for each winding inside the limits.

    Args:
        arm: the arm.
        legs: of the path.
        starts: the postures of the first pose.
        found: the runs without limits.
        ranges: of each joint; None for no limits.

    Raises:
        UnableError: there are too many windings.
    """
    runs: list[Run] = []
    for number, posture in enumerate(starts):
        index = found.starts[number]
        free = None if index is None else found.runs[index]
        if free is None:
            runs += _unfollowed(arm, number, posture)
            continue
        values = [
            arb(x, r) for x, r in zip(free.first.at, free.first.reach, strict=True)
        ]
        # to the posture's own values, in (-pi, pi]
        base = turns_between(arm, posture.values, free.first.at[:-1])
        usual = (0,) * (len(values) - 1) if base is None else tuple(map(int, base))
        inside = list(windings(ranges, arm.balls.revolute, values[:-1], usual))
        if len(runs) + len(inside) > MOST_WINDINGS:
            raise UnableError(
                "trace", f"more than {MOST_WINDINGS} windings; --no-limits"
            )
        leavings = _Leavings(legs, free, ranges)
        ends_in = found.ends.index(index) if index in found.ends else None
        for turns in inside:
            leaving = leavings.first(turns)
            runs.append(_run(arm, number, posture, free, turns, leaving, ends_in))
        if not inside:
            run = _run(arm, number, posture, free, usual, None, ends_in)
            runs.append(_outside(run))
    return runs


def _unfollowed(arm: TracedArm, number: int, posture: Known) -> list[Run]:
    """A singular posture, from which no run starts; or one too near to tell."""
    values = tuple((posture.values * arm.scales)[: arm.joints].tolist())
    end: End = "singular" if posture.sign == 0 else "undecided"
    sure = posture.sign == 0
    turns = (0,) * arm.joints
    sign = posture.sign
    return [Run(number, values, sign, True, end, 0.0, None, values, sure, None, turns)]


class _Leavings:
    """Where a run leaves the limits, by joint and winding; each asked for once."""

    def __init__(
        self,
        legs: Sequence[LegSystem],
        run: FreeRun,
        ranges: Sequence[JointInterval | None],
    ) -> None:
        self._legs, self._run, self._ranges = legs, run, ranges
        self._known: dict[tuple[int, int], Leaving | None] = {}

    def first(self, turns: Sequence[int]) -> list[Leaving]:
        """Those that the run of this winding meets, by growing parameter."""
        found = []
        for joint, (interval, turn) in enumerate(zip(self._ranges, turns, strict=True)):
            if interval is None:
                continue
            key = joint, turn
            if key not in self._known:
                self._known[key] = first_leaving(
                    self._legs, self._run, joint, interval.shifted(turn)
                )
            leaving = self._known[key]
            if leaving is not None:
                found.append(leaving)
        return sorted(found, key=lambda leaving: leaving.low)


def _run(
    arm: TracedArm,
    number: int,
    posture: Known,
    free: FreeRun,
    turns: tuple[int, ...],
    leavings: list[Leaving] | None,
    ends_in: int | None,
) -> Run:
    n = arm.joints
    shift = 2 * np.pi * np.array(turns[:n])
    scales = arm.scales[:n]
    start = free.first.at[:n] * scales + shift
    end, at, last, joint, proved = _free_end(free)
    if leavings:
        leaving = leavings[0]
        others = [other.low for other in leavings[1:]]
        bound = free.end.low if free.end.kind != "path" else np.inf
        if leaving.high < min([*others, bound, np.inf]):
            end, proved = ("limit", True) if leaving.proved else ("undecided", False)
            at, last = (leaving.low + leaving.high) / 2, leaving.posture
            joint = arm.chain.joints[leaving.joint].name
        elif leaving.low <= bound:
            end, at, proved, last = "undecided", leaving.low, False, leaving.posture
    return Run(
        number,
        tuple(start.tolist()),
        posture.sign,
        True,
        end,
        at,
        joint,
        tuple((last[:n] * scales + shift).tolist()),
        proved,
        free,
        turns[:n],
        ends_in if end == "reached" else None,
    )


def _free_end(free: FreeRun) -> tuple[End, float, Array, None, bool]:
    bound = free.end
    if bound.kind == "path":
        return "reached", bound.at, free.last.at, None, True
    end: End = "singular" if bound.kind == "singular" else "undecided"
    return end, bound.at, free.last.at, None, end == "singular"


def _outside(run: Run) -> Run:
    """A run that begins outside the limits, followed without them."""
    values: dict[str, Any] = {k: getattr(run, k) for k in run.__dataclass_fields__}
    return Run(**{**values, "inside": False})
