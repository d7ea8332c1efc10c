"""All strands of a tool path: from its start, from its end, and those found between.

A strand from the start may come back to the start: then two runs die together, and the
second posture needs no strand of its own. The postures of the last pose that no strand
has reached are followed back: runs that are born on the way.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.runs import FreeRun, runs_of
from cuspaudit.toolpath.following.starts import Solved
from cuspaudit.toolpath.following.strand import TubeLink, followed, unwound
from cuspaudit.toolpath.following.tube import Knot
from cuspaudit.toolpath.known import Known, known_posture
from cuspaudit.toolpath.traced_arm import TracedArm

__all__ = [
    "Followed",
    "follow_path",
    "has_run",
    "known_postures",
    "sort_links",
]

Array = NDArray[np.float64]


@dataclass(eq=False)
class Followed:
    """What following the strands gave.

    Attributes:
        runs: all runs found.
        starts: for each posture of the first pose, the number of its run or None.
        ends: for each posture of the last pose likewise.
    """

    runs: list[FreeRun] = field(default_factory=list)
    starts: list[int | None] = field(default_factory=list)
    ends: list[int | None] = field(default_factory=list)


def known_postures(
    arm: TracedArm, system: LegSystem, solved: Solved, s: float
) -> list[Known]:
    """The postures of a pose, each with a knot where it is regular.

    A knot is that of the posture: its box holds the solver's ball, where the solver is
    exact. Two postures of a complete list have two knots then.

    Args:
        arm: the arm.
        system: of a leg with this pose at one end.
        solved: the postures of the pose.
        s: 0.0 or 1.0, the end of the leg.
    """
    result = []
    for posture in solved.postures:
        middle = [float(v.mid()) for v in posture.values]
        known = known_posture(arm, system, middle, s, posture.sign)
        if solved.complete and known.knot is not None:
            boxes = zip(known.knot.balls(), posture.values, arm.scales, strict=False)
            if not all(box.contains(ball / scale) for box, ball, scale in boxes):
                known = Known(None, known.values, posture.sign)
        result.append(known)
    return result


def follow_path(
    arm: TracedArm,
    legs: Sequence[LegSystem],
    first: Sequence[Known],
    last: Sequence[Known],
    progress: Callable[[str], None] = lambda step: None,
) -> Followed:
    """The strands from every posture of the first pose, then those of the last."""
    result = Followed([], [None] * len(first), [None] * len(last))
    for index, posture in enumerate(first):
        progress(f"runs: from posture {index + 1} of {len(first)}")
        if result.starts[index] is None and posture.knot is not None:
            _follow(arm, legs, posture.knot, True, first, last, result)
    for index, posture in enumerate(last):
        progress(f"runs: back from posture {index + 1} of {len(last)}")
        if result.ends[index] is None and posture.knot is not None:
            _follow(arm, legs, posture.knot, False, first, last, result)
    return result


def _follow(
    arm: TracedArm,
    legs: Sequence[LegSystem],
    knot: Knot,
    forward: bool,
    first: Sequence[Known],
    last: Sequence[Known],
    result: Followed,
) -> None:
    strand = followed(legs, 0 if forward else len(legs) - 1, knot, forward)
    for run in runs_of(legs, strand, forward):
        number = len(result.runs)
        result.runs.append(run)
        if run.begin.kind == "path":
            index = identified(arm, run, first, at_end=False)
            if index is not None:
                result.starts[index] = number
        if run.end.kind == "path":
            index = identified(arm, run, last, at_end=True)
            if index is not None:
                result.ends[index] = number


def identified(
    arm: TracedArm, run: FreeRun, postures: Sequence[Known], at_end: bool
) -> int | None:
    """Which of the postures, up to whole turns, a run begins or ends in; proved.

    On the outer tube of the run s is monotone, so that its curve has one zero at that
    parameter. If the tube holds a knot of the posture, turned by whole turns, the two
    are one.
    """
    link = run.links[-1 if at_end else 0]
    own = run.last if at_end else run.first
    for index, posture in enumerate(postures):
        if posture.knot is None:
            continue
        if turns_between(arm, own.at[:-1], posture.knot.at[:-1]) is None:
            continue
        same = unwound(arm.balls, posture.knot, link.tube)
        at = same.at.copy()
        at[-1] = own.at[-1]
        if link.tube.holds(Knot(at, same.reach)):
            return index
    return None


def turns_between(arm: TracedArm, a: Array, b: Array) -> Array | None:
    """The whole turns from b to a, if they are nearly that; 0 for slides."""
    turns = np.where(arm.turning, np.round((a - b) / (2 * np.pi)), 0.0)
    return turns if np.abs(a - b - 2 * np.pi * turns).max() < 1e-6 else None


def sort_links(runs: Sequence[FreeRun], links: dict[int, list[TubeLink]]) -> None:
    """Add the links of runs to those of their legs."""
    for run in runs:
        for link in run.links:
            links[link.leg].append(link)


def has_run(arm: TracedArm, links: Sequence[TubeLink], knot: Knot) -> bool:
    """Whether the posture in a knot is on a run, proved: in a tube of one of its links.

    There s is monotone. The knot is between the two of the link, as the tube reaches
    beyond them.
    """
    s = float(knot.at[-1])
    for link in links:
        ends = float(link.before.at[-1]), float(link.after.at[-1])
        if not min(ends) <= s <= max(ends):
            continue
        if link.tube.holds(unwound(arm.balls, knot, link.tube)):
            return True
    return False
