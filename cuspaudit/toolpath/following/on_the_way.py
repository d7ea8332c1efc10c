"""Runs that meet neither end of a path, for arms of six joints: looked for on the way.

Such runs are born and die together, so the curve of postures that they are part of is
closed. At many places of the path the postures are solved in floating point: at the
waypoints, evenly between them, and beside the events of the runs that are known. A
posture that is proved and lies on no known run is followed round its curve, in proved
tubes; so each run that is added is proved. That there are no others is not: a curve
that lies between two of the places is not seen.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence

import numpy as np
from flint import arb
from numpy.typing import NDArray

from cuspaudit.errors import UnableError
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.runtime.clock import time_is_up
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.runs import loop_runs
from cuspaudit.toolpath.following.strand import TubeLink, looped
from cuspaudit.toolpath.following.strands import Followed, has_run, sort_links
from cuspaudit.toolpath.known import known_posture
from cuspaudit.toolpath.traced_arm import TracedArm

__all__ = ["look_on_the_way"]

Array = NDArray[np.float64]
Place = tuple[int, float]

_PLACES, _MOST_A_LEG, _BESIDE = 160, 9, 2e-3


def look_on_the_way(
    arm: TracedArm, legs: Sequence[LegSystem], found: Followed
) -> list[str]:
    """Add the runs that are met to ``found``; what a reader should know.

    Args:
        arm: six joints that turn, a virtual one included; of another none are looked
            for, which is said.
        legs: the equations of the path.
        found: the runs that meet its ends.
    """
    try:
        solver = PostureSolver.of(arm.chain)
    except UnableError:
        return ["runs that are born and die on the way are not looked for"]
    places = _places(len(legs), found)
    links: dict[int, list[TubeLink]] = defaultdict(list)
    sort_links(found.runs, links)
    met, lost = 0, 0
    for (leg, s), postures in zip(places, _solved(solver, legs, places), strict=True):
        for posture in postures:
            known = known_posture(arm, legs[leg], posture.tolist(), s)
            if known.knot is None or has_run(arm, links[leg], known.knot):
                continue
            if time_is_up():
                return ["the time was up while runs born on the way were looked for"]
            loop = looped(legs, leg, known.knot)
            runs = [] if loop is None else loop_runs(legs, loop)
            found.runs += runs
            sort_links(runs, links)
            met, lost = met + len(runs), lost + (not runs)
    remarks = [
        "runs that are born and die on the way were looked for, in floating point, at "
        f"{len(places)} places of the path: {met or 'none'} met; others may exist"
    ]
    if lost:
        remarks.append(
            f"{lost} postures on the way are on no run that could be followed"
        )
    return remarks


def _places(legs: int, found: Followed) -> list[Place]:
    """Where to look: legs, and parameters on them."""
    each = max(1, min(_MOST_A_LEG, _PLACES // legs))
    step = max(1, math.ceil(legs / _PLACES))
    places = {
        (leg, part / (each + 1))
        for leg in range(0, legs, step)
        for part in range(0 if leg else 1, each + 1)
    }
    for run in found.runs:
        for bound in (run.begin, run.end):
            if bound.kind == "path":
                continue
            for at in (bound.low - _BESIDE, bound.high + _BESIDE):
                leg = int(at)
                if at > 0 and leg < legs:
                    places.add((leg, at - leg))
    return sorted(places)


def _solved(
    solver: PostureSolver, legs: Sequence[LegSystem], places: Sequence[Place]
) -> list[Array]:
    """The postures that floating point finds at each place."""
    goals = []
    for leg, s in places:
        goal, pose = legs[leg].goal, np.eye(4)
        back = goal.back(arb(s)).tolist()
        pose[:3, :3] = np.array([[float(x) for x in row] for row in back]).T
        pose[:3, 3] = [float(x) / solver.scale for x in goal.place(arb(s))]
        goals.append(pose)
    try:
        return solver.solve(np.array(goals))
    except UnableError:
        return [np.zeros((0, 6))] * len(places)
