"""What a D-H table has to state beside its numbers, asked for in one message.

The convention and the units are never guessed. A table states them in its head, in its
column names or by the options of the command; what is missing is asked for at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from cuspaudit.robot.entries import check_known, word
from cuspaudit.robot.formats.dh.cells import plain_cell, variable_in
from cuspaudit.robot.formats.dh.moving import SLIDING
from cuspaudit.robot.numbers import AngleUnit, is_bare_angle
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.tables import Table

__all__ = ["Convention", "Given", "Settings", "settings"]

Convention = Literal["standard", "modified"]

_LENGTHS = ("m", "mm")
_ANGLES = ("theta", "alpha", "offset", "qmin", "qmax", "limits")
_OF_SLIDES = ("theta", "alpha")


@dataclass(frozen=True, slots=True)
class Given:
    """What the options of a command state; None for what they do not."""

    convention: str | None = None
    angle_unit: str | None = None
    length_unit: str | None = None


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of a table.

    Attributes:
        convention: of its rows.
        angle_unit: of bare angles; None where there are none and none is stated.
        length_unit: of its lengths; None where none is stated.
    """

    convention: Convention
    angle_unit: AngleUnit | None
    length_unit: str | None


def settings(
    table: Table, named: Mapping[str, str], given: Given, place: Place
) -> Settings:
    """The settings that the head, the column names and the options agree in.

    Args:
        table: rows under our column names, and the head.
        named: what the column names state (`headers.stated_by`).
        given: what the options state.
        place: the file.

    Raises:
        InvalidRobotError: two of them contradict each other, a word is unknown, or the
            convention or the unit of a bare angle is stated by none.
    """
    head = table.head
    units = head.get("units")
    here = place.at("units")
    entries: Mapping[str, object] = {"length": units}
    if isinstance(units, Mapping):
        check_known(units, ("length", "angle"), here)
        entries = units
    conventions = [word(row, "convention", place) for row in table.rows]
    conventions += [word(head, "convention", place), named.get("convention")]
    convention = _one(
        "convention", [*conventions, given.convention], ("standard", "modified"), place
    )
    lengths = [word(entries, "length", here), named.get("length"), given.length_unit]
    length = _one("unit of length", lengths, _LENGTHS, here)
    angles = [word(entries, "angle", here), word(head, "angle_unit", place)]
    angles += [named.get("angle"), given.angle_unit]
    angle = _one("unit of angle", angles, ("deg", "rad"), here)
    bare = None if angle else next(_bare_angles(table.rows), None)
    if convention is None or bare:
        raise place.error(*_request(convention, bare, length))
    modified = convention == "modified"
    return Settings(
        "modified" if modified else "standard",
        None if angle is None else "rad" if angle == "rad" else "deg",
        length,
    )


def _one(
    what: str, stated: Sequence[str | None], known: Sequence[str], place: Place
) -> str | None:
    """The one word that is stated, None when there is none."""
    words = sorted({text for text in stated if text is not None})
    for text in words:
        if text not in known:
            expected = f"write {' or '.join(known)}"
            raise place.error(f"the {what} {quoted(text)} is unknown", expected)
    if len(words) > 1:
        found = f"several statements of the {what}: {', '.join(map(quoted, words))}"
        raise place.error(found, "state the same wherever it stands")
    return words[0] if words else None


def _request(
    convention: str | None, bare: str | None, length: str | None
) -> tuple[str, str]:
    """What is missing, and how to state it by options or in the file."""
    missing, options, entries = [], [], []
    if convention is None:
        missing.append("no convention")
        options.append("--convention standard|modified")
        entries.append("convention: standard")
    if bare:
        missing.append(f"no unit of angles ({bare})")
        options.append("--angle-unit deg|rad")
    if length is None:
        missing.append("no unit of lengths")
        options.append("--length-unit m|mm")
    units = [
        text
        for text, wanted in (("length: mm", length is None), ("angle: deg", bare))
        if wanted
    ]
    if units:
        entries.append(f"units: {{{', '.join(units)}}}")
    expected = f"state {' '.join(options)} (in a YAML file for example "
    return ", ".join(missing), f"{expected}{', '.join(entries)})"


def _bare_angles(rows: Sequence[Mapping[str, object]]) -> Iterator[str]:
    """Where an angle other than 0 stands without a unit, and what it is."""
    for number, row in enumerate(rows, 1):
        slides = str(row.get("type", "")).strip().lower() in SLIDING
        for column in _OF_SLIDES if slides else _ANGLES:
            cell = row.get(column)
            for text in cell if isinstance(cell, list) else [cell]:
                if isinstance(text, str) and is_bare_angle(_constant(text, column)):
                    yield f"row {number} {column} is {quoted(text)}"


def _constant(text: str, column: str) -> str:
    """A plain cell without the joint's own symbol."""
    plain = plain_cell(text)
    variable = variable_in(plain, "theta") if column == "theta" else None
    return variable.rest if variable else plain
