"""`cuspaudit plot`: the figures of an arm that three joints decide, or of a sweep."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cuspaudit.cli.families import Audits, Colour, Fix, Plane, X, Y, plot_family
from cuspaudit.cli.mechanisms import mechanism_named, no_arm, plot_mechanism
from cuspaudit.cli.opening import open_named
from cuspaudit.cli.options import (
    RobotName,
    Snap,
)
from cuspaudit.cli.robot_options import RobotOptions, with_robot_options
from cuspaudit.cli.running import STEPS, progress_bar
from cuspaudit.errors import InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.robot.robot import Robot

__all__ = ["plot"]

At = Annotated[
    str | None,
    typer.Option(
        metavar="RHO,Z", help="The value whose postures are shown, e.g. 5/2,1/2."
    ),
]


@with_robot_options
def plot(
    robot: RobotName,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="A .png, .svg or .html file.")
    ],
    reading: RobotOptions,
    snap: Snap = "default",
    at: At = None,
    x: X = None,
    y: Y = None,
    colour: Colour = "verdict",
    fix: Fix = None,
    audits: Audits = None,
) -> None:
    """Draw an arm, or the phase diagram of a sweep's DIR.

    Of an arm that three joints decide: the critical values and the aspects. Of another
    with six: the merge tree of |det J| and planes through the witness. Of a sweep: two
    parameters, verdict or a count as colour;
    `cuspaudit plot DIR -o phases.html --fix d2=1`.
    """
    if Path(robot).is_dir():
        plane = Plane(x, y, colour, tuple(fix or ()))
        plot_family(Path(robot), output, plane, audits or [])
    elif (mechanism := mechanism_named(robot)) is not None:
        no_arm(
            "plot",
            reading.by_flag(),
        )
        plot_mechanism(mechanism, output)
    else:
        opened = open_named(robot, reading)
        _plot_robot(opened, output, snap, at)


def _plot_robot(robot: Robot, output: Path, snap: str, at: str | None) -> None:
    """Draw the planes of an arm that three joints decide, or another's landscape.

    Raises:
        InvalidInputError: a value or a file that cannot be used.
        UnableError: there is nothing to draw for this robot.
    """
    from cuspaudit.auditing.audit import Options
    from cuspaudit.pictures.landscape import picture_of
    from cuspaudit.robot.snap_policy import policy_from_name
    from cuspaudit.runtime.writing import check_writable
    from cuspaudit.viz.plot.data import Landscape
    from cuspaudit.viz.plot.files import save_plot
    from cuspaudit.viz.plot.six_joints import landscape_sheet

    check_writable(output)
    with progress_bar(STEPS) as step:
        options = Options(progress=step, snap=policy_from_name(snap))
        found = picture_of(robot, _value(at), options)
    save_plot(landscape_sheet(found) if isinstance(found, Landscape) else found, output)
    typer.echo(f"figure: {output}")


def _value(text: str | None) -> tuple[Fraction, Fraction] | None:
    from cuspaudit.robot.numbers import parse_length
    from cuspaudit.robot.place import Place

    if text is None:
        return None
    parts = text.split(",")
    if len(parts) != 2:
        raise InvalidInputError(
            file="--at", found=f"{text!r}", expected="write RHO,Z, for example 5/2,1/2"
        )
    rho, z = (parse_length(part.strip(), Place("--at")) for part in parts)
    return rho, z
