"""`cuspaudit audit` and `cuspaudit plot` of a parallel mechanism."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from cuspaudit.cli.exit_codes import OF_VERDICT
from cuspaudit.cli.outlet import write_json
from cuspaudit.cli.running import progress_bar
from cuspaudit.errors import InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.auditing.systems.file import SystemFile

__all__ = ["audit_mechanism", "mechanism_named", "no_arm", "plot_mechanism"]

_SECONDS = 600.0


def mechanism_named(name: str) -> SystemFile | None:
    """The mechanism in a file, or None when the file is something else.

    Raises:
        InvalidInputError: it has legs and cannot be read as a mechanism.
    """
    path = Path(name)
    if path.suffix.lower() not in (".yaml", ".yml", ".json") or not path.is_file():
        return None
    from cuspaudit.auditing.systems.file import read_system
    from cuspaudit.parallel.reading import is_mechanism
    from cuspaudit.robot.place import Place
    from cuspaudit.robot.tables import read_mapping

    try:
        entries = read_mapping(path, Place(name))
    except InvalidInputError:
        return None  # the reader of robots says what is wrong
    return read_system(path) if is_mechanism(entries) else None


def no_arm(command: str, options: Mapping[str, object]) -> None:
    """Check that none of the options of a serial arm was given to ``command``.

    Raises:
        InvalidInputError: one was.
    """
    for name, value in options.items():
        if value:
            raise InvalidInputError(
                file=command,
                found=f"{name} with a parallel mechanism",
                expected=f"leave out {name}: it is for serial arms",
            )


def audit_mechanism(
    system: SystemFile,
    json_file: str | None,
    html: Path | None,
    seed: int,
    timeout: float | None,
    exit_zero: bool,
) -> None:
    """Decide a mechanism's problem, print and write what was found, and exit."""
    from cuspaudit.auditing.systems.report import decide_system
    from cuspaudit.cli.decide import STEPS, print_decision
    from cuspaudit.pictures.mechanism import page_of
    from cuspaudit.runtime.writing import write_text
    from cuspaudit.viz.mechanism_page import mechanism_page

    with progress_bar(STEPS) as step:
        record = decide_system(
            system, seed=max(seed, 1), timeout=timeout or _SECONDS, progress=step
        )
    if html:
        write_text(html, mechanism_page(page_of(system, record)))
    if write_json(json_file, record):
        print_decision(record, json_file)
    raise typer.Exit(0 if exit_zero else OF_VERDICT[record["verdict"]])


def plot_mechanism(system: SystemFile, output: Path) -> None:
    """Draw the critical values of a mechanism with two actuators."""
    from cuspaudit.pictures.mechanism import values_sheet
    from cuspaudit.viz.plot.files import save_plot

    save_plot(values_sheet(system), output)
    typer.echo(f"figure: {output}")
