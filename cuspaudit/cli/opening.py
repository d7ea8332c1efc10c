"""From the arguments of a command to the robot they name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cuspaudit.errors import InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.robot.robot import Robot

__all__ = ["open_named"]


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
        square=square,
    )


def _joint_and_value(entry: str) -> tuple[str, str]:
    joint, equals, value = entry.partition("=")
    if not (joint and equals and value):
        raise InvalidInputError(
            file=f"--lock {entry}",
            found="not JOINT=VALUE",
            expected="write for example joint_3=pi/4",
        )
    return joint, value
