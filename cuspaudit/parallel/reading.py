"""A parallel mechanism in a YAML or JSON file.

::

    mechanism: planar            # or spatial
    name: 3-RRR                  # optional, like title, source, problem and expect
    platform: body               # or point
    legs:
      - {kind: crank, base: [0, 0], arm: 1, rod: 3/2, anchor: [0, 0]}
      - {kind: slider, base: [4, 0], along: [0, 1], rod: 2, anchor: [1, 0]}
      - {kind: length, base: [2, 3], anchor: [1/2, 1]}     # rod: 2 would fix it
    problem: direct              # or inverse
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import cast

from cuspaudit.parallel.mechanism import KINDS, Kind, Leg, Mechanism, Point, Problem
from cuspaudit.robot.numbers import parse_length
from cuspaudit.robot.place import Place, listing, quoted

__all__ = ["is_mechanism", "mechanism_from_entries"]

_KEYS = (
    *("mechanism", "platform", "legs", "problem"),
    *("name", "title", "source", "expect"),
)
_LEG = {
    "length": ({"kind", "base"}, {"anchor", "rod"}),
    "crank": ({"kind", "base", "arm", "rod"}, {"anchor"}),
    "slider": ({"kind", "base", "along", "rod"}, {"anchor"}),
}
_MOST_LEGS = 6


def is_mechanism(entries: Mapping[str, object]) -> bool:
    """Whether the entries of a file are those of a mechanism."""
    return "legs" in entries or "mechanism" in entries


def mechanism_from_entries(file: str, entries: Mapping[str, object]) -> Mechanism:
    """The mechanism with these entries, keyed as in a file.

    Raises:
        InvalidRobotError: it cannot be read as it stands, or the number of actuators is
            not that of the freedoms.
    """
    place = Place(file)
    unknown = [key for key in entries if key not in _KEYS]
    if unknown:
        raise place.error(
            f"unknown key {listing(unknown)}", f"known keys are {', '.join(_KEYS)}"
        )
    space = {"planar": 2, "spatial": 3}[
        _one_of(entries, "mechanism", ("planar", "spatial"), None, place)
    ]
    body = _one_of(entries, "platform", ("body", "point"), None, place) == "body"
    if body and space == 3:
        raise place.at("platform").error(
            "a body in space", "only a platform that keeps its orientation: point"
        )
    rows = entries.get("legs")
    if not isinstance(rows, list) or not 1 <= len(rows) <= _MOST_LEGS:
        raise place.at("legs").error(
            "no list of legs", f"give 1 to {_MOST_LEGS} legs, each a mapping"
        )
    reader = _Legs(place, space, body)
    problem = _one_of(entries, "problem", ("direct", "inverse"), "direct", place)
    name = entries.get("name", Path(file).stem)
    expect = entries.get("expect", {})
    found = Mechanism(
        file,
        name if isinstance(name, str) else Path(file).stem,
        space,
        body,
        tuple(reader.leg(i, row) for i, row in enumerate(rows)),
        cast(Problem, problem),
        expect if isinstance(expect, dict) else {},
    )
    actuated = sum(leg.is_actuated for leg in found.legs)
    if actuated != found.freedoms or actuated < 1:
        raise place.at("legs").error(
            f"{actuated} actuated legs for a platform with {found.freedoms} freedoms",
            "actuate as many legs as there are freedoms; a rod fixes a length leg",
        )
    return found


@dataclass(frozen=True)
class _Legs:
    place: Place
    space: int
    body: bool

    def leg(self, number: int, row: object) -> Leg:
        place = self.place.at(f"legs[{number}]")
        if not isinstance(row, dict):
            raise place.error("not a mapping", "write {kind: ..., base: [...], ...}")
        kind = cast(Kind, _one_of(row, "kind", KINDS, None, place))
        needed, also = _LEG[kind]
        if self.body:
            needed, also = needed | {"anchor"}, also - {"anchor"}
        elif "anchor" in row:
            raise place.error("an anchor on a platform that is a point", "leave it out")
        missing, unknown = needed - set(row), set(row) - needed - also
        if missing or unknown:
            found = (
                f"no {listing(sorted(missing))}"
                if missing
                else f"unknown key {listing(sorted(unknown))}"
            )
            expected = f"a {kind} leg has {', '.join(sorted(needed | also))}"
            raise place.error(found, expected)
        origin = (Fraction(0),) * self.space
        along = self._point(row, "along", place) if kind == "slider" else ()
        if kind == "slider" and not any(along):
            raise place.at("along").error("no direction", "give a vector that is not 0")
        if kind == "crank" and self.space == 3:
            raise place.error("a crank in space", "a crank turns in a plane")
        return Leg(
            kind,
            self._point(row, "base", place),
            self._point(row, "anchor", place) if self.body else origin,
            _positive(row, "arm", place),
            along,
            _positive(row, "rod", place),
        )

    def _point(self, row: Mapping[str, object], key: str, place: Place) -> Point:
        value = row.get(key)
        if (
            not isinstance(value, list)
            or len(value) != self.space
            or not all(isinstance(text, str) for text in value)
        ):
            zeros = ", ".join("0" * self.space)
            expected = f"write {self.space} numbers: [{zeros}]"
            raise place.at(key).error("no point", expected)
        return tuple(parse_length(text, place.at(key)) for text in value)


def _positive(row: Mapping[str, object], key: str, place: Place) -> Fraction | None:
    text = row.get(key)
    if text is None:
        return None
    if not isinstance(text, str) or parse_length(text, place.at(key)) <= 0:
        raise place.at(key).error("no length", "write a positive number")
    return parse_length(text, place.at(key))


def _one_of(
    entries: Mapping[str, object],
    key: str,
    known: tuple[str, ...],
    default: str | None,
    place: Place,
) -> str:
    value = entries.get(key, default)
    if not isinstance(value, str) or value not in known:
        found = "nothing" if value is None else quoted(str(value))
        raise place.at(key).error(found, f"write one of {', '.join(known)}")
    return value
