"""Which task a chain has, and which joints are locked so that it is square."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from cuspaudit.robot.axes import unit_axis
from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Task,
    Translation,
    Vector,
)
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.numbers import parse_angle, parse_length
from cuspaudit.robot.place import Place, listing, quoted

__all__ = [
    "DIMENSIONS",
    "check_limits",
    "default_task",
    "lock",
    "parse_task",
]

_TURN = 2 * math.pi
_DEFAULTS = (math.pi / 2, math.pi)

DIMENSIONS: dict[Task, int] = {
    "position": 3,
    "position-and-angle": 4,
    "position-and-x-axis": 5,
    "position-and-y-axis": 5,
    "position-and-z-axis": 5,
    "pose": 6,
}
_OF_JOINTS: dict[int, Task] = {4: "position-and-angle", 5: "position-and-z-axis"}


def default_task(joints: int) -> Task:
    """The task of a chain of ``joints`` joints when the file names none."""
    return _OF_JOINTS.get(joints, "position" if joints < 6 else "pose")


def parse_task(text: str, place: Place) -> Task:
    """The task named ``text``.

    Raises:
        InvalidRobotError: no task has this name.
    """
    for task in DIMENSIONS:
        if text == task:
            return task
    found = f"the task {quoted(text)} is unknown"
    raise place.error(found, f"write one of {', '.join(DIMENSIONS)}")


def check_limits(chain: Chain, place: Place) -> list[str]:
    """Check that no limits are reversed; return remarks on those that look odd.

    Raises:
        InvalidRobotError: a lower limit is above its upper one.
    """
    notes = []
    for joint in chain.joints:
        if joint.limits is None:
            continue
        lower, upper = (_value(limit) for limit in joint.limits)
        if lower > upper:
            found = f"the lower limit {lower:g} is above the upper one, {upper:g}"
            raise place.at(f"joint {quoted(joint.name)}").error(found, "exchange them")
        if joint.kind == "revolute" and max(-lower, upper) > 2 * _TURN:
            reach = f"[{lower:g}, {upper:g}] rad"
            notes.append(f"{joint.name} limits {reach}: more than two turns, or deg?")
    return notes + _placeholder_notes(chain)


def _placeholder_notes(chain: Chain) -> list[str]:
    """A remark where all joints that turn have one range that exporters fill in."""
    turning = [joint.limits for joint in chain.joints if joint.kind == "revolute"]
    ranges = {tuple(map(_value, pair)) for pair in turning if pair is not None}
    if len(turning) < 3 or None in turning or len(ranges) != 1:
        return []
    [(lower, upper)] = ranges
    default = any(math.isclose(upper, x, abs_tol=0.01) for x in _DEFAULTS)
    if lower != -upper or not default:
        return []
    return [
        f"every joint has the range [{lower:g}, {upper:g}] rad: an exporter's default? "
        "The verdict within limits takes it as it stands"
    ]


def lock(chain: Chain, values: Mapping[str, Angle | Fraction | str]) -> Chain:
    """``chain`` with the named joints fixed at the given values.

    Args:
        chain: the chain; its task stays what it is.
        values: joint name to an angle (revolute), a length (prismatic), or the text
            of one; a bare nonzero number for a revolute joint is refused.

    Raises:
        InvalidRobotError: no joint has this name, a value is not of its joint's
            kind, or no joint would be left.
    """
    place = Place(quoted(chain.name), "--lock")
    names = [joint.name for joint in chain.joints]
    for name in values:
        if name not in names:
            found = f"no joint is named {quoted(name)}"
            raise place.error(found, f"the joints are {listing(names, most=50)}")
    if len(values) == len(names):
        raise place.error("every joint is locked", "leave some joints free")
    joints: list[Joint] = []
    pending: tuple[Motion, ...] = ()
    for joint in chain.joints:
        pending += joint.before
        if joint.name in values:
            pending += _fixed(joint, values[joint.name], place.at(joint.name))
        else:
            joints.append(replace(joint, before=pending))
            pending = ()
    return replace(chain, joints=tuple(joints), tool=pending + chain.tool)


def _value(limit: Angle | Fraction) -> float:
    return angle_value(limit) if isinstance(limit, Angle) else float(limit)


def _fixed(
    joint: Joint, value: Angle | Fraction | str, place: Place
) -> tuple[Motion, ...]:
    """The motion of ``joint`` at ``value``, as a fixed transform."""
    source = f"{joint.name} lock"
    if isinstance(value, str):
        parse = parse_angle if joint.kind == "revolute" else parse_length
        value = parse(value, place)
    if isinstance(value, Angle) and joint.kind == "revolute":
        return () if value.is_zero else (Rotation(joint.axis, value, source),)
    if isinstance(value, Fraction) and joint.kind == "prismatic":
        shift = _along(joint.axis, value, place)
        return () if value == 0 else (Translation(shift, source),)
    kind = "an angle" if joint.kind == "revolute" else "a length"
    raise place.error(f"a {joint.kind} joint at {value}", f"give {kind}")


def _along(axis: Vector, value: Fraction, place: Place) -> Vector:
    """``value`` along the unit vector of ``axis``, which must be rational."""
    direction = unit_axis(axis)
    if direction is None:
        found = "a sliding direction whose unit vector is not rational"
        raise place.error(found, "lock another joint, or write the axis exactly")
    x, y, z = direction
    return (x * value, y * value, z * value)
