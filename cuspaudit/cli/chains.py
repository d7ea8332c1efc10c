"""The serial chains of a robot with several: listed, and audited one by one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import typer

from cuspaudit.cli.outlet import write_json
from cuspaudit.errors import CuspauditError, InvalidInputError

__all__ = ["audit_chains", "check_alone", "print_chains"]


def print_chains(records: Sequence[Mapping[str, Any]]) -> None:
    """A line a chain: the options that choose it, its joints, its task."""
    typer.echo(f"{len(records)} serial chains; choose one by its options:")
    width = min(60, max(len(str(record["options"])) for record in records))
    for record in records:
        typer.echo(f"  {record['options']:{width}}  {record['remark']}")


def check_alone(options: Mapping[str, object]) -> None:
    """Check that none of these options stands beside --all.

    Raises:
        InvalidInputError: one does.
    """
    for name, value in options.items():
        if value:
            expected = f"leave out {name}, or leave out --all and audit one chain"
            raise InvalidInputError(
                file="audit --all", found=f"{name} beside --all", expected=expected
            )


def audit_chains(
    robot: str,
    base: str | None,
    json_file: str | None,
    engine: str,
    snap: str,
    seed: int,
    timeout: float | None,
    *,
    packages: Mapping[str, str],
    xacro_args: Mapping[str, str],
) -> None:
    """Audit every arm-like chain, a line each; the others are named.

    Args:
        robot: a file, or a name of the library.
        base: a link of the tree.
        json_file: where to write the audits, "-" for standard output, or None.
        engine: as in `audit`.
        snap: as in `audit`.
        seed: as in `audit`.
        timeout: of each audit, in seconds.
        packages: name to folder, for a xacro file.
        xacro_args: name to text, for a xacro file.

    Raises:
        InvalidInputError: the robot cannot be read.
    """
    from cuspaudit.cli.running import run_audit
    from cuspaudit.robot.library import open_robot, serial_chains

    records: list[dict[str, Any]] = []
    for chain in serial_chains(robot, base, packages, xacro_args):
        record = {**chain.record(), "verdict": None, "audit": None, "error": None}
        records.append(record)
        if chain.is_arm:
            try:
                opened = open_robot(
                    robot,
                    base=chain.base,
                    tip=chain.tip,
                    task=chain.task,
                    lock=dict.fromkeys(chain.locked, "0"),
                    packages=packages,
                    xacro_args=xacro_args,
                )
                result = run_audit(opened, seed, timeout, snap, engine)
                found = result.record(None)
                record |= {"audit": found, "verdict": found["verdict"]}
            except CuspauditError as error:
                record["error"] = str(error)
        if json_file != "-":
            _print_row(record)
    write_json(json_file, records)


def _print_row(record: Mapping[str, Any]) -> None:
    said = record["verdict"] or ("refused" if record["error"] else "no arm")
    remark = record["error"] or record["remark"]
    typer.echo(f"{said:12} {record['options']}  ({remark})")
