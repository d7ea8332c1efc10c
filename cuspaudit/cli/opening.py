"""From the arguments of a command to the robot they name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cuspaudit.errors import InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.cli.robot_options import RobotOptions
    from cuspaudit.robot.robot import Robot

__all__ = ["open_named", "package_folders", "xacro_arguments"]


def open_named(name: str, reading: RobotOptions, *, square: bool = True) -> Robot:
    """The robot a user named.

    Args:
        name: a file, or a name of the library.
        reading: how its file is to be read.
        square: whether the task must fit the joints that are left.

    Raises:
        InvalidInputError: no such robot, or one that cannot be read so.
    """
    from cuspaudit.robot.library import open_robot

    return open_robot(
        name,
        base=reading.base,
        tip=reading.tip,
        task=reading.task,
        lock=_pairs(reading.lock, "--lock", "JOINT=VALUE", "joint_3=pi/4"),
        convention=reading.convention,
        angle_unit=reading.angle_unit,
        length_unit=reading.length_unit,
        packages=package_folders(reading.package),
        xacro_args=xacro_arguments(reading.xacro_arg),
        square=square,
    )


def package_folders(entries: list[str] | None) -> dict[str, str]:
    """Name to folder of entries NAME=DIR.

    Raises:
        InvalidInputError: an entry is none.
    """
    return _pairs(entries, "--package", "NAME=DIR", "my_description=./my_description")


def xacro_arguments(entries: list[str] | None) -> dict[str, str]:
    """Name to text of entries NAME=VALUE; the text may be empty.

    Raises:
        InvalidInputError: an entry is none.
    """
    return _pairs(entries, "--xacro-arg", "NAME=VALUE", "ur_type=ur5e", empty=True)


def _pairs(
    entries: list[str] | None,
    option: str,
    form: str,
    example: str,
    *,
    empty: bool = False,
) -> dict[str, str]:
    """Both sides of each entry.

    Args:
        entries: as the option gives them.
        option: its name.
        form: of an entry.
        example: of one.
        empty: whether the right side may be empty.

    Raises:
        InvalidInputError: an entry has another form, or two have one left side.
    """
    found: dict[str, str] = {}
    for entry in entries or []:
        name, equals, value = entry.partition("=")
        if not (name and equals and (value or empty)):
            raise InvalidInputError(
                file=f"{option} {entry}",
                found=f"not {form}",
                expected=f"write for example {example}",
            )
        if name in found:
            raise InvalidInputError(
                file=f"{option} {entry}",
                found=f"{name} is given twice",
                expected="give it once",
            )
        found[name] = value
    return found
