"""`cuspaudit verify`: a certificate re-proved, with nothing else at hand."""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer

from cuspaudit.cli.verify_free import SCHEMA, verify_free
from cuspaudit.errors import InvalidCertificateError

__all__ = ["verify"]

_MOST_BYTES = 20_000_000


def verify(
    certificate: Annotated[
        Path, typer.Argument(help="A certificate file, or the JSON of `audit --free`.")
    ],
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the result as JSON.")
    ] = False,
) -> None:
    """Re-prove a verdict from its certificate alone, in ball and exact arithmetic."""
    from cuspaudit.certificate import printable, read_certificate
    from cuspaudit.certificate import verify as prove

    try:
        claim = read_certificate(certificate)
    except InvalidCertificateError:
        record = _record(certificate)
        if record is not None and record.get("schema") == SCHEMA:
            verify_free(record, certificate, as_json)
        if record is not None:
            _check_kind(record, certificate)
        raise
    result = prove(claim)
    if as_json:
        typer.echo(json.dumps({"file": str(certificate), **asdict(result)}, indent=1))
    else:
        word = "accepted" if result.accepted else "REJECTED"
        typer.echo(f"{word}: {printable(claim.robot_name)}: {result.reason}")
    raise typer.Exit(0 if result.accepted else 1)


def _record(file: Path) -> dict[str, Any] | None:
    """The JSON object in a file, None where it has none."""
    with suppress(OSError, ValueError):
        if file.stat().st_size < _MOST_BYTES:
            entries = json.loads(file.read_text("utf-8"))
            if isinstance(entries, dict):
                return entries
    return None


def _check_kind(entries: dict[str, Any], file: Path) -> None:
    """Refuse an audit or a record by the name of the command that reads it.

    Raises:
        InvalidRobotError: the file is one.
    """
    from cuspaudit.robot.other_files import check_kind
    from cuspaudit.robot.place import Place

    check_kind(entries, "a certificate", Place(str(file)))
