"""The numbers of a URDF joint: origin, axis and limits, exactly as printed."""

from __future__ import annotations

import re
from fractions import Fraction

from cuspaudit.robot.axes import scaled_axis, unit_axis
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    JointKind,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.formats.urdf.xml import JointElement
from cuspaudit.robot.numbers import parse_decimal, printed_decimals
from cuspaudit.robot.place import Place, quoted

__all__ = ["Limits", "axis", "limits", "origin"]

Limits = tuple[Angle, Angle] | tuple[Fraction, Fraction] | None

_ZERO: Vector = (Fraction(0), Fraction(0), Fraction(0))
_BLANKS = re.compile(r"[ \t\r\n]+")
_INFINITE = re.compile(r"[+-]?inf(inity)?", re.IGNORECASE)
_MANY_TURNS = Fraction(12566, 1000)


def origin(joint: JointElement, place: Place, notes: list[str]) -> tuple[Motion, ...]:
    """The fixed transform of ``joint``: T(xyz) Rz(yaw) Ry(pitch) Rx(roll).

    Zero motions are left out.
    """
    xyz, places = _triple(joint, "origin", "xyz", place, _ZERO)
    rpy, decimals = _triple(joint, "origin", "rpy", place, _ZERO)
    motions: list[Motion] = []
    if any(xyz):
        motions.append(Translation(xyz, f"{joint.name} xyz", places))
    for index, direction in ((2, Z_AXIS), (1, Y_AXIS), (0, X_AXIS)):
        if rpy[index]:
            source = f"{joint.name} rpy[{index}]"
            angle = Angle(radians=rpy[index])
            motions.append(Rotation(direction, angle, source, decimals[index:][:1]))
            if abs(rpy[index]) > _MANY_TURNS:
                notes.append(f"{source} is more than two turns: rad, or meant as deg?")
    return tuple(motions)


def axis(
    joint: JointElement, place: Place, notes: list[str]
) -> tuple[Vector, tuple[Vector, tuple[int, ...]] | None]:
    """The axis of ``joint``: the exact unit vector when that is rational.

    Otherwise its direction, scaled to a largest component of 1.

    Returns:
        The axis, and the numbers that are printed, with their decimals.

    Raises:
        InvalidRobotError: it is not three numbers, or it is zero.
    """
    given, decimals = _triple(joint, "axis", "xyz", place, X_AXIS)
    if not any(given):
        raise place.error("its axis is the zero vector", "write a direction")
    unit = unit_axis(given)
    if unit is None:
        notes.append(f"{joint.name} axis has no rational unit vector: direction kept")
    printed = (given, decimals) if decimals else None
    return unit or scaled_axis(given), printed


def limits(
    joint: JointElement, kind: JointKind, place: Place, notes: list[str]
) -> Limits:
    """The limits of ``joint``, None when it turns freely or states no range."""
    if joint.kind == "continuous":
        return None
    lower, upper = (joint.text("limit", name) for name in ("lower", "upper"))
    if lower is None and upper is None:
        notes.append(f"{joint.name} states no limits: read as unlimited")
        return None
    texts = [(lower or "0").strip(), (upper or "0").strip()]
    if any(_INFINITE.fullmatch(text) for text in texts):
        notes.append(f"{joint.name} has an infinite limit: read as unlimited")
        return None
    low, high = (parse_decimal(text, place.at("limit")) for text in texts)
    if low == high:
        notes.append(f"{joint.name} has equal limits: read as unlimited")
        return None
    if kind == "prismatic":
        return low, high
    return Angle(radians=low), Angle(radians=high)


def _triple(
    joint: JointElement, part: str, attribute: str, place: Place, default: Vector
) -> tuple[Vector, tuple[int, ...]]:
    """Three numbers and their decimals, or ``default`` when the attribute is absent."""
    text = joint.text(part, attribute)
    if text is None:
        return default, ()
    here = place.at(f"{part} {attribute}")
    words = [word for word in _BLANKS.split(text) if word]
    if len(words) != 3:
        found = f"{len(words)} numbers in {quoted(text)}" if words else "it is empty"
        raise here.error(found, "write three decimal numbers")
    x, y, z = (parse_decimal(word, here) for word in words)
    return (x, y, z), tuple(map(printed_decimals, words))
