"""`cuspaudit same`: may one posture reach the other without a singularity?"""

from __future__ import annotations

from typing import Annotated

import typer

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

__all__ = ["same"]

STEPS = ("aspects", "paths")
EXIT = {"same": 0, "different": 1, "open": 3}


@with_robot_options
def same(
    *,
    robot: RobotName,
    first: Annotated[
        str,
        typer.Option("--from", metavar="Q1,Q2,...", help="A joint vector; rad, deg."),
    ],
    second: Annotated[
        str, typer.Option("--to", metavar="Q1,Q2,...", help="Another one.")
    ],
    within_limits: Annotated[
        bool, typer.Option("--within-limits", help="Keep within the joint limits.")
    ] = False,
    reading: RobotOptions,
    json_file: JsonFile = None,
    snap: Snap = "default",
    seed: Seed = 0,
    timeout: PathTimeout = None,
) -> None:
    """Tell whether two joint vectors lie in one aspect: joined without a singularity.

    Exit codes: 0 they do, proved; 1 they do not, proved; 3 open.
    """
    from cuspaudit.robot.snap_policy import policy_from_name
    from cuspaudit.robot.snapping import snap as snapped
    from cuspaudit.toolpath.asked import joint_vector
    from cuspaudit.toolpath.same_aspect import connection_record, same_aspect
    from cuspaudit.toolpath.traced_arm import traced_arm

    check_outlets(json_file)
    opened = open_named(robot, reading)
    arm = traced_arm(snapped(opened.chain, policy_from_name(snap))[0])
    ends = [
        joint_vector(text, opened.chain, option)
        for text, option in ((first, "--from"), (second, "--to"))
    ]
    with progress_bar(STEPS) as step:
        found = same_aspect(arm, ends[0], ends[1], within_limits, seed, step, timeout)
    record = connection_record(found, opened.name, opened.file)
    if write_json(json_file, record):
        typer.echo(f"{found.answer}: {found.why}")
        if found.path is not None:
            typer.echo(f"path of {len(found.path)} points, with --json")
    raise typer.Exit(EXIT[found.answer])
