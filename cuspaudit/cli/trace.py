"""`cuspaudit trace`: what becomes of every posture along a tool path."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.text import Text

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

__all__ = ["trace"]

STEPS = ("postures", "runs", "births", "limits")
_COLOUR = {
    "reached": "green",
    "singular": "red",
    "limit": "yellow",
    "undecided": "cyan",
}
_SHOWN = 64


@with_robot_options
def trace(
    robot: RobotName,
    path: Annotated[
        Path,
        typer.Argument(
            metavar="PATH",
            help="A CSV with the header x,y,z,qw,qx,qy,qz (or x,y,z, or the joints' "
            "names), or JSON: one waypoint a row.",
        ),
    ],
    reading: RobotOptions,
    closed: Annotated[
        bool, typer.Option("--closed", help="The path returns to its first waypoint.")
    ] = False,
    laps: Annotated[
        int, typer.Option(min=1, max=1000, help="Laps of a closed path to follow.")
    ] = 1,
    no_limits: Annotated[
        bool, typer.Option("--no-limits", help="Leave the joint limits out.")
    ] = False,
    json_file: JsonFile = None,
    html: Annotated[
        Path | None, typer.Option(help="Write an offline page with the animation.")
    ] = None,
    certificate: Annotated[
        Path | None,
        typer.Option(
            help="Write the certificate of a run of a closed path that changes posture."
        ),
    ] = None,
    snap: Snap = "default",
    seed: Seed = 0,
    timeout: PathTimeout = None,
) -> None:
    """Follow a tool path from every posture: which reach its end, where others die.

    Exit codes: 0 every start posture reaches the end, and a closed path repeats; 1 some
    do not, or the first pose has no posture; 3 undecided.
    """
    from cuspaudit.robot.library import uses
    from cuspaudit.robot.snap_policy import policy_from_name
    from cuspaudit.robot.snapping import snap as snapped
    from cuspaudit.runtime.writing import write_text
    from cuspaudit.toolpath.reading import angle_unit_named, closed_path, read_path
    from cuspaudit.toolpath.record import exit_code, trace_record
    from cuspaudit.toolpath.run_certificate import run_certificate
    from cuspaudit.toolpath.trace import trace_path
    from cuspaudit.toolpath.traced_arm import traced_arm

    check_outlets(json_file, html, certificate)
    table_unit = reading.angle_unit if uses(robot, "angle_unit") else None
    opened = open_named(robot, replace(reading, angle_unit=table_unit))
    arm = traced_arm(snapped(opened.chain, policy_from_name(snap))[0])
    tool_path = read_path(path, arm, angle_unit_named(reading.angle_unit))
    if closed:
        tool_path = closed_path(tool_path, arm)
    with progress_bar(STEPS) as step:
        found = trace_path(arm, tool_path, not no_limits, seed, step, timeout)
    record = trace_record(found, opened.name, opened.file, laps)
    if certificate:
        write_text(certificate, run_certificate(found))
    if html:
        from cuspaudit.pictures.tool_path import trace_drawing
        from cuspaudit.viz.tool_path import render_trace

        write_text(html, render_trace(record, trace_drawing(found)))
    if write_json(json_file, record):
        _print(record)
    raise typer.Exit(exit_code(found))


def _print(record: dict[str, Any]) -> None:
    console = Console(highlight=False, soft_wrap=True)
    robot, path = record["robot"], record["path"]
    console.print(
        f"{robot['name']}: {path['waypoints']} waypoints, {len(record['runs'])} starts"
    )
    for number, run in enumerate(record["runs"][:_SHOWN]):
        console.print(_row(record, number, run))
    if len(record["runs"]) > _SHOWN:
        console.print(f"... and {len(record['runs']) - _SHOWN} more, with --json")
    for line in _sentences(record):
        console.print(line)


def _row(record: dict[str, Any], number: int, run: dict[str, Any]) -> Text:
    sign = {1: "+", -1: "-", 0: "0", None: "?"}[run["sign"]]
    words = {
        "reached": "reaches the end",
        "singular": f"singular at {run['at']:.6f}",
        "limit": f"limit of {run['joint']} at {run['at']:.6f}",
        "undecided": f"undecided near s = {run['at']:.6f}",
    }[run["end"]]
    if record["permutation"] is not None and record["permutation"][number] is not None:
        words += f" in run {record['permutation'][number]}"
        turns = record["turns"][number]
        if any(turns):
            words += " and turns " + ", ".join(f"{turn:+d}" for turn in turns)
    if not run["inside"]:
        words = f"outside the limits ({words} without them)"
    margin = run["margin"]["singular"]
    room = (
        f"{margin * 57.29578:.1f} deg from singular" if run["end"] == "reached" else ""
    )
    shown = ", ".join(f"{value:.4f}" for value in run["start"])
    parts = [
        Text(f"{number}  {sign}  [{shown}]  "),
        Text(words, style=_COLOUR[run["end"]]),
        Text(f"  {room}" if room else "", style="dim"),
    ]
    return Text.assemble(*parts)


def _sentences(record: dict[str, Any]) -> list[str]:
    lines = []
    if record["born"]:
        at = ", ".join(f"{birth['at']:.6f}" for birth in record["born"][:8])
        lines.append(f"born on the way: {len(record['born'])}, at {at}")
    missed = record["unreachable"]
    if missed is not None:
        unit = record["robot"]["unit"]
        far = (
            f"{missed['distance']:.4g} {unit} out of reach"
            if missed["turn"] is None
            else f"its orientation is missed by {missed['turn'] * 57.29578:.3g} deg"
        )
        lines.append(f"waypoint {missed['waypoint'] + 1} has no posture: {far}")
    kinds = [one["kind"] for one in record["laps"]]
    if "changes posture" in kinds or "repeatable after laps" in kinds:
        lines.append("a run ends in another posture: the arm is cuspidal")
    motion = record["recorded"]
    if motion is not None and motion["run"] is None:
        lines.append("the recorded motion begins in no run: is its start singular?")
    if motion is not None and motion["run"] is not None:
        text = f"the recorded motion is run {motion['run']}"
        if motion["leaves_after"] is not None:
            last = motion["leaves_after"] + 1
            text += f" up to waypoint {last}; then it jumps, or passes a singularity"
        lines.append(text)
    if record["recommended"] is not None:
        lines.append(f"start in run {record['recommended']}: it has the most room")
    return lines + [f"note: {remark}" for remark in record["remarks"]]
