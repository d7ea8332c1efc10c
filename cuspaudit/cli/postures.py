"""`cuspaudit postures`: all postures of one pose."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import ROUND_DOWN, Decimal
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from cuspaudit.cli.opening import open_named
from cuspaudit.cli.options import (
    PathTimeout,
    RobotName,
    Seed,
    Snap,
)
from cuspaudit.cli.outlet import JsonFile, check_outlets, write_json
from cuspaudit.cli.robot_options import RobotOptions, with_robot_options
from cuspaudit.cli.running import progress_bar

__all__ = ["postures"]

STEPS = ("postures", "aspects", "distances")


@with_robot_options
def postures(
    *,
    robot: RobotName,
    joints: Annotated[
        str | None,
        typer.Option(
            metavar="Q1,Q2,...", help="The pose of a joint vector; rad, or deg."
        ),
    ] = None,
    position: Annotated[
        str | None, typer.Option(metavar="X,Y,Z", help="The place of the tip.")
    ] = None,
    quaternion: Annotated[
        str | None, typer.Option(metavar="W,X,Y,Z", help="Its orientation.")
    ] = None,
    rpy: Annotated[
        str | None,
        typer.Option(metavar="R,P,Y", help="Its orientation, about fixed x, y, z."),
    ] = None,
    reading: RobotOptions,
    json_file: JsonFile = None,
    html: Annotated[
        Path | None, typer.Option(help="Write an offline page of them side by side.")
    ] = None,
    snap: Snap = "default",
    seed: Seed = 0,
    timeout: PathTimeout = None,
) -> None:
    """List all postures of one pose: det J, sign, aspect, inside limits.

    Exit codes: 0 the list is complete, proved (empty too); 3 it may not be.
    """
    from cuspaudit.robot.snap_policy import policy_from_name
    from cuspaudit.robot.snapping import snap as snapped
    from cuspaudit.runtime.writing import write_text
    from cuspaudit.toolpath.asked import asked_pose, joint_vector
    from cuspaudit.toolpath.postures import held_to, list_postures, postures_record
    from cuspaudit.toolpath.traced_arm import traced_arm

    check_outlets(json_file, html)
    opened = open_named(robot, reading)
    arm = traced_arm(snapped(opened.chain, policy_from_name(snap))[0])
    pose = asked_pose(arm, joints, position, quaternion, rpy)
    with progress_bar(STEPS) as step:
        found = list_postures(arm, pose, seed, step, timeout)
    if joints is not None:
        found = held_to(found, joint_vector(joints, arm.robot_chain, "--joints"))
    record = postures_record(found, opened.name, opened.file)
    if html:
        from cuspaudit.pictures.tool_path import postures_drawing
        from cuspaudit.viz.tool_path import render_postures

        write_text(html, render_postures(record, postures_drawing(found)))
    if write_json(json_file, record):
        _print(record)
    raise typer.Exit(0 if found.complete else 3)


def _print(record: dict[str, Any]) -> None:
    console = Console(highlight=False, soft_wrap=True)
    count = len(record["postures"])
    known = "complete, proved" if record["complete"] else "may not be all"
    console.print(f"{record['robot']['name']}: {count} postures ({known})")
    for number, posture in enumerate(record["postures"]):
        sign = {1: "+", -1: "-", 0: "0", None: "?"}[posture["sign"]]
        near, least = posture["nearest_singular"], posture["nonsingular_within"]
        parts = [
            f"{number}",
            ", ".join(f"{value:.4f}" for value in posture["values"]),
            f"det J {posture['determinant']:.4g} ({sign})",
            "" if posture["aspect"] is None else f"aspect {posture['aspect']}",
            "" if posture["inside"] else "outside the limits",
            _isolated(posture) if record["whole_curves"] else "",
            "" if near is None else f"{near * 57.29578:.1f} deg from singular",
            "" if least is None else f"(proved: {_rounded_down(least)} deg at least)",
        ]
        console.print("  ".join(part for part in parts if part), markup=False)
    if record["whole_curves"]:
        console.print(
            "infinitely many postures: whole curves of them may have this pose"
        )
    if record["why"]:
        console.print(f"note: {record['why']}")


def _isolated(posture: Mapping[str, Any]) -> str:
    """Whether a posture is alone, at a pose that whole curves of them may have."""
    return "isolated" if posture["proved"] else "perhaps on a whole curve"


def _rounded_down(angle: float) -> str:
    """An angle in degrees, rounded down to three digits."""
    return str(Decimal(angle * 57.29577).quantize(Decimal("0.001"), ROUND_DOWN))
