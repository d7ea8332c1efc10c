"""`cuspaudit check`: robot files held to the verdicts recorded in them."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Annotated

import typer

from cuspaudit.cli.exit_codes import UNFORESEEN
from cuspaudit.cli.opening import package_folders, xacro_arguments
from cuspaudit.cli.options import PackageFolder, XacroArguments

__all__ = ["check"]


def check(
    paths: Annotated[
        list[Path], typer.Argument(metavar="DIR|FILE...", help="Robot files.")
    ],
    package: PackageFolder = None,
    xacro_arg: XacroArguments = None,
    junit_file: Annotated[
        Path | None, typer.Option("--junit", help="Write the results as JUnit XML.")
    ] = None,
    workers: Annotated[int, typer.Option("-j", min=1, help="Processes.")] = 1,
    strict: Annotated[
        bool, typer.Option("--strict", help="Count undecided as a mismatch.")
    ] = False,
    annotations: Annotated[
        bool,
        typer.Option(
            "--annotations",
            envvar="GITHUB_ACTIONS",
            help="Print GitHub annotations beside the lines they are about.",
        ),
    ] = False,
    update: Annotated[
        bool,
        typer.Option(
            "--update", help="Write what was found into files that expect nothing."
        ),
    ] = False,
) -> None:
    """Hold every robot file to the verdict and counts recorded in it."""
    from cuspaudit.auditing.check import check_robots, junit, robot_files
    from cuspaudit.auditing.expectation import annotation, write_expectation
    from cuspaudit.runtime.writing import check_writable, write_text

    if junit_file:
        check_writable(junit_file)
    results = []
    given = package_folders(package), xacro_arguments(xacro_arg)
    for result in check_robots(robot_files(paths), workers, *given):
        results.append(result)
        typer.echo(f"{result.status:14} {result.file}: {result.detail}")
        if annotations and (
            line := annotation(result.file, result.status, result.detail)
        ):
            typer.echo(line)
    if update:
        for result in results:
            if result.status == "no expectation" and (
                result.found.get("verdict") != "undecided"
                and write_expectation(Path(result.file), result.found)
            ):
                typer.echo(f"expectation written: {result.file}")
    bad = {
        r.status
        for r in results
        if r.is_failure or (strict and r.status == "undecided")
    }
    counts = Counter(result.status for result in results)
    typer.echo(", ".join(f"{n} {status}" for status, n in sorted(counts.items())))
    if junit_file:
        write_text(junit_file, junit(results))
    raise typer.Exit(UNFORESEEN if bad == {"fault"} else 1 if bad else 0)
