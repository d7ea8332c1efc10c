"""`cuspaudit verify`: a certificate re-proved, with nothing else at hand."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

__all__ = ["verify"]


def verify(
    certificate: Annotated[Path, typer.Argument(help="A certificate file.")],
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the result as JSON.")
    ] = False,
) -> None:
    """Re-prove a verdict from its certificate alone, in ball and exact arithmetic."""
    from cuspaudit.certificate import printable, read_certificate
    from cuspaudit.certificate import verify as prove

    claim = read_certificate(certificate)
    result = prove(claim)
    if as_json:
        typer.echo(json.dumps({"file": str(certificate), **asdict(result)}, indent=1))
    else:
        word = "accepted" if result.accepted else "REJECTED"
        typer.echo(f"{word}: {printable(claim.robot_name)}: {result.reason}")
    raise typer.Exit(0 if result.accepted else 1)
