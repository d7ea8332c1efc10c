"""`cuspaudit audit --free`: the verdict at every value of a joint to spare."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from cuspaudit.cli.exit_codes import OF_VERDICT
from cuspaudit.cli.outlet import write_json
from cuspaudit.cli.running import progress_bar
from cuspaudit.errors import InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.auditing.options import Options
    from cuspaudit.robot.robot import Robot

__all__ = ["audit_every_lock", "audit_free", "refuse_beside_free"]

_STEPS = ("structures", "witnesses")
_SHOWN = 40


def audit_free(
    robot: Robot,
    joint: str,
    json_file: str | None,
    html: Path | None,
    snap: str,
    seed: int,
    timeout: float | None,
    within: bool,
    exit_zero: bool,
) -> None:
    """Cover the values of the joint, print and write what was found, and exit."""
    from dataclasses import replace

    from cuspaudit.auditing.free_joint.free_joint import free_joint
    from cuspaudit.auditing.free_joint.record import free_record
    from cuspaudit.runtime.waiting import waited
    from cuspaudit.runtime.writing import write_text

    options = _options(snap, seed, timeout)
    with progress_bar(_STEPS) as step:
        found = free_joint(robot, joint, replace(options, progress=step), within)
    record = free_record(robot, found)
    record["seconds"]["total"] = round(waited(), 4)
    if html:
        from cuspaudit.pictures.lock_ring import lock_page

        write_text(html, lock_page(record, found))
    if write_json(json_file, record):
        _print_free(record, {"page": html, "JSON": json_file})
    raise typer.Exit(0 if exit_zero else OF_VERDICT[record["verdict"]])


def audit_every_lock(
    robot: Robot,
    json_file: str | None,
    snap: str,
    seed: int,
    timeout: float | None,
    exit_zero: bool,
) -> None:
    """Try each joint as the locked one, a line each, and exit."""
    from dataclasses import replace

    from cuspaudit.auditing.free_joint.record import survey_record
    from cuspaudit.auditing.free_joint.survey import survey

    options = _options(snap, seed, timeout)
    with progress_bar(("locks",)) as step:
        choices = list(survey(robot, replace(options, progress=step)))
    record = survey_record(robot, choices, seed)
    if write_json(json_file, record):
        _print_survey(record, json_file)
    raise typer.Exit(0 if exit_zero else OF_VERDICT[record["verdict"]])


def refuse_beside_free(options: Mapping[str, object]) -> None:
    """Check that none of these options stands beside --free.

    Raises:
        InvalidInputError: one does.
    """
    for name, value in options.items():
        if value:
            expected = f"leave out {name}"
            if name == "--certificate":
                expected = "give --json FILE: it has the certificate of each interval"
            raise InvalidInputError(
                file="audit --free", found=f"{name} beside --free", expected=expected
            )


def _options(snap: str, seed: int, timeout: float | None) -> Options:
    from cuspaudit.auditing.options import Options
    from cuspaudit.robot.snap_policy import policy_from_name

    return Options(seed, timeout, snap=policy_from_name(snap))


def _print_free(record: Mapping[str, Any], files: Mapping[str, Any]) -> None:
    """The shares, then the stretches in order."""
    robot = record["robot"]
    rows = [
        ("robot", f"{robot['name']}: {len(robot['joints'])} joints, {robot['task']}"),
        ("locked", f"{record['joint']}, at every value"),
        ("verdict", record["verdict"]),
        ("why", record["why"]),
    ]
    if record["stopped"]:
        rows.append(("stopped", record["stopped"]))
    rows += [(name, str(file)) for name, file in files.items() if file]
    rows.append(("time", f"{record['seconds']['total']:.2f} s"))
    for name, text in rows:
        typer.echo(f"{name:9} {text}")
    stretches = record["stretches"]
    for each in stretches[:_SHOWN]:
        low, high = (f"{math.degrees(each[end]):.6g}" for end in ("lower", "upper"))
        word = "open" if each["verdict"] == "undecided" else each["verdict"]
        typer.echo(f"  {low:>9} to {high:>9} deg  {word:12} {each['why']}")
    if len(stretches) > _SHOWN:
        typer.echo(f"  ... {len(stretches) - _SHOWN} more; --json has them all")


def _print_survey(record: Mapping[str, Any], json_file: str | None) -> None:
    robot = record["robot"]
    joints = robot["joints"]
    typer.echo(
        f"{robot['name']}: {len(joints)} joints for the task {robot['task']}; what is "
        "left when one of them is locked:"
    )
    width = max(len(lock["joint"]) for lock in record["locks"])
    for lock in record["locks"]:
        every = "at every value but single ones" if lock["value"] is None else ""
        why = f"{every}: {lock['why']}" if every else lock["why"]
        typer.echo(f"  {lock['joint']:{width}}  {lock['verdict']:11}  {why}")
    typer.echo("--free JOINT covers all values of one, --lock JOINT=VALUE takes one")
    if json_file:
        typer.echo(f"JSON      {json_file}")
