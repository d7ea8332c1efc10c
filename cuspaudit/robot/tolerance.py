"""How far the axes of a built arm may be from where its file has them.

::

    tolerance: {lengths: 1e-4, angles: 1e-4}      # in the unit of length, and rad

Each link carries two axes, or an axis and the tip; each of them may be off by as much.
In a table of Denavit and Hartenberg single numbers may be loose as well,
``a: 0.71 +- 1e-4`` or ``alpha: pi/2 +- 1e-4 rad``: then every value of them is meant.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Literal

from cuspaudit.robot.chain import Vector
from cuspaudit.robot.entries import check_known
from cuspaudit.robot.numbers import AngleUnit, parse_angle, parse_length
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.tables import read_mapping

__all__ = [
    "AxisTolerance",
    "LooseNumber",
    "parse_tolerance",
    "parse_within",
    "plus_minus",
    "tolerance_from_file",
]

_KEYS = ("lengths", "angles")
_EXPECTED = "write tolerance: {lengths: 1e-4, angles: 1e-4}"
_MORE_THAN_PI = Fraction(355, 113)
_SIGNS = ("+-", "+/-", "\N{PLUS-MINUS SIGN}")


@dataclass(frozen=True, slots=True)
class AxisTolerance:
    """How far each axis may be off, at either end of each link.

    Attributes:
        lengths: by which a point of it may be moved; in the robot's unit of length.
        angles: by which its direction may be tilted, rad.
    """

    lengths: Fraction
    angles: Fraction


def parse_tolerance(value: object, place: Place) -> AxisTolerance:
    """The tolerance that a mapping of texts holds.

    An angle may be given in deg; it is rounded up.

    Raises:
        InvalidRobotError: it is no mapping, one of the two is missing, unknown,
            negative or no number, or both are 0.
    """
    if not isinstance(value, Mapping):
        raise place.error("not a mapping", _EXPECTED)
    check_known(value, _KEYS, place)
    for key in _KEYS:
        if not isinstance(value.get(key), str):
            raise place.at(key).error("no value", f"{_EXPECTED}, 0 for none")
    lengths = parse_length(value["lengths"], place.at("lengths"))
    angles = _radians(value["angles"], "rad", place.at("angles"))
    for key, number in (("lengths", lengths), ("angles", angles)):
        if number < 0:
            found = f"{quoted(value[key])} is negative"
            raise place.at(key).error(found, "write 0 or more")
    if not lengths and not angles:
        raise place.error("both are 0", "leave the tolerance out, or widen one")
    return AxisTolerance(lengths, angles)


@dataclass(frozen=True, slots=True)
class LooseNumber:
    """A number of a table that is known within ``within`` only.

    Attributes:
        where: its row and column, as "joint_2 a".
        kind: whether its motion is a turn about ``axis`` or a slide along it.
        axis: x or z.
        within: rad, or the robot's unit of length; more than 0.
    """

    where: str
    kind: Literal["turn", "slide"]
    axis: Vector
    within: Fraction


def plus_minus(text: str) -> tuple[str, str | None]:
    """The number of a cell without its tolerance, and the tolerance if it has one.

    >>> plus_minus("0.71 +- 1e-4"), plus_minus("pi/2")
    (('0.71', '1e-4'), ('pi/2', None))
    """
    for sign in _SIGNS:
        number, found, radius = text.partition(sign)
        if found:
            return number.strip(), radius.strip()
    return text, None


def parse_within(
    text: str, is_angle: bool, unit: AngleUnit | None, place: Place
) -> Fraction:
    """What stands after +-: a length, or an angle, rounded up, in rad.

    Raises:
        InvalidRobotError: it is no number, not positive, or an angle without a unit.
    """
    within = _radians(text, unit, place) if is_angle else parse_length(text, place)
    if within <= 0:
        found = f"{quoted(text)} after +-"
        raise place.error(found, "write a positive number, or leave it out")
    return within


def _radians(text: str, unit: AngleUnit | None, place: Place) -> Fraction:
    angle = parse_angle(text, place, unit)
    return angle.radians + _MORE_THAN_PI * angle.half_turns


def tolerance_from_file(file: str) -> AxisTolerance:
    """The tolerance of a YAML file: the block alone, or under ``tolerance:``.

    Raises:
        InvalidRobotError: there is no such file, or it holds no tolerance.
    """
    place = Place(file)
    if not Path(file).is_file():
        raise place.error("no such file", "give a YAML file with lengths: and angles:")
    entries = read_mapping(Path(file), place)
    if set(entries) == {"tolerance"}:
        return parse_tolerance(entries["tolerance"], place.at("tolerance"))
    return parse_tolerance(entries, place)
