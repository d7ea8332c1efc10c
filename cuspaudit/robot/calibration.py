"""The calibration of one built arm: what its axes really are, read from a file.

Two forms, both YAML::

    kinematics:                           # Universal Robots' ROS calibration
      shoulder: {x: 0, y: 0, z: 0.0892, roll: 0, pitch: 0, yaw: 1.2e-07}
      upper_arm: ...                       # forearm, wrist_1, wrist_2, wrist_3, hash

    convention: standard                  # D-H with deltas; the robot's convention
    units: m
    delta_a: [-0.0002, 0.0038, ...]       # one a joint; any of the four may be absent
    delta_d: [...]
    delta_alpha: [...]                    # rad, or with a unit
    delta_theta: [...]

The first says for each joint the whole fixed transform before it, in m and rad; a joint
turns about the z axis. The second is added to the robot's table, row by row. Numbers
are parsed, never evaluated.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path

from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.numbers import parse_angle, parse_length
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.tables import read_mapping

__all__ = ["Calibration", "calibrated", "read_calibration"]

_LINKS = ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3")
_AXES: tuple[tuple[str, Vector], ...] = (
    ("yaw", Z_AXIS),
    ("pitch", Y_AXIS),
    ("roll", X_AXIS),
)
_COLUMNS = ("a", "d", "alpha", "theta")
_DELTAS = ("delta_a", "delta_d", "delta_alpha", "delta_theta")
_FORMS = "write kinematics: {shoulder: ...}, or convention:, units: and delta_a: [...]"
_UNITS = {"m": Fraction(1), "mm": Fraction(1, 1000)}
_LIKELY = (0.8, 1.25)
_MOST = 50


@dataclass(frozen=True, slots=True)
class Deltas:
    """What is added to a row of a D-H table; lengths in m."""

    a: Fraction
    d: Fraction
    alpha: Angle
    theta: Angle


@dataclass(frozen=True)
class Calibration:
    """A calibration as its file gives it.

    Attributes:
        file: as the user gave it.
        links: the fixed transform before each joint, lengths in m; or empty.
        convention: "standard" or "modified", of the deltas.
        deltas: one a joint; or empty.
    """

    file: str
    links: tuple[tuple[Motion, ...], ...] = ()
    convention: str = ""
    deltas: tuple[Deltas, ...] = ()


def read_calibration(path: Path) -> Calibration:
    """The calibration in a YAML file.

    Raises:
        InvalidRobotError: it cannot be read, or is none.
    """
    place = Place(str(path))
    entries = read_mapping(path, place, "kinematics: ... or delta_a: ...")
    if "kinematics" in entries:
        if len(entries) > 1:
            [other, *_] = (key for key in entries if key != "kinematics")
            raise place.error(f"{quoted(other)} beside kinematics", "leave it out")
        links = entries["kinematics"]
        return Calibration(str(path), _links(links, place.at("kinematics")))
    return _with_deltas(entries, place)


def calibrated(robot: Robot, calibration: Calibration) -> Robot:
    """The robot as it was built: the same joints and tip, other axes.

    Raises:
        InvalidRobotError: the calibration is one of another arm.
    """
    place, chain = Place(calibration.file), robot.chain
    count = len(calibration.links or calibration.deltas)
    if len(chain.joints) != count or set(chain.kinds) != {"revolute"}:
        found = f"{count} joints that turn, and {quoted(robot.name)} has {_what(chain)}"
        raise place.error(found, "give the calibration of this robot")
    if calibration.links:
        built = _from_links(chain, calibration.links)
        _check_size(chain, built, place)
    else:
        built = _from_deltas(chain, calibration, place)
    note = f"calibrated by {calibration.file}"
    return replace(
        robot,
        chain=built,
        urdf=None,
        notes=(*robot.notes, note),
        expect=None,
        other_convention=None,
    )


def _links(value: object, place: Place) -> tuple[tuple[Motion, ...], ...]:
    if not isinstance(value, Mapping):
        raise place.error("no mapping of links", _FORMS)
    for key in value:
        if key not in (*_LINKS, "hash"):
            raise place.error(f"{quoted(str(key))} is unknown", f"write {_names()}")
    for name in _LINKS:
        if name not in value:
            raise place.error(f"{name} is missing", f"write {_names()}")
    return tuple(_link(value[name], place.at(name)) for name in _LINKS)


def _link(value: object, place: Place) -> tuple[Motion, ...]:
    needed = ("x", "y", "z", "roll", "pitch", "yaw")
    if not isinstance(value, Mapping) or set(value) != set(needed):
        raise place.error("not x, y, z, roll, pitch, yaw", "write these six")
    x, y, z = (parse_length(_text(value, k, place), place.at(k)) for k in "xyz")
    source = place.where
    turns = (
        Rotation(axis, parse_angle(_text(value, key, place), place.at(key), "rad"))
        for key, axis in _AXES
    )
    move = Translation((x, y, z), source)
    return (move, *(turn for turn in turns if not turn.angle.is_zero))


def _with_deltas(entries: Mapping[str, object], place: Place) -> Calibration:
    for key in entries:
        if key not in ("convention", "units", *_DELTAS):
            raise place.error(f"{quoted(key)} is unknown", _FORMS)
    if not set(entries) & set(_DELTAS):
        raise place.error("no calibration", _FORMS)
    convention, units = (entries.get(key) for key in ("convention", "units"))
    if convention not in ("standard", "modified"):
        found = "no convention" if convention is None else quoted(str(convention))
        raise place.at("convention").error(found, "write standard or modified")
    if not isinstance(units, str) or units not in _UNITS:
        found = "no units" if units is None else quoted(str(units))
        raise place.at("units").error(found, "write m or mm")
    columns = {
        key: _column(entries[key], place.at(key)) for key in _DELTAS if key in entries
    }
    counts = {len(column) for column in columns.values()}
    if len(counts) > 1:
        raise place.error("lists of different lengths", "write one number a joint")
    scale, rows = _UNITS[units], []
    for number in range(counts.pop()):
        given = {key: column[number] for key, column in columns.items()}
        here = place.at(f"joint {number + 1}")
        a, d = (
            parse_length(given.get(key, "0"), here.at(key)) * scale
            for key in ("delta_a", "delta_d")
        )
        alpha, theta = (
            parse_angle(given.get(key, "0"), here.at(key), "rad")
            for key in ("delta_alpha", "delta_theta")
        )
        rows.append(Deltas(a, d, alpha, theta))
    return Calibration(place.file, (), str(convention), tuple(rows))


def _column(value: object, place: Place) -> Sequence[str]:
    if not isinstance(value, list) or not all(isinstance(x, str) for x in value):
        raise place.error("no list of numbers", "write [0.0001, ...], one a joint")
    if not 0 < len(value) <= _MOST:
        raise place.error(f"{len(value)} numbers", "write one a joint")
    return value


def _text(value: Mapping[str, object], key: str, place: Place) -> str:
    found = value[key]
    if not isinstance(found, str):
        raise place.at(key).error("no number", "write for example 0.0892")
    return found


def _from_links(chain: Chain, links: Sequence[tuple[Motion, ...]]) -> Chain:
    factor = 1 / _UNITS[chain.unit]
    joints: list[Joint] = []
    for joint, motions in zip(chain.joints, links, strict=True):
        before = tuple(_scaled(motion, factor) for motion in motions)
        joints.append(replace(joint, before=before, axis=Z_AXIS, printed_axis=None))
    # the last row of a table stands in the last transform, which ends at the flange
    own = {f"{chain.joints[-1].name} {column}" for column in _COLUMNS}
    tool = tuple(motion for motion in chain.tool if motion.source not in own)
    return replace(chain, joints=tuple(joints), tool=tool)


def _from_deltas(chain: Chain, calibration: Calibration, place: Place) -> Chain:
    """The chain with the deltas of each row where the row stands.

    Rz(theta) commutes with Tz(d) and with the joint, and Tx(a) with Rx(alpha). Before a
    joint stands its theta, last; a row's a and alpha stand just before the theta of
    the joint that follows them, or of their own in the modified convention.
    """
    factor = 1 / _UNITS[chain.unit]
    places = [joint.before for joint in chain.joints] + [chain.tool]
    names = [*(joint.name for joint in chain.joints), ""]
    _check_rows(chain, place)
    shift = 1 if calibration.convention == "standard" else 0
    for number, delta in enumerate(calibration.deltas):
        about_z = _pair(Z_AXIS, delta.theta, delta.d * factor)
        about_x = _pair(X_AXIS, delta.alpha, delta.a * factor)
        row, offset = _split(places[number + shift], names[number + shift])
        if shift:
            places[number + 1] = (*about_z, *row, *about_x, *offset)
        else:
            places[number] = (*row, *about_x, *offset, *about_z)
    joints = [
        replace(joint, before=before)
        for joint, before in zip(chain.joints, places[:-1], strict=True)
    ]
    return replace(chain, joints=tuple(joints), tool=places[-1])


def _split(
    motions: tuple[Motion, ...], name: str
) -> tuple[tuple[Motion, ...], tuple[Motion, ...]]:
    """The motions before the offset of a joint, and that offset."""
    if motions and motions[-1].source == f"{name} theta":
        return motions[:-1], motions[-1:]
    return motions, ()


def _check_rows(chain: Chain, place: Place) -> None:
    """Refuse deltas of a chain that is more than the rows of a D-H table."""
    columns = {
        f"{joint.name} {column}" for joint in chain.joints for column in _COLUMNS
    }
    motions = [motion for joint in chain.joints for motion in joint.before]
    is_table = all(motion.source in columns for motion in motions)
    if not is_table or any(joint.axis[:2] != (0, 0) for joint in chain.joints):
        found = f"deltas of D-H numbers, and {quoted(chain.name)} is no plain D-H table"
        raise place.error(found, "write the sums into the rows of a table")


def _pair(axis: Vector, angle: Angle, length: Fraction) -> tuple[Motion, ...]:
    found: list[Motion] = []
    if not angle.is_zero:
        found.append(Rotation(axis, angle))
    if length:
        x, y, z = (entry * length for entry in axis)
        found.append(Translation((x, y, z)))
    return tuple(found)


def _scaled(motion: Motion, factor: Fraction) -> Motion:
    if isinstance(motion, Rotation):
        return motion
    x, y, z = (entry * factor for entry in motion.vector)
    return replace(motion, vector=(x, y, z))


def _check_size(chain: Chain, built: Chain, place: Place) -> None:
    """Refuse a calibration whose links are much longer or shorter together."""
    nominal, found = (_size(each) for each in (chain, built))
    if nominal and not _LIKELY[0] < found / nominal < _LIKELY[1]:
        said = f"links of {found:.4g} {chain.unit} in all, {nominal:.4g} in the robot"
        raise place.error(said, "give the calibration of this robot")


def _size(chain: Chain) -> float:
    """The lengths of the fixed transforms between the joints, added up."""
    total = 0.0
    for joint in chain.joints[1:]:
        moves = [m.vector for m in joint.before if isinstance(m, Translation)]
        total += sum(float(sum(x * x for x in v)) ** 0.5 for v in moves)
    return total


def _what(chain: Chain) -> str:
    slides = chain.kinds.count("prismatic")
    return f"{len(chain.joints)} joints" + (f", {slides} of them slides" * bool(slides))


def _names() -> str:
    return f"{', '.join(_LINKS[:-1])} and {_LINKS[-1]}"
