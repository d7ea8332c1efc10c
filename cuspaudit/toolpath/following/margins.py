"""How near a posture is to a singular one, or to a limit.

What is searched is a singular posture near by: the distance to the nearest one is no
larger. That it is no smaller than some margin is proved in balls
(`certificate.posture_margin`).
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.witness import certificate_of
from cuspaudit.certificate.posture_margin import posture_margin
from cuspaudit.toolpath.following.runs import FreeRun
from cuspaudit.toolpath.following.tube import Knot
from cuspaudit.toolpath.limits import joint_ranges
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.traced_path import Run, TracedPath

__all__ = [
    "limit_margin",
    "proved_distance",
    "recommended",
    "singular_distance",
    "singular_margin",
]

Array = NDArray[np.float64]

_POINTS, _SEARCHED = 24, 4
_STEPS = 30
_SINGULAR = 1e-6
_NUDGE = 1e-6
_LONGEST = 0.5


def determinant(arm: TracedArm, values: Array) -> float:
    """Det J at coordinates of the balls, in doubles."""
    _, turns, speeds = arm.balls.plain(values)
    rows = speeds.T
    if arm.signs is not None:
        rows = np.vstack([rows, arm.signs])
    elif arm.task == "pose":
        rows = np.vstack([rows, turns.T])
    return float(np.linalg.det(rows))


def singular_distance(arm: TracedArm, values: Array) -> float:
    """The distance to a singular posture near by, Euclidean over the joints.

    The point of {det J = 0} nearest to ``values`` is sought by linearising det J again
    and again: its foot on the tangent plane [Hasofer and Lind 1974]. What is found is a
    singular posture; there may be a nearer one.

    Args:
        arm: the arm.
        values: coordinates of the balls: rad, slides in the arm's unit.

    Returns:
        infinite where the search does not settle.
    """
    start = np.array(values, dtype=float)
    here, height = start, abs(determinant(arm, start))
    best = np.inf
    for _ in range(_STEPS):
        value, slope = _with_gradient(arm, here)
        square = float(slope @ slope)
        if abs(value) <= _SINGULAR * height:
            best = min(best, float(np.linalg.norm(here - start)))
        if square == 0.0:
            break
        foot = start + (float(slope @ (here - start)) - value) / square * slope
        step = foot - here
        size = float(np.linalg.norm(step))
        here = here + step * min(1.0, _LONGEST / size if size else 1.0)
        if size < 1e-7:
            break
    return best


def proved_distance(arm: TracedArm, knot: Knot) -> float | None:
    """A lower bound of the distance of a posture to every singular one, rad; proved.

    Euclidean over the joints; None for arms that slide, or where none is proved. The
    bound is proved for the doubles next to the posture, from which it is at most the
    length of the box away.

    Args:
        arm: the arm.
        knot: round the posture.
    """
    here = knot.at[:-1] * arm.scales
    away = float(np.linalg.norm(knot.reach[:-1])) * (1 + 1e-9)
    # the sign is not looked at
    margin = posture_margin(certificate_of(arm.chain, 1, np.array([here, here])))
    if margin is None or margin <= away:
        return None
    return math.nextafter(margin - away, 0.0)


def singular_margin(arm: TracedArm, run: Run) -> float:
    """The smallest `singular_distance` along a run; 0 where it dies of one."""
    if run.free is None or run.end == "singular":
        return 0.0
    profile = _profile(arm, run.free)
    return float(min(profile[profile[:, 0] <= run.at][:, 1], default=profile[0, 1]))


@lru_cache(maxsize=64)
def _profile(arm: TracedArm, free: FreeRun) -> Array:
    """Parameters along a run, and the distance to a singular posture near each.

    To first order at most places, searched at the nearest of them.
    """
    rows = free.points
    chosen = rows[np.unique(np.linspace(0, len(rows) - 1, _POINTS).astype(int))]
    near = np.array([_first_order(arm, row[:-1]) for row in chosen])
    for k in np.argsort(near)[:_SEARCHED]:
        found = singular_distance(arm, chosen[k, :-1])
        near[k] = found if np.isfinite(found) else near[k]
    return np.column_stack([chosen[:, -1], near])


def limit_margin(arm: TracedArm, run: Run) -> float | None:
    """How near the run comes to a limit; None without any, 0 where it dies of one."""
    if run.end == "limit":
        return 0.0
    smallest: float | None = None
    points = _coordinates(arm, run) + 2 * np.pi * np.where(
        arm.turning, np.array([*run.turns, *[0] * (len(arm.turning) - arm.joints)]), 0
    )
    for k, interval in enumerate(joint_ranges(arm.chain.joints, arm.scales)):
        if interval is not None:
            room = min(
                float(points[:, k].min()) - float(interval.low),
                float(interval.high) - float(points[:, k].max()),
            )
            smallest = room if smallest is None else min(smallest, room)
    return None if smallest is None else max(0.0, smallest)


def recommended(trace: TracedPath) -> int | None:
    """The run to start in: of those that reach the end, the one with the most room.

    Room is the smaller of the distance to a singular posture and to a limit.
    """
    best: tuple[float, int] | None = None
    for k, run in enumerate(trace.runs):
        if run.end != "reached" or not run.inside:
            continue
        room = singular_margin(trace.arm, run)
        if trace.limited:
            own = limit_margin(trace.arm, run)
            room = room if own is None else min(room, own)
        if best is None or room > best[0]:
            best = room, k
    return None if best is None else best[1]


def _coordinates(arm: TracedArm, run: Run) -> Array:
    """Coordinates of the balls along the run, as far as it goes."""
    if run.free is None:
        extra = len(arm.turning) - arm.joints
        return np.array([[*run.start, *[0.0] * extra]]) / arm.scales
    rows = run.free.points
    kept = rows[rows[:, -1] <= run.at]
    return np.asarray((kept if len(kept) else rows[:1])[:, :-1])


def _first_order(arm: TracedArm, values: Array) -> float:
    value, slope = _with_gradient(arm, values)
    size = float(np.linalg.norm(slope))
    return abs(value) / size if size else np.inf


def _with_gradient(arm: TracedArm, values: Array) -> tuple[float, Array]:
    steps = np.eye(len(values)) * _NUDGE
    slope = [
        (determinant(arm, values + step) - determinant(arm, values - step))
        / (2 * _NUDGE)
        for step in steps
    ]
    return determinant(arm, values), np.array(slope)
