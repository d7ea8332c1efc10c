"""The rows of a D-H table: text in, exact numbers out, each error naming its cell."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from cuspaudit.robot.chain import Angle, JointKind, Motion, Vector
from cuspaudit.robot.formats.motion_text import parse_direction, parse_motions
from cuspaudit.robot.numbers import AngleUnit, parse_angle, parse_length
from cuspaudit.robot.place import Place, quoted

__all__ = [
    "COLUMNS",
    "MOST_JOINTS",
    "Limits",
    "Row",
    "check_known",
    "parse_rows",
    "word",
]

MOST_JOINTS = 50

Limits = tuple[Angle, Angle] | tuple[Fraction, Fraction] | None

COLUMNS = (
    *("joint", "name", "type", "theta", "d", "a", "alpha", "sign"),
    *("limits", "qmin", "qmax", "convention"),
)
_ROW = (*COLUMNS, "before", "axis")
_KINDS: dict[str, JointKind] = {
    "revolute": "revolute",
    "r": "revolute",
    "prismatic": "prismatic",
    "p": "prismatic",
}
_SIGNS = {None: 1, "1": 1, "+1": 1, "-1": -1}
_VARIABLE = re.compile(r"(q|d|t|th|theta)_?[0-9]*\*?")


@dataclass(frozen=True, slots=True)
class Row:
    """One joint of a table.

    Attributes:
        name: unique in the table.
        kind: "revolute" or "prismatic".
        theta: the offset of a revolute joint, the angle of a prismatic one.
        d: the offset of a prismatic joint, the distance of a revolute one.
        a: the distance along x.
        alpha: the twist about x.
        sign: 1, or -1 when the joint's variable enters negated.
        limits: of the joint's variable.
        before: fixed motions that come before all of these.
        axis: the joint's own axis, in a row without theta, d, a, alpha and sign.
    """

    name: str
    kind: JointKind
    theta: Angle
    d: Fraction
    a: Fraction
    alpha: Angle
    sign: int
    limits: Limits
    before: tuple[Motion, ...] = ()
    axis: Vector | None = None


def parse_rows(
    rows: Sequence[Mapping[str, object]], unit: AngleUnit | None, place: Place
) -> list[Row]:
    """The rows, base to tip, their names all different.

    Args:
        rows: column name to text (``limits``: to two texts).
        unit: the unit of bare angles, or None when the file states none.
        place: the file.

    Raises:
        InvalidRobotError: a column, a number or a name cannot be read.
    """
    if not rows:
        raise place.error("no joints", "write one row a joint")
    if len(rows) > MOST_JOINTS:
        expected = f"give a chain of at most {MOST_JOINTS}"
        raise place.error(f"{len(rows)} joints", expected)
    result: list[Row] = []
    for number, cells in enumerate(rows, 1):
        here = place.at(f"row {number}")
        check_known(cells, _ROW, here)
        row = _row(cells, _joint_name(cells, number, here), unit, here)
        if row.name in [other.name for other in result]:
            found = f"the joint name {quoted(row.name)} stands twice"
            raise here.error(found, "give each joint its own name")
        result.append(row)
    return result


def check_known(
    entries: Mapping[str, object], known: Collection[str], place: Place
) -> None:
    """Check that every key is one we read.

    Raises:
        InvalidRobotError: one is not; the message lists those that are.
    """
    for key in entries:
        if key not in known:
            found = f"unknown name {quoted(key)}"
            raise place.error(found, f"the names here are {', '.join(sorted(known))}")


def word(entries: Mapping[str, object], key: str, place: Place) -> str | None:
    """The text under ``key``, None when it is absent or null.

    Raises:
        InvalidRobotError: a list or a mapping stands there.
    """
    value = entries.get(key)
    if value is None or value in ("", "null", "~"):
        return None
    if not isinstance(value, str):
        raise place.at(key).error("a list or mapping", "write one value")
    return value


def _row(
    cells: Mapping[str, object], name: str, unit: AngleUnit | None, place: Place
) -> Row:
    kind = _kind(cells, place)
    before: tuple[Motion, ...] = ()
    if cells.get("before") is not None:
        here = place.at("before")
        before = parse_motions(cells["before"], f"{name} before", here, unit)
    if cells.get("axis") is not None:
        return _free_row(cells, name, kind, before, unit, place)
    variable = "theta" if kind == "revolute" else "d"
    texts = {
        column: word(cells, column, place) for column in ("theta", "d", "a", "alpha")
    }
    for column, text in texts.items():
        if text is None and column not in (variable, "theta"):
            raise place.at(column).error("no value", "write 0 or a number")
    text = texts[variable]
    if text and _VARIABLE.fullmatch(text):
        found = f"the joint's own variable {quoted(text)}"
        expected = "write its constant offset there, 0 if there is none"
        raise place.at(variable).error(found, expected)
    return Row(
        name=name,
        kind=kind,
        theta=parse_angle(texts["theta"] or "0", place.at("theta"), unit),
        d=parse_length(texts["d"] or "0", place.at("d")),
        a=parse_length(texts["a"] or "0", place.at("a")),
        alpha=parse_angle(texts["alpha"] or "0", place.at("alpha"), unit),
        sign=_sign(cells, place),
        limits=_limits(cells, kind, unit, place),
        before=before,
    )


def _free_row(
    cells: Mapping[str, object],
    name: str,
    kind: JointKind,
    before: tuple[Motion, ...],
    unit: AngleUnit | None,
    place: Place,
) -> Row:
    """A joint given by the motions before it and its axis, without D-H numbers."""
    for column in ("theta", "d", "a", "alpha", "sign"):
        if column in cells:
            found = f"{column} beside axis"
            expected = "give before: and axis:, or D-H numbers and no axis"
            raise place.at("axis").error(found, expected)
    axis = parse_direction(word(cells, "axis", place) or "", place.at("axis"))
    zero, none = Fraction(0), Angle()
    limits = _limits(cells, kind, unit, place)
    return Row(name, kind, none, zero, zero, none, 1, limits, before, axis)


def _joint_name(cells: Mapping[str, object], number: int, place: Place) -> str:
    """The joint's name; a bare number in ``joint`` has to count the rows."""
    given = word(cells, "name", place)
    label = word(cells, "joint", place)
    if given is None and label is not None and not label.isdigit():
        given = label
    if label is not None and label.isdigit() and label != str(number):
        found = f"joint {quoted(label)} in row {number}"
        raise place.error(found, "number the joints 1, 2, 3, ... from the base")
    return given or f"joint_{number}"


def _kind(cells: Mapping[str, object], place: Place) -> JointKind:
    text = word(cells, "type", place) or ""
    kind = _KINDS.get(text.lower())
    if kind is None:
        found = f"the type {quoted(text)}" if text else "no type"
        raise place.at("type").error(found, "write revolute or prismatic (or R, P)")
    return kind


def _sign(cells: Mapping[str, object], place: Place) -> int:
    text = word(cells, "sign", place)
    if text not in _SIGNS:
        raise place.at("sign").error(quoted(str(text)), "write 1 or -1")
    return _SIGNS[text]


def _limits(
    cells: Mapping[str, object], kind: JointKind, unit: AngleUnit | None, place: Place
) -> Limits:
    pair = cells.get("limits")
    if pair is None or pair in ("null", "~"):
        lower, upper = word(cells, "qmin", place), word(cells, "qmax", place)
    elif isinstance(pair, list) and [type(x) for x in pair] == [str, str]:
        lower, upper = pair
    else:
        expected = "write limits: [lower, upper]"
        raise place.at("limits").error("not a pair of values", expected)
    if lower is None and upper is None:
        return None
    if lower is None or upper is None:
        raise place.at("limits").error("one limit without the other", "write both")
    here = place.at("limits")
    if kind == "revolute":
        return parse_angle(lower, here, unit), parse_angle(upper, here, unit)
    return parse_length(lower, here), parse_length(upper, here)
