"""The options that say how the file of a robot is to be read, of every such command."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, fields
from functools import wraps
from inspect import Parameter
from typing import Any

from cuspaudit.cli import options

__all__ = ["RobotOptions", "with_robot_options"]

_TYPES = {
    "base": options.Base,
    "tip": options.Tip,
    "task": options.TaskName,
    "lock": options.Lock,
    "convention": options.Convention,
    "angle_unit": options.AngleUnit,
    "length_unit": options.LengthUnit,
    "package": options.PackageFolder,
    "xacro_arg": options.XacroArguments,
}


@dataclass(frozen=True)
class RobotOptions:
    """How the file of a robot is to be read.

    Attributes:
        base: base link of a tree.
        tip: tip link of a tree.
        task: a name in `robot.task.DIMENSIONS`.
        lock: entries JOINT=VALUE.
        convention: D-H convention of a table that does not say.
        angle_unit: unit of bare angles in a D-H table.
        length_unit: unit of lengths in a D-H table.
        package: entries NAME=DIR, for a xacro file.
        xacro_arg: entries NAME=VALUE, for a xacro file.
    """

    base: str | None = None
    tip: str | None = None
    task: str | None = None
    lock: list[str] | None = None
    convention: str | None = None
    angle_unit: str | None = None
    length_unit: str | None = None
    package: list[str] | None = None
    xacro_arg: list[str] | None = None

    def by_flag(self, *left_out: str) -> dict[str, object]:
        """What was given, by the option's name."""
        return {
            f"--{name.replace('_', '-')}": value
            for name, value in asdict(self).items()
            if name not in left_out
        }


def with_robot_options(command: Callable[..., None]) -> Callable[..., None]:
    """A command with these options in place of its parameter ``reading``.

    Args:
        command: takes ``reading: RobotOptions``; its signature names types that are
            loaded with its module.
    """
    names = [field.name for field in fields(RobotOptions)]

    @wraps(command)
    def run(**given: Any) -> None:
        command(reading=RobotOptions(**{n: given.pop(n) for n in names}), **given)

    signature = inspect.signature(command, eval_str=True)
    run.__signature__ = signature.replace(  # type: ignore[attr-defined]
        parameters=list(_expanded(signature)), return_annotation=None
    )
    run.__annotations__ = {}
    return run


def _expanded(signature: inspect.Signature) -> Iterator[Parameter]:
    for parameter in signature.parameters.values():
        if parameter.name == "reading":
            for name, kind in _TYPES.items():
                yield Parameter(
                    name, Parameter.KEYWORD_ONLY, default=None, annotation=kind
                )
        else:
            yield parameter.replace(kind=Parameter.KEYWORD_ONLY)
