"""The rows of a D-H table: text in, exact numbers out, each error naming its cell."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from cuspaudit.robot.chain import Angle, JointKind, Motion, Vector
from cuspaudit.robot.entries import check_known, word
from cuspaudit.robot.formats.dh.cells import plain_cell
from cuspaudit.robot.formats.dh.headers import COLUMNS, Header, header_from_text
from cuspaudit.robot.formats.dh.moving import Moving, check_indices, moving_entry
from cuspaudit.robot.formats.format import MOST_JOINTS
from cuspaudit.robot.formats.motion_text import parse_direction, parse_motions
from cuspaudit.robot.numbers import AngleUnit, parse_angle, parse_length
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.tolerance import parse_within, plus_minus

__all__ = ["Limits", "TableRow", "named_rows", "parse_rows", "split_play", "with_play"]


Limits = tuple[Angle, Angle] | tuple[Fraction, Fraction] | None

_FREE = ("before", "axis")
_NUMBERS = ("theta", "d", "a", "alpha")
_SIGNS = {None: 1, "1": 1, "+1": 1, "-1": -1}


@dataclass(frozen=True, slots=True)
class TableRow:
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
        is_typed: whether the row states its kind.
        loose: within how much the numbers of some columns are known.
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
    is_typed: bool = True
    loose: Mapping[str, Fraction] = field(default_factory=dict)


def named_rows(
    rows: Sequence[Mapping[str, object]], place: Place
) -> tuple[list[Mapping[str, object]], list[Header]]:
    """The rows under our column names, and what their own names say.

    Args:
        rows: name to text, names as people write them.
        place: the file.

    Raises:
        InvalidRobotError: a name is unknown, or two of a row mean one column.
    """
    seen: dict[str, Header] = {}
    result: list[Mapping[str, object]] = []
    for number, cells in enumerate(rows, 1):
        named: dict[str, object] = {}
        for key, value in cells.items():
            column = key
            if key not in _FREE:
                seen.setdefault(key, header_from_text(key))
                column = seen[key].column
            here = place.at(f"row {number}")
            if not column:
                check_known({key: value}, (*COLUMNS, *_FREE), here)
            if column in named:
                found = f"two columns mean {column}, the second {quoted(key)}"
                raise here.error(found, "write it once")
            named[column] = value
        result.append(named)
    return result, list(seen.values())


def split_play(
    rows: Sequence[Mapping[str, object]],
) -> tuple[list[Mapping[str, object]], list[dict[str, str]]]:
    """The rows without what stands after +-, and that by the columns of each row."""
    plain: list[Mapping[str, object]] = []
    played: list[dict[str, str]] = []
    for cells in rows:
        found: dict[str, str] = {}
        bare = dict(cells)
        for column in _NUMBERS:
            text = cells.get(column)
            if isinstance(text, str):
                bare[column], radius = plus_minus(text)
                if radius is not None:
                    found[column] = radius
        plain.append(bare)
        played.append(found)
    return plain, played


def with_play(
    rows: Sequence[TableRow],
    played: Sequence[Mapping[str, str]],
    unit: AngleUnit | None,
    place: Place,
) -> list[TableRow]:
    """The rows with how loose their numbers are, as `split_play` found it."""
    return [
        replace(
            row,
            loose={
                column: parse_within(
                    plain_cell(text),
                    column in ("theta", "alpha"),
                    unit,
                    place.at(f"row {number} {column}"),
                )
                for column, text in cells.items()
            },
        )
        for number, (row, cells) in enumerate(zip(rows, played, strict=True), 1)
    ]


def parse_rows(
    rows: Sequence[Mapping[str, object]], unit: AngleUnit | None, place: Place
) -> list[TableRow]:
    """The rows, base to tip, their names all different.

    Args:
        rows: our column name to text (``limits``: to two texts), as `named_rows` has
            them.
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
    result: list[TableRow] = []
    places = [place.at(f"row {number}") for number in range(1, len(rows) + 1)]
    moving = [moving_entry(*pair) for pair in zip(rows, places, strict=True)]
    check_indices([entry.index for entry in moving], place)
    first = 0 if word(rows[0], "joint", places[0]) == "0" else 1
    for number, (cells, entry) in enumerate(zip(rows, moving, strict=True)):
        here = places[number]
        name = _joint_name(cells, number, first, here)
        row = _row(cells, name, entry, unit, here)
        if row.name in [other.name for other in result]:
            found = f"the joint name {quoted(row.name)} stands twice"
            raise here.error(found, "give each joint its own name")
        result.append(row)
    return result


def _row(
    cells: Mapping[str, object],
    name: str,
    moving: Moving,
    unit: AngleUnit | None,
    place: Place,
) -> TableRow:
    before: tuple[Motion, ...] = ()
    if cells.get("before") is not None:
        here = place.at("before")
        before = parse_motions(cells["before"], f"{name} before", here, unit)
    if cells.get("axis") is not None:
        return _free_row(cells, name, moving, before, unit, place)
    for column in ("a", "alpha", "d"):
        missing = word(cells, column, place) is None
        if missing and not (column == "d" and moving.kind == "prismatic"):
            raise place.at(column).error("no value", "write 0 or a number")
    return TableRow(
        name=name,
        kind=moving.kind,
        theta=parse_angle(moving.theta, place.at("theta"), unit),
        d=parse_length(moving.d, place.at("d")),
        a=parse_length(_plain(cells, "a", place), place.at("a")),
        alpha=parse_angle(_plain(cells, "alpha", place), place.at("alpha"), unit),
        sign=moving.sign * _sign(cells, place),
        limits=_limits(cells, moving.kind, unit, place),
        before=before,
        is_typed=moving.is_typed,
    )


def _free_row(
    cells: Mapping[str, object],
    name: str,
    moving: Moving,
    before: tuple[Motion, ...],
    unit: AngleUnit | None,
    place: Place,
) -> TableRow:
    """A joint given by the motions before it and its axis, without D-H numbers."""
    for column in ("theta", "d", "a", "alpha", "sign", "offset"):
        if column in cells:
            found = f"{column} beside axis"
            expected = "give before: and axis:, or D-H numbers and no axis"
            raise place.at("axis").error(found, expected)
    axis = parse_direction(word(cells, "axis", place) or "", place.at("axis"))
    zero, none = Fraction(0), Angle()
    limits = _limits(cells, moving.kind, unit, place)
    return TableRow(
        *(name, moving.kind, none, zero, zero, none, 1, limits, before, axis),
        is_typed=moving.is_typed,
    )


def _plain(cells: Mapping[str, object], column: str, place: Place) -> str:
    return plain_cell(word(cells, column, place) or "0")


def _joint_name(cells: Mapping[str, object], row: int, first: int, place: Place) -> str:
    """The joint's name; a bare number in ``joint`` has to count the rows.

    Args:
        cells: of the row.
        row: its number, from 0.
        first: the number of the first joint, 0 or 1.
        place: the row.
    """
    given = word(cells, "name", place)
    label = word(cells, "joint", place)
    if given is None and label is not None and not label.isdigit():
        given = label
    if label is not None and label.isdigit() and label != str(row + first):
        found = f"joint {quoted(label)} in row {row + 1}"
        raise place.error(found, "number the joints 1, 2, 3, ... from the base")
    return given or f"joint_{row + 1}"


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
    lower, upper = plain_cell(lower), plain_cell(upper)
    if kind == "revolute":
        return parse_angle(lower, here, unit), parse_angle(upper, here, unit)
    return parse_length(lower, here), parse_length(upper, here)
