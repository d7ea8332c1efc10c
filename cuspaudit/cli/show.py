"""`cuspaudit show`: a robot, or a saved audit of one, as a page in a browser."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer

from cuspaudit.cli.opening import open_named
from cuspaudit.cli.options import (
    Seed,
    Snap,
)
from cuspaudit.cli.robot_options import RobotOptions, with_robot_options
from cuspaudit.cli.running import run_audit
from cuspaudit.errors import InvalidInputError

__all__ = ["show"]

#: schemas of an audit that names its robot alike
READABLE = ("cuspaudit/audit/1", "cuspaudit/audit/2")


@with_robot_options
def show(
    source: Annotated[
        str, typer.Argument(metavar="ROBOT|AUDIT.json", help="A robot or an audit.")
    ],
    reading: RobotOptions,
    html: Annotated[
        Path | None, typer.Option(help="Write one offline page instead of serving it.")
    ] = None,
    no_open: Annotated[
        bool, typer.Option("--no-open", help="Serve without opening a browser.")
    ] = False,
    port: Annotated[int, typer.Option(help="First port to try, on loopback.")] = 7000,
    snap: Snap = "default",
    seed: Seed = 0,
) -> None:
    """Show the witness path in a browser, or the postures of one pose."""
    from cuspaudit.pictures.page import page_text
    from cuspaudit.robot.formats.registry import format_of
    from cuspaudit.runtime.writing import check_writable, write_text
    from cuspaudit.viz import serve

    if html:
        check_writable(html)
    if source.endswith(".json") and (saved := _saved_audit(Path(source))) is not None:
        source, seed, snap = saved["file"], saved["seed"], saved["snap"]
        known = format_of(Path(source))
        is_tree = known is not None and known.chains is not None
        reading = replace(
            reading,
            base=saved["base"] if is_tree else None,
            tip=saved["tip"] if is_tree else None,
            task=saved["task"],
            lock=[f"{joint}={value}" for joint, value in saved["locked"].items()],
        )
    opened = open_named(source, reading)
    result = run_audit(opened, seed, None, snap)
    page = page_text(result.record(), result)
    if html:
        write_text(html, page)
        typer.echo(f"page: {html}")
    else:
        serve(page, port, open_browser=not no_open)


def _saved_audit(path: Path) -> dict[str, Any] | None:
    """What a saved audit says of its robot; None when the file is a D-H table."""
    try:
        record = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise InvalidInputError(
            file=str(path),
            found=f"cannot be read as JSON ({error})",
            expected="name an audit written with --json, or a robot",
        ) from error
    schema = record.get("schema") if isinstance(record, dict) else None
    if not isinstance(schema, str) or not schema.startswith("cuspaudit/"):
        return None
    if schema not in READABLE or record.get("robot") is None:
        raise InvalidInputError(
            file=str(path),
            found=f"{schema}, which names no robot to show",
            expected=f"name the audit of a robot ({' or '.join(READABLE)}), or a robot",
        )
    robot = record["robot"]
    return {
        "file": robot["file"],
        "base": robot["base"],
        "tip": robot["tip"],
        "task": robot["task"],
        "locked": robot.get("locked", {}),
        "seed": record["seed"],
        "snap": robot.get("snap_policy", {}).get("name", "default"),
    }
