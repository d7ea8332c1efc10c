"""One door for every robot file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from cuspaudit.robot.formats.format import Choices, Format
from cuspaudit.robot.formats.registry import endings, format_of
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.robot import Robot

if TYPE_CHECKING:
    from cuspaudit.robot.formats.choice import Candidate

__all__ = ["chains_in", "read_robot", "takes"]

_OPTIONS = {
    "base": "--base",
    "tip": "--tip",
    "convention": "--convention",
    "angle_unit": "--angle-unit",
    "length_unit": "--length-unit",
    "packages": "--package",
    "xacro_args": "--xacro-arg",
}


def chains_in(
    path: Path | str,
    base: str | None = None,
    packages: Mapping[str, str] | None = None,
    xacro_args: Mapping[str, str] | None = None,
) -> list[Candidate]:
    """The serial chains of a file, likely ones first; a table has none to choose from.

    Raises:
        InvalidRobotError: the file cannot be read, or several links may be its base,
            or an option does not belong to this kind of file.
    """
    path = Path(path)
    known = format_of(path)
    if known is None or known.chains is None:
        return []
    choices = Choices(base, packages=packages, xacro_args=xacro_args)
    _check_taken(path, known, choices)
    return known.chains(path, choices)


def takes(path: Path, option: str) -> bool:
    """Whether the format of a file uses the option, named as in `Choices`."""
    known = format_of(path)
    return known is not None and option in known.takes


def read_robot(
    path: Path | str,
    *,
    base: str | None = None,
    tip: str | None = None,
    task: str | None = None,
    convention: str | None = None,
    angle_unit: str | None = None,
    length_unit: str | None = None,
    packages: Mapping[str, str] | None = None,
    xacro_args: Mapping[str, str] | None = None,
) -> Robot:
    """The robot in a file, read in the format that the ending of its name says.

    Args:
        path: the file; `formats.registry` lists the formats.
        base: a link; by default the root.
        tip: a link; by default the only end there is.
        task: a name in `robot.task.DIMENSIONS`; by default the one for so many
            joints.
        convention: "standard" or "modified", for a table that does not say.
        angle_unit: "rad" or "deg", for a table that does not say.
        length_unit: "m" or "mm", for a table that does not say.
        packages: name to folder, for ``$(find NAME)`` in a xacro file.
        xacro_args: name to text, for ``$(arg NAME)`` in a xacro file.

    Raises:
        InvalidRobotError: the file cannot be read as it stands, or an option does
            not belong to this kind of file.
    """
    path = Path(path)
    if path.is_dir():
        expected = f"name a file in it, or type: cuspaudit check {path}"
        raise Place(str(path)).error("this is a folder", expected)
    known = format_of(path)
    if known is None:
        found = f"files ending in {quoted(path.suffix)} are unknown"
        raise Place(str(path)).error(found, f"give a file in {', '.join(endings())}")
    choices = Choices(
        base, tip, task, convention, angle_unit, length_unit, packages, xacro_args
    )
    _check_taken(path, known, choices)
    return known.read(path, choices)


def _check_taken(path: Path, known: Format, choices: Choices) -> None:
    """Check that the format uses each choice that is given.

    Raises:
        InvalidRobotError: it does not, so that nothing given is passed over in silence.
    """
    other = [name for name in choices.given() if name not in (*known.takes, "task")]
    if other:
        options = " and ".join(_OPTIONS[name] for name in other)
        found = f"{options} given for a {known.name}, which has no use for it"
        raise Place(str(path)).error(found, f"leave out {options}")
