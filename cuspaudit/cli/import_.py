"""`cuspaudit import`: what was understood of a robot, or its model in another form."""

from __future__ import annotations

import json
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cuspaudit.cli.chains import print_chains
from cuspaudit.cli.opening import open_named, package_folders, xacro_arguments
from cuspaudit.cli.options import (
    Seed,
    Snap,
)
from cuspaudit.cli.robot_options import RobotOptions, with_robot_options
from cuspaudit.cli.summary import print_import
from cuspaudit.errors import InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.robot.robot import Robot
    from cuspaudit.robot.snap_policy import SnapPolicy

__all__ = ["import_"]


class Form(StrEnum):
    """What `import` can write."""

    dh = "dh"
    dh_modified = "dh-modified"
    poly = "poly"
    msolve = "msolve"


@with_robot_options
def import_(
    *,
    robot: Annotated[str | None, typer.Argument(metavar="ROBOT")] = None,
    reading: RobotOptions,
    to: Annotated[
        Form | None,
        typer.Option(
            help="dh, dh-modified: a robot file with the same forward kinematics, "
            "standard or modified D-H. poly: f, R and det J. msolve: inverse "
            "kinematics of a real pose."
        ),
    ] = None,
    snap: Snap = "default",
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON.")] = False,
    names: Annotated[
        bool, typer.Option("--list", help="List the robots known by name.")
    ] = False,
    seed: Seed = 0,
) -> None:
    """Show what was understood: chain, polynomial map, snapped numbers.

    Of a robot with several serial chains: a line for each, with its options.
    """
    if names:
        _print_names()
        return
    if robot is None:
        raise InvalidInputError(
            file="import",
            found="no robot named",
            expected="give ROBOT, or --list for the names known",
        )
    from cuspaudit.auditing.import_record import import_record
    from cuspaudit.robot.library import serial_chains
    from cuspaudit.robot.snap_policy import policy_from_name

    chains = []
    if not (reading.tip or to):
        given = package_folders(reading.package), xacro_arguments(reading.xacro_arg)
        chains = serial_chains(robot, reading.base, *given)
    if len(chains) > 1:
        records = [chain.record() for chain in chains]
        typer.echo(json.dumps(records, indent=1)) if as_json else print_chains(records)
        return
    square = to in (Form.poly, Form.msolve)
    opened = open_named(robot, reading, square=square)
    policy = policy_from_name(snap)
    if to:
        typer.echo(_written(opened, to, policy, seed), nl=False)
        return
    found = import_record(opened, policy)
    typer.echo(json.dumps(found, indent=1)) if as_json else print_import(found)


def _print_names() -> None:
    from cuspaudit.robot.descriptions import description_names
    from cuspaudit.robot.library import described
    from cuspaudit.robot.ssik_arms import ssik_arms

    for entry in sorted(described(), key=lambda entry: not entry.is_arm):
        typer.echo(f"{entry.name:28} {entry.what}")
    for name in ssik_arms():
        typer.echo(f"{name:28} ssik")
    for name in description_names():
        typer.echo(f"{name:28} robot_descriptions")


def _written(robot: Robot, form: Form, policy: SnapPolicy, seed: int) -> str:
    """The snapped model of ``robot`` in ``form``."""
    from cuspaudit.kinematics.exact_model import exact_model
    from cuspaudit.kinematics.export import msolve_system, poly_text
    from cuspaudit.robot.formats.dh.write import table_text
    from cuspaudit.robot.snapping import snap

    chain = snap(robot.chain, policy)[0]
    if form in (Form.dh, Form.dh_modified):
        numbers = "as in the file" if policy.name == "none" else "snapped"
        source = robot.source or f"{Path(robot.file).name}, numbers {numbers}"
        dh = form is Form.dh
        return table_text(chain, robot.title, source, "standard" if dh else "modified")
    if form is Form.poly:
        return poly_text(exact_model(chain))
    return msolve_system(exact_model(chain), seed)
