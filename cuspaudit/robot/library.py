"""Robots by name: those of ``robots/``, those of example-robot-data, and files.

Names of robot_descriptions and of ssik are known as well where these are installed.
example-robot-data is found by its folder beside pinocchio and is not imported.
"""

from __future__ import annotations

import difflib
import importlib.util
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

import cuspaudit
from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.descriptions import description_file, description_names
from cuspaudit.robot.formats.read_robot import chains_in, read_robot, takes
from cuspaudit.robot.formats.registry import endings
from cuspaudit.robot.numbers import format_angle, format_rational
from cuspaudit.robot.place import listing, quoted
from cuspaudit.robot.proposals import check_task
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.ssik_arms import ssik_arms
from cuspaudit.robot.task import default_task
from cuspaudit.robot.task import lock as lock_joints

if TYPE_CHECKING:
    from cuspaudit.robot.formats.choice import Candidate

__all__ = [
    "Described",
    "described",
    "example_robot_data",
    "library",
    "open_robot",
    "serial_chains",
    "uses",
]

_SPARE = "seven-joints"
"""The folder of our robots with a joint to spare, which `audit --free` takes."""


def open_robot(
    name_or_path: str | Path,
    *,
    base: str | None = None,
    tip: str | None = None,
    task: str | None = None,
    lock: Mapping[str, str | Angle | Fraction] | None = None,
    convention: str | None = None,
    angle_unit: str | None = None,
    length_unit: str | None = None,
    packages: Mapping[str, str] | None = None,
    xacro_args: Mapping[str, str] | None = None,
    square: bool = True,
) -> Robot:
    """The robot in a file, or of a name in the library.

    Args:
        name_or_path: a file, or a name that `library` lists.
        base: base link of a URDF.
        tip: tip link of a URDF.
        task: a name in `robot.task.DIMENSIONS`.
        lock: joint name to the value at which it is fixed; without ``task``, the
            task is then that of the joints left.
        convention: D-H convention of a table that does not say.
        angle_unit: unit of bare angles of a table that does not say.
        length_unit: unit of lengths of a table that does not say.
        packages: name to folder, for ``$(find NAME)`` in a xacro file.
        xacro_args: name to text, for ``$(arg NAME)`` in a xacro file.
        square: check that the task has as many dimensions as there are joints.

    Raises:
        InvalidRobotError: no such robot, or it cannot be read, or (``square``) its
            joints do not fit its task.
    """
    robot = read_robot(
        _find(name_or_path),
        base=base,
        tip=tip,
        task=task,
        convention=convention,
        angle_unit=angle_unit,
        length_unit=length_unit,
        packages=packages,
        xacro_args=xacro_args,
    )
    if lock:
        robot = _locked(robot, lock, task)
    if square:
        check_task(robot.chain, robot.file)
    return robot


def _locked(
    robot: Robot, lock: Mapping[str, str | Angle | Fraction], task: str | None
) -> Robot:
    """The robot with joints held; without ``task`` its task is by their number."""
    other = robot.other_convention
    chain = _held(robot.chain, lock, task)
    if other is not None:
        other = replace(other, chain=_held(other.chain, lock, task))
    locked = {name: _written(value) for name, value in lock.items()}
    notes = tuple(f"{name} is locked at {value}" for name, value in locked.items())
    return replace(
        robot,
        chain=chain,
        notes=robot.notes + notes,
        locked=locked,
        expect=None,
        other_convention=other,
        beside=tuple(_held(beside, lock, task) for beside in robot.beside),
    )


def _held(
    chain: Chain, lock: Mapping[str, str | Angle | Fraction], task: str | None
) -> Chain:
    held = lock_joints(chain, lock)
    return replace(held, task=default_task(len(held.joints))) if task is None else held


def _written(value: str | Angle | Fraction) -> str:
    if isinstance(value, str):
        return value
    return format_angle(value) if isinstance(value, Angle) else format_rational(value)


def serial_chains(
    name_or_path: str | Path,
    base: str | None = None,
    packages: Mapping[str, str] | None = None,
    xacro_args: Mapping[str, str] | None = None,
) -> list[Candidate]:
    """The serial chains of a robot, likely ones first; see `read_robot.chains_in`.

    Raises:
        InvalidRobotError: no such robot, or it cannot be read.
    """
    return chains_in(_find(name_or_path), base, packages, xacro_args)


def uses(name_or_path: str | Path, option: str) -> bool:
    """Whether the robot's file is of a format that uses the option.

    Args:
        name_or_path: as in `open_robot`.
        option: one of its arguments, such as ``angle_unit``.

    Raises:
        InvalidRobotError: no such robot.
    """
    return takes(_find(name_or_path), option)


def library() -> list[tuple[str, Path]]:
    """The names that `open_robot` knows, with their files; ours first, then by name."""
    found: dict[str, Path] = {}
    for path in [*_own_robots(), *_example_urdfs()]:
        found.setdefault(path.stem, path)
    return list(found.items())


@dataclass(frozen=True)
class Described:
    """A name of the library, with what it is.

    Attributes:
        name: as `open_robot` takes it.
        is_arm: whether it is one chain with a task, without further options.
        what: joints, task and title; or what is to be chosen first, which
            ``cuspaudit import`` tells in full.
    """

    name: str
    is_arm: bool
    what: str


def described() -> Iterator[Described]:
    """Each name of `library`, with what it is."""
    for name, path in library():
        try:
            robot = open_robot(path)
        except InvalidRobotError as error:
            yield Described(name, False, error.found)
        else:
            joints = f"{len(robot.chain.joints)} joints, {robot.chain.task}"
            title = robot.title or f"URDF of example-robot-data, {path.name}"
            yield Described(name, True, f"{joints:30} {title}")


def example_robot_data() -> Path | None:
    """The share folder of example-robot-data (its ``robots`` inside), if installed."""
    places = [Path(sys.prefix)]
    for module in ("pinocchio", "cmeel"):
        spec = importlib.util.find_spec(module)
        if spec is not None and spec.origin is not None:
            places.extend(Path(spec.origin).parents)
    for place in places:
        for prefix in (place, place / "cmeel.prefix"):
            share = prefix / "share" / "example-robot-data"
            if (share / "robots").is_dir():
                return share
    return None


def _find(name_or_path: str | Path) -> Path:
    """The file that is meant: one there is, or that of a robot's name."""
    path = Path(name_or_path)
    text = str(name_or_path)
    if path.exists() or path.suffix.lower() in endings() or path.name != text:
        return path
    known = dict(library())
    named = [text] if text in known else _alike(text, known)
    if named:
        return known[named[0]]
    described = ssik_arms().get(text) or description_file(text)
    if described is not None:
        return described
    names = [*known, *ssik_arms(), *description_names()]
    near = difflib.get_close_matches(text.lower(), names, n=5, cutoff=0.5)
    raise InvalidRobotError(
        file=quoted(text),
        found="no file and no robot of this name",
        expected=f"did you mean {listing(near)}?" if near else "give a file",
    )


def _alike(text: str, names: Iterable[str]) -> list[str]:
    """The names that differ from ``text`` by capitals, spaces and dashes only."""

    def plain(name: str) -> str:
        return re.sub(r"[\s_-]", "", name).casefold()

    return [name for name in names if plain(name) == plain(text)]


def _own_robots() -> Iterator[Path]:
    package = Path(cuspaudit.__file__).parent
    for folder in (package / "robots", package.parent / "robots"):
        if folder.is_dir():
            yield from sorted(folder.glob("*.yaml"))
            yield from sorted((folder / _SPARE).glob("*.yaml"))
            return


def _example_urdfs() -> Iterator[Path]:
    share = example_robot_data()
    if share is not None:
        yield from sorted(
            (share / "robots").rglob("*.urdf"), key=lambda path: (path.stem, path)
        )
