"""`cuspaudit audit --calibration`: an arm as designed, and as it was built."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from cuspaudit.cli.exit_codes import OF_VERDICT
from cuspaudit.cli.outlet import write_json
from cuspaudit.cli.running import STEPS, progress_bar
from cuspaudit.cli.summary import print_summary

if TYPE_CHECKING:
    from cuspaudit.robot.robot import Robot

__all__ = ["audit_with_calibration"]


def audit_with_calibration(
    robot: Robot,
    calibration: Path,
    json_file: str | None,
    html: Path | None,
    certificate: Path | None,
    snap: str,
    seed: int,
    timeout: float | None,
    within: bool,
    exit_zero: bool,
) -> None:
    """Audit both, print and write what was found; exit by the built arm's verdict."""
    from cuspaudit.auditing.calibrated import audit_calibrated
    from cuspaudit.auditing.options import Options
    from cuspaudit.auditing.proofs.certificates import certificate_text
    from cuspaudit.auditing.proofs.proof_record import proof_record
    from cuspaudit.robot.calibration import read_calibration
    from cuspaudit.robot.snap_policy import policy_from_name
    from cuspaudit.runtime.waiting import waited
    from cuspaudit.runtime.writing import write_text

    given = read_calibration(calibration)
    with progress_bar(STEPS) as step:
        options = Options(seed, timeout, step, policy_from_name(snap))
        result = audit_calibrated(robot, given, options)
    proof = certificate_text(result.built, within) if certificate else None
    written = str(certificate) if certificate and proof else None
    record = result.record(*((None, written) if within else (written, None)))
    built = record["calibrated"]
    built["seconds"]["total"] = round(waited(), 4)
    if certificate:
        write_text(certificate, proof or proof_record(result.built.answer))
    if html:
        from cuspaudit.pictures.page import page_text

        write_text(html, page_text(built, result.built))
    if write_json(json_file, record):
        _print(record, {"page": html, "certificate": written, "JSON": json_file})
    asked = built["limits"] if within and built["limits"] else record
    raise typer.Exit(0 if exit_zero else OF_VERDICT[asked["verdict"]])


def _print(record: dict[str, Any], files: dict[str, Any]) -> None:
    nominal = record["nominal"]
    typer.echo(f"nominal: {nominal['verdict']}: {nominal['proof']['why']}")
    typer.echo(f"as built, by {record['calibration']}:")
    print_summary(record["calibrated"], files)
    typer.echo(f"both: {record['why']}")
