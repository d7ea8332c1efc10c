"""Robots from Denavit-Hartenberg tables, standard (distal) or modified (proximal).

One row a joint, base to tip. With q the joint's variable, s = 1 or -1 its ``sign``:

- standard:  A_i = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i)
- modified:  A_i = Rx(alpha_{i-1}) Tx(a_{i-1}) Rz(theta_i) Tz(d_i), row i holding
  alpha_{i-1} and a_{i-1} [Craig, Introduction to Robotics, 3.4]

where a revolute joint has theta_i = s q + ``theta`` and a prismatic one
d_i = s q + ``d``. The convention is never guessed.

A table alone cannot place its base and its tip freely, and D-H numbers of nearly
parallel axes blow up. So a row may begin with fixed motions (``before``), a file may
end with some (``tool``), and a row may give its ``axis`` instead of D-H numbers, in the
frame that ``before`` ends in.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Literal

from cuspaudit.robot.chain import (
    X_AXIS,
    Z_AXIS,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
)
from cuspaudit.robot.formats.dh.rows import COLUMNS, Row, check_known, parse_rows, word
from cuspaudit.robot.formats.motion_text import parse_motions
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.numbers import AngleUnit
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.robot import Robot, parse_expectation
from cuspaudit.robot.tables import Table, read_table
from cuspaudit.robot.task import check_limits, default_task, parse_task

__all__ = ["Convention", "chain_from_rows", "read_dh", "robot_from_table"]

Convention = Literal["standard", "modified"]

_HEAD = (
    *("name", "title", "source", "convention", "units", "angle_unit"),
    *("task", "base", "tip", "tool", "expect"),
)
_MANY_TURNS = 12.566


def read_dh(
    path: Path | str,
    *,
    task: str | None = None,
    convention: str | None = None,
    angle_unit: str | None = None,
) -> Robot:
    """The robot of a D-H table in a .yaml, .yml, .json or .csv file.

    Args:
        path: the file.
        task: a name in `robot.task.DIMENSIONS`, instead of the file's.
        convention: "standard" or "modified", where the file does not say.
        angle_unit: "rad" or "deg" of bare angles, where the file does not say.

    Raises:
        InvalidRobotError: the table cannot be read as it stands.
    """
    path = Path(path)
    place = Place(str(path))
    table = read_table(path, COLUMNS, place)
    return robot_from_table(table, path, task, convention, angle_unit)


def robot_from_table(
    table: Table,
    path: Path,
    task: str | None = None,
    convention: str | None = None,
    angle_unit: str | None = None,
) -> Robot:
    """The robot of a table read already; see `read_dh`, also for what it raises.

    Args:
        table: the rows and what stands beside them.
        path: the file they are from, for names and messages.
        task: as in `read_dh`.
        convention: as in `read_dh`.
        angle_unit: as in `read_dh`.
    """
    place = Place(str(path))
    head = table.head
    check_known(head, _HEAD, place)
    length_unit, angles = _units(head, angle_unit, place)
    rows = parse_rows(table.rows, angles, place)
    joints, tool = chain_from_rows(rows, _convention(table, convention, place))
    if head.get("tool") is not None:
        tool += parse_motions(head["tool"], "tool", place.at("tool"), angles)
    chosen = task or word(head, "task", place)
    chain = Chain(
        name=word(head, "name", place) or path.stem,
        joints=joints,
        tool=tool,
        task=parse_task(chosen, place) if chosen else default_task(len(joints)),
        base=word(head, "base", place) or "base",
        tip=word(head, "tip", place) or "tip",
        unit=length_unit or "m",
    )
    unit_note = () if length_unit else ("no unit of length is stated: read as m",)
    return Robot(
        name=chain.name,
        file=str(path),
        chain=chain,
        title=word(head, "title", place) or "",
        source=word(head, "source", place) or "",
        expect=_expectation(head, place),
        notes=(*unit_note, *_notes(rows), *check_limits(chain, place)),
    )


def chain_from_rows(
    rows: Sequence[Row], convention: Convention
) -> tuple[tuple[Joint, ...], tuple[Motion, ...]]:
    """The joints of the rows, and the fixed transform after the last one."""
    joints = []
    pending: tuple[Motion, ...] = ()
    for row in rows:
        pending += row.before
        if row.axis is not None:
            joints.append(Joint(row.name, row.kind, pending, row.axis, row.limits))
            pending = ()
            continue
        shift, twist = _length(row, "a", row.a, 0), _twist(row)
        rise = _length(row, "d", row.d, 2)
        before, after = pending, rise + shift + twist
        if convention == "modified":
            before, after = pending + twist + shift, rise
        axis = (Fraction(0), Fraction(0), Fraction(row.sign))
        joints.append(
            Joint(row.name, row.kind, before + _offset(row), axis, row.limits)
        )
        pending = after
    return tuple(joints), pending


def _length(row: Row, column: str, value: Fraction, axis: int) -> tuple[Motion, ...]:
    if value == 0:
        return ()
    x, y, z = (value if k == axis else Fraction(0) for k in range(3))
    return (Translation((x, y, z), f"{row.name} {column}"),)


def _twist(row: Row) -> tuple[Motion, ...]:
    if row.alpha.is_zero:
        return ()
    return (Rotation(X_AXIS, row.alpha, f"{row.name} alpha"),)


def _offset(row: Row) -> tuple[Motion, ...]:
    if row.theta.is_zero:
        return ()
    return (Rotation(Z_AXIS, row.theta, f"{row.name} theta"),)


def _convention(table: Table, given: str | None, place: Place) -> Convention:
    """The one convention stated by the file's head, its column or the caller."""
    stated = [word(row, "convention", place) for row in table.rows]
    stated += [word(table.head, "convention", place), given]
    names = {name for name in stated if name is not None}
    if names == {"standard"}:
        return "standard"
    if names == {"modified"}:
        return "modified"
    if len(names) > 1:
        found = f"several conventions: {', '.join(sorted(quoted(n) for n in names))}"
    elif names:
        found = f"the convention {quoted(names.pop())} is unknown"
    else:
        found = "no convention"
    expected = (
        "state standard or modified: the same numbers are different robots "
        "(convention: standard in YAML, # convention=standard above a CSV header)"
    )
    raise place.error(found, expected)


def _units(
    head: Mapping[str, object], given: str | None, place: Place
) -> tuple[str | None, AngleUnit | None]:
    """The units of length and of bare angles, None where not stated."""
    units = head.get("units")
    entries: Mapping[str, object] = {"length": units}
    here = place.at("units")
    if isinstance(units, Mapping):
        check_known(units, ("length", "angle"), here)
        entries = units
    length = word(entries, "length", here)
    if length not in (None, "m", "mm"):
        found = f"the unit of length {quoted(str(length))}"
        raise here.error(found, "write m or mm")
    stated = [word(entries, "angle", here), word(head, "angle_unit", place), given]
    angles = {name for name in stated if name is not None}
    if not angles:
        return length, None
    if angles == {"rad"}:
        return length, "rad"
    if angles == {"deg"}:
        return length, "deg"
    found = f"the unit of angle {', '.join(sorted(quoted(n) for n in angles))}"
    raise here.error(found, "write rad or deg, the same wherever it stands")


def _expectation(
    head: Mapping[str, object], place: Place
) -> Mapping[str, str | int | None] | None:
    entries = head.get("expect")
    if entries is None or entries in ("null", "~", ""):
        return None
    here = place.at("expect")
    if not isinstance(entries, Mapping):
        raise here.error("not a mapping", "write expect: {verdict: cuspidal}")
    return parse_expectation(entries, here)


def _notes(rows: Sequence[Row]) -> list[str]:
    """A remark for each angle so large that it looks like degrees."""
    return [
        f"{row.name} {column} is more than two turns: rad, or meant as deg?"
        for row in rows
        for column, angle in (("theta", row.theta), ("alpha", row.alpha))
        if abs(angle_value(angle)) > _MANY_TURNS
    ]
