"""The arguments that several commands share."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

__all__ = [
    "AngleUnit",
    "Base",
    "Convention",
    "Engine",
    "EngineName",
    "LengthUnit",
    "Lock",
    "PackageFolder",
    "PathTimeout",
    "RobotEngine",
    "RobotEngineName",
    "RobotName",
    "Seed",
    "Snap",
    "TaskName",
    "Timeout",
    "Tip",
    "XacroArguments",
]


class Engine(StrEnum):
    """How connectivity is decided."""

    auto = "auto"
    roadmap = "roadmap"
    routing = "routing"


class RobotEngine(StrEnum):
    """How a robot is decided."""

    auto = "auto"
    roadmap = "roadmap"
    routing = "routing"
    pairs = "pairs"


RobotName = Annotated[
    str,
    typer.Argument(
        metavar="ROBOT",
        help="A robot file (URDF, xacro, MJCF, SDF, a D-H table), or a name from "
        "`import --list`.",
    ),
]
Base = Annotated[str | None, typer.Option(help="Base link of a URDF.")]
Tip = Annotated[str | None, typer.Option(help="Tip link of a URDF.")]
TaskName = Annotated[
    str | None,
    typer.Option(
        "--task",
        metavar="TASK",
        help="position (3 joints), position-and-angle (4: a SCARA, or yaw and three "
        "pitches), position-and-z-axis (5: the tip's z axis is the tool's; x and y "
        "likewise) or pose (6).",
    ),
]
Lock = Annotated[
    list[str] | None,
    typer.Option(
        metavar="JOINT=VALUE", help="Fix a joint, e.g. joint_3=pi/4; may be repeated."
    ),
]
Convention = Annotated[
    str | None,
    typer.Option(
        help="D-H convention of a table that does not say: standard, modified."
    ),
]
AngleUnit = Annotated[
    str | None, typer.Option(help="Unit of bare angles in a D-H table: rad, deg.")
]
LengthUnit = Annotated[
    str | None, typer.Option(help="Unit of lengths in a D-H table: m, mm.")
]
PackageFolder = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NAME=DIR",
        help="Folder of a package that a xacro file finds by name; may be repeated.",
    ),
]
XacroArguments = Annotated[
    list[str] | None,
    typer.Option(
        "--xacro-arg",
        metavar="NAME=VALUE",
        help="Argument that a xacro file asks for; may be repeated.",
    ),
]
Snap = Annotated[
    str,
    typer.Option(
        metavar="none|default|FILE",
        help="Which rounded numbers are made exact; FILE is YAML with any of angle, "
        "length, axis, printed.",
    ),
]
EngineName = Annotated[Engine, typer.Option(help="Route of the decision.")]
RobotEngineName = Annotated[
    RobotEngine,
    typer.Option(
        help="Route of the decision; pairs looks at pairs of postures of one pose, "
        "which decides three joints, and six when it meets a witness."
    ),
]
Seed = Annotated[int, typer.Option(help="Seed of every random choice.")]
PathTimeout = Annotated[
    float | None,
    typer.Option(
        min=0.0,
        help="Seconds after which no further step is begun; what is not known by then "
        "is left open.",
    ),
]
Timeout = Annotated[
    float | None,
    typer.Option(
        min=0.0,
        help="Seconds after which no further step is begun; a third of what is left "
        "may go into counting the aspects of a general six-joint arm.",
    ),
]
