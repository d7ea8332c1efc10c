"""From the arguments of a command to the robot they name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cuspaudit.errors import InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.robot.robot import Robot

__all__ = ["open_named", "package_folders"]


def open_named(
    name: str,
    base: str | None,
    tip: str | None,
    task: str | None,
    lock: list[str] | None,
    convention: str | None,
    angle_unit: str | None,
    length_unit: str | None,
    *,
    packages: list[str] | None = None,
    square: bool = True,
) -> Robot:
    """The robot a user named.

    Args:
        name: a file, or a name of the library.
        base: base link of a URDF.
        tip: tip link of a URDF.
        task: a name in `robot.task.DIMENSIONS`.
        lock: entries JOINT=VALUE.
        convention: D-H convention of a table that does not say.
        angle_unit: unit of bare angles in a D-H table.
        length_unit: unit of lengths in a D-H table.
        packages: entries NAME=DIR, for a xacro file.
        square: whether the task must fit the joints that are left.

    Raises:
        InvalidInputError: no such robot, or one that cannot be read so.
    """
    from cuspaudit.robot.library import open_robot

    return open_robot(
        name,
        base=base,
        tip=tip,
        task=task,
        lock=dict(_joint_and_value(entry) for entry in lock or []),
        convention=convention,
        angle_unit=angle_unit,
        length_unit=length_unit,
        packages=package_folders(packages),
        square=square,
    )


def package_folders(entries: list[str] | None) -> dict[str, str]:
    """Name to folder of entries NAME=DIR.

    Raises:
        InvalidInputError: an entry is none.
    """
    found = {}
    for entry in entries or []:
        name, equals, folder = entry.partition("=")
        if not (name and equals and folder):
            raise InvalidInputError(
                file=f"--package {entry}",
                found="not NAME=DIR",
                expected="write for example my_description=./my_description",
            )
        found[name] = folder
    return found


def _joint_and_value(entry: str) -> tuple[str, str]:
    joint, equals, value = entry.partition("=")
    if not (joint and equals and value):
        raise InvalidInputError(
            file=f"--lock {entry}",
            found="not JOINT=VALUE",
            expected="write for example joint_3=pi/4",
        )
    return joint, value
