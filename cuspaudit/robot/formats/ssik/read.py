"""Arms from the modules of ssik: a fixed transform before and after each joint.

A module holds 4 x 4 transforms as doubles that a program has multiplied, so a chain of
exactly these numbers has no rotations. Lengths and axes are taken to nine decimals, and
rotations as turns about z, y and x to twelve; forward kinematics at zero are held to
the pose that the module states.
"""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    JointKind,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.formats.format import MOST_JOINTS
from cuspaudit.robot.formats.ssik.constants import Constants
from cuspaudit.robot.frames import frames
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.tables import read_text
from cuspaudit.robot.task import check_limits, default_task, parse_task

__all__ = ["read_module"]

_MOST_BYTES = 4_000_000
_PLACES = 9
_HOME = 1e-6
"""How far the pose at zero may be from the one stated: unit of length, and 1."""
_KINDS: dict[str, JointKind] = {"revolute": "revolute", "prismatic": "prismatic"}
_NOTE = "transforms are doubles: lengths are read to 9 decimals, turns to 12"


def read_module(path: Path | str, *, task: str | None = None) -> Robot:
    """The arm whose constants a module holds; no line of it is run.

    Args:
        path: the file.
        task: a name in `robot.task.DIMENSIONS`; by default the one for so many joints.

    Raises:
        InvalidRobotError: the constants are not those of an arm, or the pose at zero
            is not the one that the module states.
    """
    path = Path(path)
    place = Place(str(path))
    constants = Constants(read_text(path, place, _MOST_BYTES), place)
    names = constants.entries("_JOINT_NAMES")
    count = len(names)
    if not 0 < count <= MOST_JOINTS:
        raise place.error(f"{count} joints", f"give 1 to {MOST_JOINTS}")
    joints: list[Joint] = []
    before: tuple[Motion, ...] = ()
    lefts = constants.array("_JOINT_T_LEFTS", count, 4, 4)
    rights = constants.array("_JOINT_T_RIGHTS", count, 4, 4)
    axes = constants.array("_JOINT_AXES", count, 3)
    kinds = _of_length(constants, "_JOINT_TYPES", count, place)
    limits = _of_length(constants, "_JOINT_LIMITS", count, place)
    for k, name in enumerate(names):
        here = place.at(f"joint {quoted(str(name))}")
        if kinds[k] not in _KINDS:
            raise here.error(f"type {quoted(str(kinds[k]))}", "revolute or prismatic")
        before += _motions(lefts[k], here)
        joints.append(
            Joint(
                str(name),
                _KINDS[kinds[k]],
                before,
                _vector(axes[k], here),
                _limits(limits[k], here),
            )
        )
        before = _motions(rights[k], here)
    chosen = parse_task(task, place) if task else default_task(count)
    name = f"{path.parent.name}-{path.stem.removesuffix('_ik')}"
    chain = Chain(name, tuple(joints), before, chosen)
    _check_home(chain, constants, place)
    notes = (_NOTE, *check_limits(chain, place))
    return Robot(name, str(path), chain, source="ssik", notes=notes)


def _of_length(constants: Constants, name: str, count: int, place: Place) -> list[Any]:
    entries = constants.entries(name)
    if len(entries) != count:
        raise place.at(name).error(f"{len(entries)} entries", f"give {count}")
    return entries


def _check_home(chain: Chain, constants: Constants, place: Place) -> None:
    stated = np.array(constants.array("T_HOME", 4, 4), float)
    error = np.abs(frames(chain, np.zeros(len(chain.joints)))[-1] - stated).max()
    if not error <= _HOME:
        raise place.at("T_HOME").error(
            f"the pose at zero, {error:.1e} from that of the joints",
            "give a module as ssik writes it",
        )


def _limits(pair: Any, place: Place) -> tuple[Angle, Angle] | None:
    if pair is None:
        return None
    numbers = [v for v in pair if isinstance(v, int | float)] if pair else []
    if len(numbers) != 2 or not np.all(np.isfinite(numbers)):
        raise place.error("other limits", "give two numbers or None")
    lower, upper = (Angle(radians=Fraction(str(value))) for value in numbers)
    return lower, upper


def _vector(values: Any, place: Place) -> Vector:
    x, y, z = (Fraction(f"{value:.{_PLACES}f}") for value in values)
    if not (x or y or z):
        raise place.error("the axis 0 0 0", "give a direction")
    return x, y, z


def _motions(rows: Any, place: Place) -> tuple[Motion, ...]:
    """A transform as a step and turns about z, y, x."""
    T = np.array(rows, float)
    R = T[:3, :3]
    is_rotation = np.abs(R @ R.T - np.eye(3)).max() < _HOME and np.linalg.det(R) > 0
    if not is_rotation or np.any(T[3] != (0, 0, 0, 1)):
        raise place.error("a matrix that is no rigid motion", "give a transform")
    x, y, z = (Fraction(f"{value:.{_PLACES}f}") for value in T[:3, 3])
    step = (x, y, z)
    motions: list[Motion] = [Translation(step, "xyz")] if any(step) else []
    level = float(np.hypot(T[0, 0], T[1, 0]))
    pitch = float(np.arctan2(-T[2, 0], level))
    if level > 1e-9:
        yaw, roll = np.arctan2(T[1, 0], T[0, 0]), np.arctan2(T[2, 1], T[2, 2])
    else:
        yaw, roll = 0.0, np.arctan2(np.sign(pitch) * T[0, 1], T[1, 1])
    for axis, value in ((Z_AXIS, yaw), (Y_AXIS, pitch), (X_AXIS, roll)):
        radians = Fraction(f"{float(value):.12f}")
        if radians:
            motions.append(Rotation(axis, Angle(radians=radians), "turn"))
    return tuple(motions)
