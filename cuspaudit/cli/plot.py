"""`cuspaudit plot`: the figures of an arm that three joints decide."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Annotated

import typer

from cuspaudit.errors import InvalidInputError

__all__ = ["plot_robot"]

At = Annotated[
    str | None,
    typer.Option(
        metavar="RHO,Z", help="The value whose postures are shown, e.g. 5/2,1/2."
    ),
]


def plot_robot(
    robot: str,
    output: Path,
    *,
    base: str | None,
    tip: str | None,
    task: str | None,
    at: str | None,
) -> None:
    """Draw the curve of critical values and the joint plane of a robot.

    Raises:
        InvalidInputError: a value or a file that cannot be used.
        UnableError: no three-joint arm decides the robot.
    """
    from cuspaudit.audit.figures import figures_of
    from cuspaudit.audit.library import open_robot
    from cuspaudit.audit.writing import check_writable
    from cuspaudit.viz.plot_files import save_plot

    check_writable(output)
    shown = figures_of(open_robot(robot, base=base, tip=tip, task=task), at=_value(at))
    save_plot(shown, output)
    typer.echo(f"figure: {output}")


def _value(text: str | None) -> tuple[Fraction, Fraction] | None:
    from cuspaudit.kinematics.numbers import parse_length
    from cuspaudit.kinematics.place import Place

    if text is None:
        return None
    parts = text.split(",")
    if len(parts) != 2:
        raise InvalidInputError(
            file="--at", found=f"{text!r}", expected="write RHO,Z, for example 5/2,1/2"
        )
    rho, z = (parse_length(part.strip(), Place("--at")) for part in parts)
    return rho, z
