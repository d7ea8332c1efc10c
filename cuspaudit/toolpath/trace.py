"""The trace of a tool path: what becomes of every posture of its first pose.

The strands of the path give its runs without limits (`strands`, `runs`). Within limits
a run ends where it first leaves them, in each winding of its own. On a closed path the
runs that reach the end permute the postures, up to whole turns.

**Theorem (T6).** A run of a closed path that ends in another posture, not the same
modulo whole turns, is a nonsingular path between two postures of one pose: the arm is
cuspidal, within its limits if the run is. *Proof.* That is the definition; its ends are
in one aspect, and the run keeps det J away from 0. QED.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from flint import arb, ctx
from numpy.typing import NDArray

from cuspaudit.errors import CrossCheckError, UnableError
from cuspaudit.runtime.clock import time_is_up, time_limit
from cuspaudit.toolpath.ball_arm import BITS
from cuspaudit.toolpath.births import complete_runs
from cuspaudit.toolpath.leg_system import LegSystem
from cuspaudit.toolpath.limits import (
    MOST_WINDINGS,
    Leaving,
    Range,
    first_leaving,
    joint_ranges,
    windings,
)
from cuspaudit.toolpath.runs import FreeRun
from cuspaudit.toolpath.starts import Solved, solve_pose
from cuspaudit.toolpath.strands import (
    Followed,
    Known,
    follow_path,
    known_posture,
    known_postures,
    turns_between,
)
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import ToolPath

__all__ = ["Run", "Trace", "trace_path"]

Array = NDArray[np.float64]
End = Literal["reached", "singular", "limit", "undecided"]


@dataclass(frozen=True, eq=False)
class Run:
    """A posture of the first pose in one winding, and what becomes of it.

    Attributes:
        posture: the number of the posture among those of the first pose, from 0.
        start: joint values of the robot, rad or the chain's unit.
        sign: of det J along the run; 0 where the posture is singular.
        inside: whether the winding lies within the limits; a run that does not is
            followed without them.
        end: "reached", or of what it dies; "undecided" where that is not proved.
        at: where, in waypoints: 1.37 is 37 % of the second leg.
        joint: the joint whose limit it meets, or None.
        last: joint values there.
        proved: whether all of this is.
        free: the run without limits; None where the posture is singular.
        turns: whole turns added to the free run, one a joint.
        ends_in: the posture of the last pose that it reaches, or None.
    """

    posture: int
    start: tuple[float, ...]
    sign: int | None
    inside: bool
    end: End
    at: float
    joint: str | None
    last: tuple[float, ...]
    proved: bool
    free: FreeRun | None
    turns: tuple[int, ...]
    ends_in: int | None = None

    def points(self, scales: Array) -> Array:
        """Joint values of the robot and the parameter along it, (m, n + 1)."""
        n = len(self.start)
        if self.free is None:
            return np.array([[*self.start, 0.0]])
        rows = self.free.points
        keep = rows[:, -1] < self.at if self.end != "reached" else rows[:, -1] >= 0
        values = rows[keep][:, :n] * scales[:n] + 2 * np.pi * np.array(self.turns)
        found = np.column_stack([values, rows[keep][:, -1]])
        return np.vstack([found, [*self.last, self.at]])


@dataclass(frozen=True, eq=False)
class Birth:
    """A run that begins on the way.

    Attributes:
        at: where, in waypoints.
        sign: of det J.
        end: "reached", "singular" or "undecided", limits left out of account.
        until: where it ends.
        first: joint values near its birth.
    """

    at: float
    sign: int | None
    end: str
    until: float
    first: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Trace:
    """What becomes of every posture of the first pose of a tool path.

    Attributes:
        arm: the arm.
        path: the tool path.
        limited: whether limits counted.
        runs: in the order of the postures, a run for each winding inside the limits,
            or one outside them.
        born: the runs that begin on the way.
        first: the postures of the first pose.
        last: those of the last pose.
        permutation: for each run of a closed path the run in whose posture and
            winding it ends, or None; None for an open path.
        turns: the whole turns that are left, for each run, or None.
        births_complete: whether no other run is born on the way, proved.
        remarks: what a reader should know.
    """

    arm: TracedArm
    path: ToolPath
    limited: bool
    runs: tuple[Run, ...]
    born: tuple[Birth, ...]
    first: Solved
    last: Solved
    permutation: tuple[int | None, ...] | None
    turns: tuple[tuple[int, ...] | None, ...] | None
    births_complete: bool
    remarks: tuple[str, ...]

    @property
    def closed(self) -> bool:
        """Whether the path ends where it begins."""
        return self.path.is_closed

    @property
    def changing(self) -> list[int]:
        """The runs that end in another posture: witnesses of cuspidality."""
        if self.permutation is None:
            return []
        return [
            k
            for k, to in enumerate(self.permutation)
            if to is not None
            and self.runs[to].posture != self.runs[k].posture
            and self.runs[k].proved
            and _apart(self.arm, self.runs[to].start, self.runs[k].start)
        ]

    @property
    def verdict_from_path(self) -> str | None:
        """``cuspidal`` where a run changes its posture, proved; else None."""
        return "cuspidal" if self.changing else None


def trace_path(
    arm: TracedArm,
    path: ToolPath,
    limited: bool = True,
    seed: int = 0,
    progress: Callable[[str], None] = lambda step: None,
    timeout: float | None = None,
) -> Trace:
    """Follow a tool path from every posture of its first pose.

    Args:
        arm: an arm with a square task.
        path: with what the task needs.
        limited: whether the limits of the joints count.
        seed: of the exact solvers.
        progress: called with the name of each step.
        timeout: seconds after which no run is followed further: what is not known by
            then is undecided.

    Raises:
        UnableError: there are too many windings.
        CrossCheckError: two complete lists contradict each other.
    """
    with ctx.workprec(BITS), time_limit(timeout):
        progress("postures")
        legs = [arm.system(a, b) for a, b in pairwise(path.poses)]
        first = solve_pose(arm, path.poses[0], seed)
        last = first if path.is_closed else solve_pose(arm, path.poses[-1], seed)
        starts = _starts(arm, path, legs, first)
        ends = known_postures(arm, legs[-1], last, 1.0)
        progress("runs")
        found = follow_path(arm, legs, starts, ends, progress)
        progress("births")
        complete, remarks = complete_runs(arm, path, legs, first, last, found)
        if complete and not _all_met(found, starts, ends):
            complete = False
            remarks.append("a posture of the first or last pose could not be followed")
        if time_is_up():
            complete = False
            remarks.append("the time was up: what is not known by then is undecided")
        else:
            _check(arm, first, last, found, starts, ends)
        progress("limits")
        ranges = _ranges(arm, limited)
        runs = _all_runs(arm, legs, starts, found, ranges)
        sigma, turns = _permutation(arm, path, runs, ranges)
        return Trace(
            arm,
            path,
            limited,
            tuple(runs),
            tuple(_births(arm, found)),
            first,
            last,
            sigma,
            turns,
            complete,
            tuple(remarks),
        )


def _starts(
    arm: TracedArm, path: ToolPath, legs: Sequence[LegSystem], solved: Solved
) -> list[Known]:
    """The postures of the first pose; at least the one that the path came from."""
    known = known_postures(arm, legs[0], solved, 0.0)
    if path.joints is not None and not solved.complete:
        extra = len(arm.chain.joints) - arm.joints
        own = known_posture(arm, legs[0], [*path.joints[0], *[0.0] * extra], 0.0)
        met = any(turns_between(arm, own.values, k.values) is not None for k in known)
        if own.knot is not None and not met:
            known.append(own)
    return known


def _apart(arm: TracedArm, a: Sequence[float], b: Sequence[float]) -> bool:
    """Whether two postures, known to 1e-10, are not the same up to whole turns."""
    gap = np.array(a) - np.array(b)
    turns = np.where(arm.turning[: arm.joints], np.round(gap / (2 * np.pi)), 0.0)
    return bool(
        np.abs((gap - 2 * np.pi * turns) / arm.scales[: arm.joints]).max() > 1e-9
    )


def _all_met(found: Followed, starts: Sequence[Known], ends: Sequence[Known]) -> bool:
    """Whether each posture of the two outer poses has its run, or is singular."""
    pairs = [
        *zip(starts, found.starts, strict=True),
        *zip(ends, found.ends, strict=True),
    ]
    return all(known.sign == 0 or run is not None for known, run in pairs)


def _ranges(arm: TracedArm, limited: bool) -> list[Range | None]:
    if not limited:
        return [None] * len(arm.chain.joints)
    return joint_ranges(arm.chain.joints, arm.scales)


def _all_runs(
    arm: TracedArm,
    legs: Sequence[LegSystem],
    starts: Sequence[Known],
    found: Followed,
    ranges: Sequence[Range | None],
) -> list[Run]:
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
        self, legs: Sequence[LegSystem], run: FreeRun, ranges: Sequence[Range | None]
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


def _births(arm: TracedArm, found: Followed) -> list[Birth]:
    result = []
    for run in found.runs:
        if run.begin.kind == "path" and run.begin.at == 0.0:
            continue
        middle = run.knots(run.links[len(run.links) // 2])[1]
        determinant = arm.determinant(middle.balls()[:-1])
        sign = int(determinant > 0) - int(determinant < 0) or None
        first = (run.first.at[:-1] * arm.scales)[: arm.joints]
        end = "reached" if run.end.kind == "path" else run.end.kind
        result.append(Birth(run.begin.at, sign, end, run.end.at, tuple(first.tolist())))
    return sorted(result, key=lambda birth: birth.at)


def _permutation(
    arm: TracedArm, path: ToolPath, runs: Sequence[Run], ranges: Sequence[Range | None]
) -> tuple[tuple[int | None, ...] | None, tuple[tuple[int, ...] | None, ...] | None]:
    """For each run of a closed path the run it ends in, and the turns left over.

    Of the runs in windings of the posture that it ends in, the one that differs by the
    fewest turns, so by none on limited joints if it is among them.
    """
    if not path.is_closed:
        return None, None
    sigma: list[int | None] = []
    left: list[tuple[int, ...] | None] = []
    for run in runs:
        best: tuple[int, int] | None = None
        turns: tuple[int, ...] | None = None
        if run.end == "reached" and run.ends_in is not None:
            for k, other in enumerate(runs):
                if other.posture != run.ends_in or other.inside != run.inside:
                    continue
                gap = (np.array(run.last) - np.array(other.start)) / (2 * np.pi)
                whole = np.where(arm.turning[: arm.joints], np.round(gap), 0)
                size = int(np.abs(whole).sum())
                if best is None or size < best[0]:
                    best, turns = (size, k), tuple(int(x) for x in whole)
        sigma.append(None if best is None else best[1])
        left.append(turns)
    return tuple(sigma), tuple(left)


def _check(
    arm: TracedArm,
    first: Solved,
    last: Solved,
    found: Followed,
    starts: Sequence[Known],
    ends: Sequence[Known],
) -> None:
    """Conservation: what two complete lists must agree in.

    Raises:
        CrossCheckError: they do not; then one of them has a bug.
    """
    undecided = any("undecided" in (r.begin.kind, r.end.kind) for r in found.runs)
    known = all(k.knot is not None for k in (*starts, *ends))
    if undecided or not known:
        return
    for solved, matched, side in (
        (first, found.starts, "first"),
        (last, found.ends, "last"),
    ):
        if not solved.complete:
            continue
        touching = sum(
            (run.begin if side == "first" else run.end).kind == "path"
            for run in found.runs
        )
        if None in matched or touching != len(matched):
            raise CrossCheckError(
                f"{touching} runs at the {side} pose, which has {len(matched)} postures"
            )
        signs = [k.sign for k in (starts if side == "first" else ends)]
        if all(arm.balls.revolute) and signs.count(1) != signs.count(-1):
            raise CrossCheckError(
                f"the {side} pose has {signs.count(1)} postures of sign + and "
                f"{signs.count(-1)} of sign -"
            )
