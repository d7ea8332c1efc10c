"""Where a command's JSON goes: a file, standard output, or nowhere."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any

import typer

__all__ = ["JsonFile", "check_outlets", "write_json"]

JsonFile = Annotated[
    str | None,
    typer.Option("--json", metavar="FILE", help="Write the result; - is stdout."),
]


def check_outlets(json_file: str | None, *files: Path | None) -> None:
    """Check that every file can be written, before long work.

    Raises:
        InvalidInputError: one cannot.
    """
    from cuspaudit.runtime.writing import check_writable

    named = [] if json_file in (None, "-") else [Path(json_file)]
    for file in (*files, *named):
        if file is not None:
            check_writable(file)


def write_json(json_file: str | None, found: Any) -> bool:
    """Write ``found`` where it is asked for; whether standard output is free for words.

    Raises:
        InvalidInputError: the file cannot be written.
    """
    from cuspaudit.runtime.writing import write_text

    text = json.dumps(found, indent=1, allow_nan=False)
    if json_file == "-":
        typer.echo(text)
    elif json_file:
        write_text(Path(json_file), text)
    return json_file != "-"
