"""`cuspaudit atlas`: a folder of robots as a static site."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["atlas"]


def atlas(
    sources: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="DIR|FILE|NAME...", help="Robots; of a folder all its robot files."
        ),
    ] = None,
    site: Annotated[
        Path, typer.Option("-o", metavar="SITE", help="The folder of the site.")
    ] = Path("atlas"),
    known: Annotated[
        bool,
        typer.Option(
            "--library",
            help="Add every robot known by name: ours, those of example-robot-data, "
            "the arms of ssik, and those of robot_descriptions that have been fetched.",
        ),
    ] = False,
    title: Annotated[str, typer.Option(help="Of the table.")] = "Atlas of robot arms",
    workers: Annotated[int, typer.Option("-j", min=1, help="Processes.")] = 1,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="A Dask scheduler, tcp://HOST:8786."),
    ] = None,
    timeout: Annotated[
        float, typer.Option(min=0.01, help="Seconds that an audit may take.")
    ] = 60.0,
    seed: Annotated[int, typer.Option(help="Of every random choice.")] = 0,
) -> None:
    """Audit many robots into a static site: a table, a page and a proof an arm.

    Run again, it audits only what has changed. Exit code 0 whatever the verdicts.
    """
    from cuspaudit.atlas.site import build_site
    from cuspaudit.atlas.sources import robot_sources
    from cuspaudit.cli.running import progress_bar

    found = robot_sources(sources or [], known)
    with progress_bar(("atlas",)) as step:
        built = build_site(
            found,
            site,
            title=title,
            workers=workers,
            scheduler=scheduler,
            timeout=timeout,
            seed=seed,
            report=lambda done, every, name: step(f"atlas: {done} of {every}, {name}"),
        )
    errors = sum(bool(entry.error) for entry in built.entries)
    proved = sum(bool(entry.certificate) for entry in built.entries)
    typer.echo(
        f"{site}/index.html: {len(built.entries)} robots, {built.made} audited now, "
        f"{proved} with a certificate, {errors} not audited"
    )
