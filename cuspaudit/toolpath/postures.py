"""All postures of one pose, side by side."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from flint import arb, ctx

from cuspaudit.runtime.clock import time_limit
from cuspaudit.toolpath.aspect_labels import aspect_labels
from cuspaudit.toolpath.ball_arm import BITS
from cuspaudit.toolpath.following.margins import (
    determinant,
    proved_distance,
    singular_distance,
)
from cuspaudit.toolpath.following.starts import solve_pose
from cuspaudit.toolpath.following.strands import known_postures
from cuspaudit.toolpath.joint_pose import JointValue, float_values, value_balls
from cuspaudit.toolpath.known import Known
from cuspaudit.toolpath.limits import joint_ranges, windings
from cuspaudit.toolpath.same_aspect import sign_near
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import Pose

__all__ = ["Posture", "PostureList", "held_to", "list_postures", "postures_record"]

SCHEMA = "cuspaudit/postures/1"
_SAME = 1e-7
_TORN = (
    "the joint vector is singular, or nearly so: its pose rounded to 1e-15 is another "
    "pose, whose postures these are"
)


@dataclass(frozen=True)
class Posture:
    """One posture of the pose.

    Attributes:
        values: joint values of the robot, angles in (-pi, pi].
        determinant: det J, nearly; slides in the longest fixed step of the arm.
        sign: of det J, proved; 0 where it is proved to vanish, None where neither is.
        aspect: the number of its aspect, from 1, in the order of this list; None where
            it is not proved.
        inside: whether a winding of it lies within the limits.
        windings: those that do, as whole turns to add to ``values``.
        nearest_singular: distance to a singular posture near by, rad; searched.
        nonsingular_within: no posture nearer than that is singular, rad, proved; None
            for arms that slide, or where nothing is proved.
        proved: whether a ball holds exactly one posture of the arm's own numbers here.
    """

    values: tuple[float, ...]
    determinant: float
    sign: int | None
    aspect: int | None
    inside: bool
    windings: tuple[tuple[int, ...], ...]
    nearest_singular: float
    nonsingular_within: float | None
    proved: bool


@dataclass(frozen=True, eq=False)
class PostureList:
    """The postures of a pose, and what is proved about the list.

    Attributes:
        arm: the arm.
        pose: the pose.
        postures: sorted by aspect, then by the sign of det J.
        complete: whether no other posture exists, proved.
        whole_curves: whether infinitely many complex postures have the pose: real ones
            may form whole curves. Of those listed the proved ones are isolated, the
            others may be points of such a curve.
        aspects: how many the arm has, proved; None where not.
        grounds: what ``complete`` rests on.
        why: why the list is not complete, or "".
    """

    arm: TracedArm
    pose: Pose
    postures: tuple[Posture, ...]
    complete: bool
    whole_curves: bool
    aspects: int | None
    grounds: tuple[str, ...]
    why: str


def list_postures(
    arm: TracedArm,
    pose: Pose,
    seed: int = 0,
    progress: Callable[[str], None] = lambda step: None,
    timeout: float | None = None,
) -> PostureList:
    """All postures of a pose.

    Args:
        arm: an arm with a square task.
        pose: with what the task needs.
        seed: of the exact solver.
        progress: called with the name of each step.
        timeout: seconds after which no further step is begun; the list may not be
            complete then, and its aspects not told.

    Raises:
        UnableError: the tip of a four-joint arm never points so.
    """
    with ctx.workprec(BITS), time_limit(timeout):
        progress("postures")
        solved = solve_pose(arm, pose, seed)
        progress("aspects")
        labels = aspect_labels(arm)
        progress("distances")
        system = arm.system(pose, pose)
        found: list[tuple[Known, Hashable | None]] = []
        for known in known_postures(arm, system, solved, 0.0):
            label = None
            if known.knot is not None and labels is not None:
                label = labels.label(_balls(arm, known))
            found.append((known, label))
        order = sorted(found, key=lambda pair: -(pair[0].sign or 0))
        names = {
            label: number
            for number, label in enumerate(
                dict.fromkeys(label for _, label in order if label is not None), 1
            )
        }
        order.sort(key=lambda pair: names.get(pair[1], 99))
        postures = tuple(
            _posture(arm, known, names.get(label)) for known, label in order
        )
    return PostureList(
        arm,
        pose,
        postures,
        solved.complete,
        solved.whole_curves,
        None if labels is None else labels.count,
        solved.grounds,
        solved.why,
    )


def held_to(found: PostureList, values: Sequence[JointValue]) -> PostureList:
    """The list, where the joint vector that its pose was taken from is in it.

    The pose of a joint vector is rounded to 1e-15. At a regular posture this moves the
    postures by about as much. At a singular one it may tear whole curves of postures,
    or two that coincide, into others: then the list is one of another pose, and is not
    called complete.

    Args:
        found: the postures of `pose_of_joints`.
        values: the joint vector.
    """
    given, arm = np.array(float_values(values)), found.arm
    n = arm.joints
    turning, scales = arm.turning[:n], arm.scales[:n]
    with ctx.workprec(BITS):
        extra = [arb(0)] * (len(arm.chain.joints) - n)
        is_regular = sign_near(arm, [*value_balls(values), *extra]) is not None
    for posture in found.postures:
        if not is_regular and posture.sign != 0:
            continue
        gap = np.array(posture.values) - given
        gap = np.where(turning, 2 * np.sin(gap / 2), gap / scales)
        if np.abs(gap).max() < _SAME:
            return found
    return replace(found, complete=False, why=_TORN) if found.complete else found


def _balls(arm: TracedArm, known: Known) -> list[arb]:
    assert known.knot is not None
    balls = known.knot.balls()[:-1]
    return [ball * scale for ball, scale in zip(balls, arm.balls.scales, strict=True)]


def _posture(arm: TracedArm, known: Known, aspect: int | None) -> Posture:
    n = arm.joints
    ranges = joint_ranges(arm.chain.joints, arm.scales)
    reach = 0.0 if known.knot is None else float(known.knot.reach.max())
    values, none = [arb(x, reach) for x in known.values], [0] * len(known.values)
    every = windings(ranges, arm.balls.revolute, values, none)
    inside = [turns[:n] for turns in every]
    return Posture(
        tuple((known.values * arm.scales + 0.0)[:n].tolist()),
        determinant(arm, known.values),
        known.sign,
        aspect,
        bool(inside),
        tuple(inside),
        singular_distance(arm, known.values),
        None if known.knot is None else proved_distance(arm, known.knot),
        known.knot is not None,
    )


def postures_record(found: PostureList, name: str, file: str) -> dict[str, Any]:
    """The list as a JSON record, schema ``cuspaudit/postures/1``."""
    chain = found.arm.robot_chain
    return {
        "schema": SCHEMA,
        "robot": {
            "name": name,
            "file": file,
            "joints": [joint.name for joint in chain.joints],
            "task": chain.task,
            "unit": chain.unit,
            "exact": found.arm.model.is_exact,
        },
        "pose": {
            "position": [float(x) for x in found.pose.position],
            "quaternion": _unit(found.pose),
        },
        "postures": [
            {
                "values": list(posture.values),
                "determinant": posture.determinant,
                "sign": posture.sign,
                "aspect": posture.aspect,
                "inside": posture.inside,
                "windings": [list(turns) for turns in posture.windings],
                "nearest_singular": _finite(posture.nearest_singular),
                "nonsingular_within": posture.nonsingular_within,
                "proved": posture.proved,
            }
            for posture in found.postures
        ],
        "complete": found.complete,
        "whole_curves": found.whole_curves,
        "aspects": found.aspects,
        "rests_on": list(found.grounds),
        "why": found.why or None,
    }


def _unit(pose: Pose) -> list[float] | None:
    if pose.quaternion is None:
        return None
    entries: Sequence[float] = [float(x) for x in pose.quaternion]
    size = float(np.linalg.norm(entries))
    return [x / size for x in entries]


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None
