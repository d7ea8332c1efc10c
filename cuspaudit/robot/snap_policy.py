"""How near a number has to come to be taken for the exact one: `--snap`.

A policy is ``default``, ``none``, or a YAML file with any of the four entries::

    angle: 1e-5      # rad from a multiple of pi/6 or pi/4, printed or between two axes
    length: 5e-6     # m, up to which a length between axes may count as 0
    axis: 1e-5       # up to which a component of an axis may count as 0
    printed: true    # 1.57, 1.571, 1.5708, ... count as pi/2

An entry left out is that of ``default``. A small component counts as 0 where a relation
of the axes comes of it (`cuspaudit.robot.relations`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

from cuspaudit.robot.numbers import format_rational, parse_decimal
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.tables import read_mapping

__all__ = ["DEFAULT_POLICY", "NO_SNAPPING", "SnapPolicy", "policy_from_name"]

_TOLERANCES = ("angle", "length", "axis")
_MOST = {"angle": Fraction(1, 10), "length": Fraction(1), "axis": Fraction(1, 10)}


@dataclass(frozen=True, slots=True)
class SnapPolicy:
    """Which numbers are taken for others.

    Attributes:
        angle: distance in rad from a multiple of pi/6 or pi/4, 0 included, below
            which an angle counts as that multiple.
        length: in m, up to which a component of a translation may count as 0.
        axis: up to which a component of an axis, beside a largest one of 1, may.
        printed: whether an angle in rad that is a multiple of pi/2 rounded or cut at
            its own last decimal (the second or a later one) counts as that multiple.
        name: "default", "none" or the file.
    """

    angle: Fraction = Fraction(1, 10**5)
    length: Fraction = Fraction(5, 10**6)
    axis: Fraction = Fraction(1, 10**5)
    printed: bool = True
    name: str = "default"

    def record(self) -> dict[str, Any]:
        """The policy as it stands in the JSON of an audit, tolerances as texts."""
        texts = {key: format_rational(getattr(self, key)) for key in _TOLERANCES}
        return asdict(self) | texts


DEFAULT_POLICY = SnapPolicy()
NO_SNAPPING = SnapPolicy(Fraction(0), Fraction(0), Fraction(0), False, "none")


def policy_from_name(name: str) -> SnapPolicy:
    """The policy ``default`` or ``none``, or that of a YAML file.

    Raises:
        InvalidRobotError: there is no such file, or it is no policy.
    """
    for policy in (DEFAULT_POLICY, NO_SNAPPING):
        if name == policy.name:
            return policy
    place = Place(name)
    if not Path(name).exists():
        expected = "give --snap none, default or a YAML file of tolerances"
        raise place.error("no such policy or file", expected)
    return _policy(read_mapping(Path(name), place), place)


def _policy(entries: Mapping[str, object], place: Place) -> SnapPolicy:
    """The policy of a file's entries, the default where one is missing.

    Raises:
        InvalidRobotError: an entry is unknown or has no such value.
    """
    changed: dict[str, Any] = {"name": place.file}
    for key, value in entries.items():
        here = place.at(key)
        if key == "printed" and value in ("true", "false"):
            changed[key] = value == "true"
        elif key in _TOLERANCES and isinstance(value, str):
            number = parse_decimal(value, here)
            if not 0 <= number <= _MOST[key]:
                most = format_rational(_MOST[key])
                raise here.error(quoted(value), f"write a number from 0 to {most}")
            changed[key] = number
        else:
            expected = "write angle, length, axis (numbers) or printed (true, false)"
            raise here.error("no entry of a policy", expected)
    return replace(DEFAULT_POLICY, **changed)
