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

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
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
from cuspaudit.robot.entries import check_known, word
from cuspaudit.robot.formats.dh.headers import stated_by
from cuspaudit.robot.formats.dh.lines import read_table
from cuspaudit.robot.formats.dh.rows import (
    TableRow,
    named_rows,
    parse_rows,
    split_play,
    with_play,
)
from cuspaudit.robot.formats.dh.settings import Convention, Given, Settings, settings
from cuspaudit.robot.formats.motion_text import parse_motions
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.place import Place, listing
from cuspaudit.robot.robot import Robot, TableReading, parse_expectation
from cuspaudit.robot.tables import Table
from cuspaudit.robot.task import check_limits, default_task, parse_task
from cuspaudit.robot.tolerance import AxisTolerance, LooseNumber, parse_tolerance

__all__ = ["chain_from_rows", "read_dh", "robot_from_table"]

_HEAD = (
    *("name", "title", "source", "convention", "units", "angle_unit"),
    *("task", "base", "tip", "tool", "expect", "tolerance"),
)
_MANY_TURNS = 12.566


def read_dh(
    path: Path | str,
    *,
    task: str | None = None,
    convention: str | None = None,
    angle_unit: str | None = None,
    length_unit: str | None = None,
) -> Robot:
    """The robot of a D-H table in a YAML, JSON or CSV file, or one of `LINE_ENDINGS`.

    Args:
        path: the file.
        task: a name in `robot.task.DIMENSIONS`, instead of the file's.
        convention: "standard" or "modified", where the file does not say.
        angle_unit: "rad" or "deg" of bare angles, where the file does not say.
        length_unit: "m" or "mm", where the file does not say.

    Raises:
        InvalidRobotError: the table cannot be read as it stands.
    """
    path = Path(path)
    table = read_table(path, Place(str(path)))
    given = Given(convention, angle_unit, length_unit)
    return robot_from_table(table, path, task, given)


def robot_from_table(
    table: Table, path: Path, task: str | None = None, given: Given | None = None
) -> Robot:
    """The robot of a table read already; see `read_dh`, also for what it raises.

    Args:
        table: the rows and what stands beside them.
        path: the file they are from, for names and messages.
        task: as in `read_dh`.
        given: what the caller states of convention and units.
    """
    place = Place(str(path))
    check_known(table.head, _HEAD, place)
    named, headers = named_rows(table.rows, place)
    stated = stated_by(headers, place.at("header"))
    named, played = split_play(named)
    table = Table(table.head, named)
    head = table.head
    chosen = settings(table, stated, given or Given(), place)
    rows = parse_rows(table.rows, chosen.angle_unit, place)
    rows = with_play(rows, played, chosen.angle_unit, place)
    chain = _chain(head, rows, chosen, path, task)
    modified = chosen.convention == "modified"
    other = replace(chosen, convention="standard" if modified else "modified")
    notes = [*_settings_notes(chosen, stated), *_type_notes(rows), *_notes(rows)]
    return Robot(
        name=chain.name,
        file=str(path),
        chain=chain,
        title=word(head, "title", place) or "",
        source=word(head, "source", place) or "",
        expect=_expectation(head, place),
        notes=(*notes, *check_limits(chain, place)),
        other_convention=TableReading(
            other.convention, _chain(head, rows, other, path, task)
        ),
        tolerance=_tolerance(head, place),
        loose=tuple(number for row in rows for number in _loose(row)),
    )


def _tolerance(head: Mapping[str, object], place: Place) -> AxisTolerance | None:
    if head.get("tolerance") is None:
        return None
    return parse_tolerance(head["tolerance"], place.at("tolerance"))


def _loose(row: TableRow) -> Iterator[LooseNumber]:
    """The loose numbers of a row, by the motions they make."""
    for column, within in row.loose.items():
        axis = X_AXIS if column in ("a", "alpha") else Z_AXIS
        kind: Literal["turn", "slide"] = "slide" if column in ("a", "d") else "turn"
        yield LooseNumber(f"{row.name} {column}", kind, axis, within)


def _chain(
    head: Mapping[str, object],
    rows: Sequence[TableRow],
    chosen: Settings,
    path: Path,
    task: str | None,
) -> Chain:
    """The chain of the rows, with what the head says about it."""
    place = Place(str(path))
    joints, tool = chain_from_rows(rows, chosen.convention)
    if head.get("tool") is not None:
        tool += parse_motions(head["tool"], "tool", place.at("tool"), chosen.angle_unit)
    name = task or word(head, "task", place)
    return Chain(
        name=word(head, "name", place) or path.stem,
        joints=joints,
        tool=tool,
        task=parse_task(name, place) if name else default_task(len(joints)),
        base=word(head, "base", place) or "base",
        tip=word(head, "tip", place) or "tip",
        unit=chosen.length_unit or "m",
    )


def chain_from_rows(
    rows: Sequence[TableRow], convention: Convention
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


def _length(
    row: TableRow, column: str, value: Fraction, axis: int
) -> tuple[Motion, ...]:
    if value == 0 and column not in row.loose:
        return ()
    x, y, z = (value if k == axis else Fraction(0) for k in range(3))
    return (Translation((x, y, z), f"{row.name} {column}"),)


def _twist(row: TableRow) -> tuple[Motion, ...]:
    if row.alpha.is_zero and "alpha" not in row.loose:
        return ()
    return (Rotation(X_AXIS, row.alpha, f"{row.name} alpha"),)


def _offset(row: TableRow) -> tuple[Motion, ...]:
    if row.theta.is_zero and "theta" not in row.loose:
        return ()
    return (Rotation(Z_AXIS, row.theta, f"{row.name} theta"),)


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


def _settings_notes(chosen: Settings, stated: Mapping[str, str]) -> list[str]:
    """What was taken from nowhere, or from the names of the columns."""
    notes = []
    if chosen.length_unit is None:
        notes.append("no unit of length is stated: read as m")
    if "convention" in stated:
        notes.append(
            "a_{i-1} and alpha_{i-1} stand in the row of joint i: modified convention"
        )
    return notes


def _type_notes(rows: Sequence[TableRow]) -> list[str]:
    """Which rows state no type, and how they are read."""
    if all(row.kind == "revolute" and not row.is_typed for row in rows):
        return ["no row states a type: all joints are read as revolute"]
    notes = []
    for kind, reason in (("revolute", ""), ("prismatic", ", as d is what varies")):
        names = [row.name for row in rows if row.kind == kind and not row.is_typed]
        if names:
            verb = "states" if len(names) == 1 else "state"
            notes.append(f"{listing(names)} {verb} no type: read as {kind}{reason}")
    return notes


def _notes(rows: Sequence[TableRow]) -> list[str]:
    """A remark for each angle so large that it looks like degrees."""
    return [
        f"{row.name} {column} is more than two turns: rad, or meant as deg?"
        for row in rows
        for column, angle in (("theta", row.theta), ("alpha", row.alpha))
        if abs(angle_value(angle)) > _MANY_TURNS
    ]
