"""Tool paths from files: CSV and JSON, poses, positions or joint vectors.

::

    x,y,z,qw,qx,qy,qz        one row a waypoint; lengths in the robot's unit, or with
    0.5,0,250 mm,1,0,0,0     m or mm behind the number

    x,y,z                    for a task that asks for no orientation

    joint_1,joint_2,...      joint vectors, one column a joint of the chain
    0.1 rad,30 deg,...

    [{"position": [0.5, 0, 0.25], "quaternion": [1, 0, 0, 0]}, ...]
    [[0.1, 0.5, ...], ...]   joint vectors, with the option --angle-unit

Numbers are parsed as those of a robot file are: exactly, and never evaluated.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.numbers import AngleUnit, parse_angle, parse_length
from cuspaudit.robot.place import Place, listing, quoted
from cuspaudit.toolpath.joint_pose import JointValue, float_values, pose_of_joints
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import Pose, Quaternion, ToolPath, Vector, half_turn

__all__ = [
    "angle_unit_named",
    "checked_path",
    "closed_path",
    "parse_joint",
    "read_path",
    "unit_quaternion",
    "within_reason",
]

_POSITION = ("x", "y", "z")
_POSE = (*_POSITION, "qw", "qx", "qy", "qz")
_LARGEST = 200 * 2**20
_FARTHEST = Fraction(10**10)
_UNIT = Fraction(1, 10**6)
_METRES = {"m": Fraction(1), "mm": Fraction(1, 1000)}
_HEADERS = "x,y,z or x,y,z,qw,qx,qy,qz or the joints' names"

Row = tuple[Vector, Quaternion | None] | tuple[JointValue, ...]


def read_path(
    file: Path, arm: TracedArm, angle_unit: AngleUnit | None = None
) -> ToolPath:
    """The tool path in a file.

    Args:
        file: a CSV or JSON file.
        arm: whose task says what a waypoint needs.
        angle_unit: of bare joint angles.

    Raises:
        InvalidInputError: it is not one; the message names the row.
    """
    place = Place(str(file))
    text = _text(file, place)
    chain = arm.robot_chain
    if text.lstrip()[:1] in ("[", "{"):
        rows = _json_rows(text, chain, place, angle_unit)
    else:
        rows = _csv_rows(text, chain, place, angle_unit)
    return _built(rows, arm, str(file))


def checked_path(poses: Sequence[Pose], arm: TracedArm, file: str) -> ToolPath:
    """The path through ``poses``, each with what the task of the arm needs.

    Raises:
        InvalidInputError: fewer than two, an orientation is missing, or a leg turns by
            180 degrees.
    """
    place = Place(file)
    if len(poses) < 2:
        many = "no waypoint" if not poses else "one waypoint"
        raise place.error(many, "write at least two, one a row")
    needed = arm.task != "position"
    for pose in poses:
        if needed and pose.quaternion is None:
            raise place.at(f"row {pose.row}").error(
                f"no orientation, which the task {arm.robot_chain.task} needs",
                "give the columns qw,qx,qy,qz (JSON: quaternion)",
            )
    if not needed:
        poses = [Pose(pose.position, None, pose.row) for pose in poses]
    for first, second in pairwise(poses):
        if arm.task == "pose" and half_turn(first, second):
            raise place.at(f"row {second.row}").error(
                "the leg to here turns by 180 degrees, about no one axis",
                "put a waypoint in between",
            )
    return ToolPath(tuple(poses), None, file)


def closed_path(path: ToolPath, arm: TracedArm) -> ToolPath:
    """The path, with its first waypoint once more at the end unless it is there."""
    if path.is_closed:
        return path
    first = path.poses[0]
    last = Pose(first.position, first.quaternion, len(path.poses) + 1)
    longer = checked_path([*path.poses, last], arm, path.file)
    joints = None if path.joints is None else (*path.joints, path.joints[0])
    return ToolPath(longer.poses, joints, path.file)


def angle_unit_named(name: str | None) -> AngleUnit | None:
    """The unit of bare angles that an option names; None for none."""
    if name is None or name == "rad":
        return "rad" if name else None
    if name == "deg":
        return "deg"
    place = Place("--angle-unit")
    raise place.error(f"{quoted(name)} is no unit", "write rad or deg")


def unit_quaternion(entries: Sequence[Fraction], place: Place) -> Quaternion:
    """The quaternion w, x, y, z, of length 1 to 1e-6.

    Raises:
        InvalidInputError: it has another length.
    """
    square = sum((x * x for x in entries), Fraction(0))
    if not (1 - _UNIT) ** 2 <= square <= (1 + _UNIT) ** 2:
        raise place.error(
            f"a quaternion of length {float(square) ** 0.5:.6g}",
            "write w, x, y, z of length 1",
        )
    w, x, y, z = entries
    return (w, x, y, z)


def parse_joint(
    text: str, chain: Chain, index: int, place: Place, unit: AngleUnit | None
) -> JointValue:
    """The value of a joint: an angle where it turns, a length where it slides."""
    joint = chain.joints[index]
    if joint.kind == "prismatic":
        return _length(text, chain, place)
    return parse_angle(text, place, unit)


def _text(file: Path, place: Place) -> str:
    try:
        if file.stat().st_size > _LARGEST:
            raise place.error("more than 200 MB", "split the path")
        return file.read_text("utf-8-sig")
    except OSError as error:
        raise place.error(
            f"cannot be read ({error.strerror or error})", "name a CSV or JSON file"
        ) from None
    except UnicodeDecodeError:
        raise place.error("not a text file", "write CSV or JSON in UTF-8") from None


def _built(rows: Sequence[Row], arm: TracedArm, file: str) -> ToolPath:
    poses, joints = [], []
    for number, row in enumerate(rows, 1):
        if len(row) == 2 and isinstance(row[0], tuple):
            position, quaternion = row
            poses.append(Pose(position, quaternion, number))
            continue
        pose = pose_of_joints(arm, row)
        poses.append(Pose(pose.position, pose.quaternion, number))
        joints.append(tuple(float_values(row)))
    path = checked_path(poses, arm, file)
    return ToolPath(path.poses, tuple(joints) if joints else None, file)


def _csv_rows(
    text: str, chain: Chain, place: Place, unit: AngleUnit | None
) -> list[Row]:
    try:
        lines = text.splitlines()
        reader = csv.reader(lines, delimiter=_delimiter(lines), strict=True)
        table = [row for row in reader if any(row)]
    except csv.Error as error:
        raise place.error(f"not CSV ({error})", f"begin with {_HEADERS}") from None
    table = [row for row in table if not row[0].lstrip().startswith("#")]
    if not table:
        raise place.error("no rows", f"begin with a header: {_HEADERS}")
    names = [name.strip() for name in table[0]]
    columns = _columns(names, chain, place)
    rows: list[Row] = []
    for number, cells in enumerate(table[1:], 1):
        here = place.at(f"row {number}")
        if len(cells) != len(names):
            many = f"{len(cells)} cells for {len(names)} columns"
            raise here.error(many, "write one cell a column")
        ordered = [cells[k] for k in columns]
        if len(columns) == len(chain.joints) and names[columns[0]] not in _POSE:
            rows.append(_joint_row(ordered, chain, here, unit))
        else:
            rows.append(_pose_row(ordered, chain, here))
    return rows


def _delimiter(lines: Sequence[str]) -> str:
    """What stands between cells: a comma, or what spreadsheets copy instead of it."""
    head = next((line for line in lines if line.strip() and line[0] != "#"), "")
    return next((mark for mark in (",", ";", "\t") if mark in head), ",")


def _columns(names: list[str], chain: Chain, place: Place) -> list[int]:
    """Where the columns of a pose, a position or a joint vector stand."""
    own = [joint.name for joint in chain.joints]
    for wanted in (_POSE, _POSITION, tuple(own)):
        if sorted(names) == sorted(wanted):
            return [names.index(name) for name in wanted]
    raise place.error(
        f"a header of {listing(names)}",
        f"write x,y,z or x,y,z,qw,qx,qy,qz or the joints: {','.join(own)}",
    )


def _pose_row(cells: Sequence[str], chain: Chain, place: Place) -> Row:
    x, y, z = (
        _length(cell, chain, place.at(name))
        for name, cell in zip(_POSITION, cells, strict=False)
    )
    if len(cells) == 3:
        return (x, y, z), None
    entries = [
        parse_length(cell, place.at(name))
        for name, cell in zip(_POSE[3:], cells[3:], strict=True)
    ]
    return (x, y, z), unit_quaternion(entries, place)


def _joint_row(
    cells: Sequence[str],
    chain: Chain,
    place: Place,
    unit: AngleUnit | None,
) -> tuple[JointValue, ...]:
    return tuple(
        parse_joint(cell, chain, k, place.at(chain.joints[k].name), unit)
        for k, cell in enumerate(cells)
    )


def _length(text: str, chain: Chain, place: Place) -> Fraction:
    """A length in the robot's unit; m and mm may stand behind the number."""
    stripped, own = text.strip(), Fraction(1)
    for unit in ("mm", "m"):
        if stripped.endswith(unit):
            stripped = stripped.removesuffix(unit)
            own = _METRES[unit] / _METRES[chain.unit]
            break
    return within_reason(parse_length(stripped, place) * own, place)


def within_reason(value: Fraction, place: Place) -> Fraction:
    """A length that no tool path exceeds.

    Raises:
        InvalidInputError: it is above 1e10.
    """
    if abs(value) > _FARTHEST:
        raise place.error("a length above 1e10", "write a smaller number")
    return value


def _json_rows(
    text: str, chain: Chain, place: Place, unit: AngleUnit | None
) -> list[Row]:
    def constant(name: str) -> Any:
        raise place.error(f"the number {name}", "write finite numbers")

    try:
        data = json.loads(text, parse_float=str, parse_int=str, parse_constant=constant)
    except (json.JSONDecodeError, RecursionError) as error:
        where = (
            f"line {error.lineno}" if isinstance(error, json.JSONDecodeError) else ""
        )
        raise place.at(where).error(
            "not JSON", 'write [{"position": [...], "quaternion": [...]}, ...]'
        ) from None
    if not isinstance(data, list):
        raise place.error("not a list", "write a list of waypoints")
    return [
        _json_row(entry, chain, place.at(f"row {number}"), unit)
        for number, entry in enumerate(data, 1)
    ]


def _json_row(entry: Any, chain: Chain, place: Place, unit: AngleUnit | None) -> Row:
    if isinstance(entry, list):
        count = len(chain.joints)
        if len(entry) != count:
            raise place.error(
                f"{len(entry)} joint values", f"write {count}, one a joint"
            )
        return _joint_row([_cell(x, place) for x in entry], chain, place, unit)
    if not isinstance(entry, dict) or "position" not in entry:
        raise place.error(
            "no position", 'write {"position": [x, y, z], "quaternion": [w, x, y, z]}'
        )
    other = set(entry) - {"position", "quaternion"}
    if other:
        raise place.error(
            f"the key {quoted(sorted(other)[0])}", "use position and quaternion"
        )
    cells = list(_numbers(entry["position"], 3, place.at("position")))
    if entry.get("quaternion") is not None:
        cells += _numbers(entry["quaternion"], 4, place.at("quaternion"))
    return _pose_row(cells, chain, place)


def _numbers(entry: Any, count: int, place: Place) -> list[str]:
    if not isinstance(entry, list) or len(entry) != count:
        raise place.error("not a list of numbers", f"write {count} numbers in brackets")
    return [_cell(x, place) for x in entry]


def _cell(entry: Any, place: Place) -> str:
    if not isinstance(entry, str):
        raise place.error(f"{quoted(str(entry))} is no number", "write a number")
    return entry
