"""How far the axes of a built arm may be from where its file has them.

::

    tolerance: {lengths: 1e-4, angles: 1e-4}      # in the unit of length, and rad

Each link carries two axes, or an axis and the tip; each of them may be off by as much.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from cuspaudit.robot.entries import check_known
from cuspaudit.robot.numbers import parse_angle, parse_length
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.tables import read_mapping

__all__ = ["AxisTolerance", "parse_tolerance", "tolerance_from_file"]

_KEYS = ("lengths", "angles")
_EXPECTED = "write tolerance: {lengths: 1e-4, angles: 1e-4}"
_MORE_THAN_PI = Fraction(355, 113)


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
    angle = parse_angle(value["angles"], place.at("angles"), "rad")
    angles = angle.radians + _MORE_THAN_PI * angle.half_turns
    for key, number in (("lengths", lengths), ("angles", angles)):
        if number < 0:
            found = f"{quoted(value[key])} is negative"
            raise place.at(key).error(found, "write 0 or more")
    if not lengths and not angles:
        raise place.error("both are 0", "leave the tolerance out, or widen one")
    return AxisTolerance(lengths, angles)


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
