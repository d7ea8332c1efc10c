"""The commands on families: arguments in, exit code out."""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated
from urllib.parse import quote

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn
from rich.progress import TimeRemainingColumn as Remaining

from cuspaudit.cli.member_audits import audit_members, kept_audits
from cuspaudit.errors import InvalidInputError

__all__ = ["Audits", "Colour", "Fix", "Plane", "X", "Y", "plot_family", "sweep"]

X = Annotated[str | None, typer.Option("--x", help="DIR: the parameter to the right.")]
Y = Annotated[str | None, typer.Option("--y", help="DIR: the parameter upwards.")]
Colour = Annotated[str, typer.Option(help="DIR: verdict, cusps, nodes, aspects, ...")]
Fix = Annotated[
    list[str] | None,
    typer.Option(metavar="NAME=VALUE", help="DIR: hold a parameter; repeatable."),
]
Audits = Annotated[
    list[str] | None,
    typer.Option(
        "--audit",
        metavar="INDEX|all",
        help="DIR: audit this member, so that a click opens its page; repeatable.",
    ),
]


def sweep(
    family: Annotated[
        Path, typer.Argument(metavar="FAMILY.yaml", help="A family file.")
    ],
    folder: Annotated[
        Path, typer.Option("-o", metavar="DIR", help="The table; taken up if there.")
    ],
    workers: Annotated[int, typer.Option("-j", min=1, help="Processes.")] = 1,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="A Dask scheduler, tcp://HOST:8786."),
    ] = None,
    timeout: Annotated[
        float | None,
        typer.Option(min=0.01, help="Seconds a member may take; then it is an error."),
    ] = None,
) -> None:
    """Decide every member of a family, exactly; run again to go on after a stop."""
    from cuspaudit.family.sweep import sweep as run

    with _progress() as report:
        done = run(family, folder, workers, report, scheduler, timeout)
    typer.echo(
        f"{done.kept + done.added} members in {folder}/results.parquet: "
        f"{done.added} new, {done.errors} with an error"
    )


@dataclass(frozen=True)
class Plane:
    """What of a sweep is drawn, as the user wrote it."""

    x: str | None
    y: str | None
    colour: str
    fix: tuple[str, ...]

    @property
    def words(self) -> list[str]:
        """The options that say the same."""
        options = [("--x", self.x), ("--y", self.y), ("--colour", self.colour)]
        options += [("--fix", entry) for entry in self.fix]
        return [word for name, value in options if value for word in (name, value)]


def plot_family(
    folder: Path, output: Path, plane: Plane, audits: Sequence[str]
) -> None:
    """Draw the phase diagram of a sweep, and audit the members asked for.

    Raises:
        InvalidInputError: no sweep, an unknown name, or a file that cannot be written.
    """
    from cuspaudit.family.phases import phases_of
    from cuspaudit.runtime.writing import check_writable, write_text
    from cuspaudit.viz.plot.phase import draw_phases, phase_page

    ending = output.suffix.lower()
    if ending not in (".png", ".svg", ".html"):
        raise InvalidInputError(
            file=str(output),
            found="no format that can be drawn",
            expected="end the name in one of .png, .svg, .html",
        )
    if audits and ending != ".html":
        raise InvalidInputError(
            file=str(output),
            found="a picture, which opens no audit",
            expected="end the name in .html, or leave out --audit",
        )
    check_writable(output)
    fixed = dict(entry.partition("=")[::2] for entry in plane.fix)
    shown = phases_of(folder, plane.x, plane.y, plane.colour, fixed)
    drawn = (shown.rows, shown.x, shown.y, shown.colour)
    if ending == ".png":
        output.write_bytes(draw_phases(*drawn, "png", shown.title, shown.labels))
    else:
        title = "" if ending == ".html" else shown.title
        svg = draw_phases(*drawn, "svg", title, shown.labels)
        text = svg.decode()
        if ending == ".html":
            audit_members(folder, shown.files, audits)
            pages = _addresses(kept_audits(folder, shown.files), output)
            words = ["cuspaudit", "plot", str(folder), "-o", str(output), *plane.words]
            text = phase_page(svg, shown.title, shown.files, pages, shlex.join(words))
        write_text(output, text)
    typer.echo(f"figure: {output}, {len(shown.rows)} members")


def _addresses(pages: Mapping[int, Path], output: Path) -> dict[int, str]:
    """The pages as they are found from ``output``."""
    return {
        index: quote(os.path.relpath(page, output.parent))
        for index, page in pages.items()
    }


@contextmanager
def _progress() -> Iterator[Callable[[int, int], None]]:
    """A bar with rate and remaining time, on a terminal only."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda done, size: None
        return
    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("{task.fields[rate]}"))
    with Progress(*columns, Remaining(), console=console) as bar:
        task: TaskID | None = None

        def report(done: int, size: int) -> None:
            nonlocal task
            if task is None:
                task = bar.add_task("", total=size or None, completed=done, rate="")
            speed = bar.tasks[0].speed
            rate = f"{speed:.1f} members/s" if speed else ""
            bar.update(task, completed=done, rate=rate)

        yield report
