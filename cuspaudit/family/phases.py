"""What a phase diagram shows: the rows of a sweep, cut to two parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import yaml

from cuspaudit.errors import InvalidInputError
from cuspaudit.family.expressions import Value, parse_expression
from cuspaudit.family.family import Family, exact_text
from cuspaudit.family.family_file import read_family
from cuspaudit.family.row import Row
from cuspaudit.family.store import read_rows
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.place import Place
from cuspaudit.robot.robot import COUNTS

__all__ = ["Phases", "phases_of"]

_COLOURS = ("within_limits", *COUNTS)


@dataclass(frozen=True)
class Phases:
    """A plane through a family.

    Attributes:
        title: the family, and the values held fixed.
        rows: the members in the plane.
        x: the parameter to the right.
        y: the parameter upwards.
        labels: of the two, with units where they are known.
        colour: the column that is shown.
        files: member index to the text of its robot file.
    """

    title: str
    rows: list[Row]
    x: str
    y: str
    labels: tuple[str, str]
    colour: str
    files: Mapping[int, str]


def phases_of(
    folder: Path,
    x: str | None = None,
    y: str | None = None,
    colour: str = "verdict",
    fixed: Mapping[str, str] | None = None,
) -> Phases:
    """The plane of two parameters of a sweep.

    Args:
        folder: of the sweep, running or not.
        x: a parameter; by default the first that varies.
        y: another; by default the next.
        colour: "verdict", "within_limits" or a count.
        fixed: values of the other parameters. Random ones may be left: the members
            are then projected on the plane.

    Raises:
        InvalidInputError: no sweep, an unknown name, a parameter left free, or no
            member there.
    """
    rows = read_rows(folder)
    family = read_family(folder / "family.yaml")
    names = [p.name for p in family.parameters]
    values = {name: _value(name, text) for name, text in (fixed or {}).items()}
    free = [p.name for p in family.parameters if p.size > 1 and p.name not in values]
    x = x or next((n for n in free if n != y), None)
    y = y or next((n for n in free if n != x), None)
    if x is None or y is None or x == y or not {x, y, *values} <= set(names):
        raise _error(folder, "no two parameters", f"choose two of {', '.join(names)}")
    columns = ["verdict", *(c for c in _COLOURS if c in family.record)]
    if colour not in columns:
        known = ", ".join(columns)
        raise _error(folder, f"no column {colour}", f"choose one of {known}")
    for p in family.parameters:
        if p.size > 1 and p.seed is None and p.name not in (x, y, *values):
            found = f"{p.name} has {p.size} values"
            raise _error(folder, found, f"--fix {p.name}={exact_text(p.value(0))}")
    kept = [row for row in rows if _is_at(row, values)]
    if not kept:
        raise _error(folder, "no member there", "leave out --fix, or sweep on")
    files = {row["index"]: _file(family, row["index"]) for row in kept}
    title = ", ".join([family.name, *_others(family, (x, y), values)])
    labels = _label(family, x), _label(family, y)
    return Phases(title, kept, x, y, labels, colour, files)


def _others(
    family: Family, shown: tuple[str, str], fixed: Mapping[str, Value]
) -> list[str]:
    """The parameters that are not shown: their value, or that they have any."""
    said = []
    for p in family.parameters:
        value = p.value(0) if p.size == 1 else fixed.get(p.name)
        if p.name not in shown:
            held = f"{p.name} = {exact_text(value)}" if value is not None else None
            said.append(held or f"any {p.name}")
    return said


def _label(family: Family, name: str) -> str:
    """A parameter with its unit: of an angle, or of the length that it is itself."""
    (parameter,) = (p for p in family.parameters if p.name == name)
    if any(isinstance(v, Angle) for v in parameter.bounds or parameter.values):
        return f"{name} (rad)"
    places = {
        column
        for (_, column, _), e in family.cells.items()
        if e.text.lstrip("- ") == name
    }
    units = family.rows.head.get("units")
    unit = units.get("length") if isinstance(units, Mapping) else units
    return f"{name} ({unit})" if unit and places & {"a", "d"} else name


def _is_at(row: Row, values: Mapping[str, Value]) -> bool:
    return all(row.get(f"{n}_exact") == exact_text(v) for n, v in values.items())


def _value(name: str, text: str) -> Value:
    return parse_expression(text, Place("--fix", name)).value({})


def _file(family: Family, index: int) -> str:
    """The robot file of a member; empty where an expression has no value."""
    try:
        table = family.table(family.values(index) or {})
    except InvalidInputError:
        return ""
    said = {"name": f"{family.name}-{index}", **table.head}
    said["joints"] = [dict(row) for row in table.rows]
    return yaml.safe_dump(said, sort_keys=False, default_flow_style=None)


def _error(folder: Path, found: str, expected: str) -> InvalidInputError:
    return InvalidInputError(file=str(folder), found=found, expected=expected)
