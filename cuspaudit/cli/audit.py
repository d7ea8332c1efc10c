"""`cuspaudit audit`: import, decide, certify, cross-check and report."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cuspaudit.cli.calibrated import audit_with_calibration
from cuspaudit.cli.chains import audit_chains, check_alone
from cuspaudit.cli.exit_codes import OF_VERDICT
from cuspaudit.cli.free import audit_every_lock, audit_free, refuse_beside_free
from cuspaudit.cli.mechanisms import audit_mechanism, mechanism_named, no_arm
from cuspaudit.cli.opening import open_named, package_folders, xacro_arguments
from cuspaudit.cli.options import (
    RobotEngine,
    RobotEngineName,
    RobotName,
    Seed,
    Snap,
    Timeout,
)
from cuspaudit.cli.outlet import JsonFile, check_outlets, write_json
from cuspaudit.cli.robot_options import RobotOptions, with_robot_options
from cuspaudit.cli.running import run_audit
from cuspaudit.cli.summary import print_summary
from cuspaudit.errors import InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.robot.robot import Robot

__all__ = ["audit"]


@with_robot_options
def audit(
    robot: RobotName,
    reading: RobotOptions,
    json_file: JsonFile = None,
    html: Annotated[
        Path | None, typer.Option(help="Write an offline page with the animation.")
    ] = None,
    certificate: Annotated[
        Path | None,
        typer.Option(
            help="Write the proof: the certificate of the verdict, or without one "
            "the record of the exact run."
        ),
    ] = None,
    engine: RobotEngineName = RobotEngine.auto,
    snap: Snap = "default",
    seed: Seed = 0,
    timeout: Timeout = None,
    every: Annotated[
        bool,
        typer.Option(
            "--all",
            help="Audit every arm-like chain of a robot with several: a line each. "
            "Exit 0.",
        ),
    ] = False,
    within: Annotated[
        bool,
        typer.Option(
            "--within-limits",
            help="Exit code and certificate of the verdict within the joint limits.",
        ),
    ] = False,
    tolerance: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Is every arm so, whose axes are off by no more? FILE is YAML with "
            "lengths and angles. The exit code is that of the arm itself.",
        ),
    ] = None,
    calibration: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Audit the arm as it was built as well, by its calibration: UR's "
            "kinematics YAML, or deltas of a D-H table. Exit code of the built arm.",
        ),
    ] = None,
    free: Annotated[
        str | None,
        typer.Option(
            metavar="JOINT",
            help="Cover all values at which this joint, one to spare, may be locked. "
            "Exit 1 where every proved interval is cuspidal.",
        ),
    ] = None,
    exit_zero: Annotated[
        bool, typer.Option("--exit-zero", help="Exit 0 whatever the verdict.")
    ] = False,
) -> None:
    """Import, decide, certify, cross-check and report: the main job."""
    from cuspaudit.auditing.proofs.certificates import certificate_text, is_of_many_arms
    from cuspaudit.auditing.proofs.proof_record import proof_record
    from cuspaudit.robot.proposals import check_task
    from cuspaudit.runtime.waiting import waited
    from cuspaudit.runtime.writing import write_text

    check_outlets(json_file, html, certificate)
    mechanism = mechanism_named(robot)
    if mechanism is not None:
        no_arm(
            "audit",
            reading.by_flag()
            | {"--certificate": certificate, "--all": every, "--free": free}
            | {"--calibration": calibration, "--tolerance": tolerance},
        )
        audit_mechanism(mechanism, json_file, html, seed, timeout, exit_zero)
    if every:
        check_alone(
            reading.by_flag("base", "package", "xacro_arg")
            | {"--html": html, "--certificate": certificate, "--free": free}
            | {"--calibration": calibration, "--tolerance": tolerance}
        )
        audit_chains(
            *(robot, reading.base, json_file, engine.value, snap, seed, timeout),
            packages=package_folders(reading.package),
            xacro_args=xacro_arguments(reading.xacro_arg),
        )
        return
    opened = open_named(robot, reading, square=False)
    if free is not None:
        refuse_beside_free(
            {"--certificate": certificate, "--calibration": calibration}
            | {"--tolerance": tolerance}
        )
        audit_free(
            *(opened, free, json_file, html, snap, seed, timeout, within, exit_zero)
        )
    if _is_left_to_choose(opened, html, certificate):
        audit_every_lock(opened, json_file, snap, seed, timeout, exit_zero)
    check_task(opened.chain, opened.file)
    if calibration:
        if tolerance:
            found, expected = (
                "--tolerance beside --calibration",
                "leave one of them out",
            )
            raise InvalidInputError(file="audit", found=found, expected=expected)
        audit_with_calibration(
            *(opened, calibration, json_file, html, certificate, snap, seed, timeout),
            *(within, exit_zero),
        )
    result = run_audit(opened, seed, timeout, snap, engine.value, tolerance)
    proof = certificate_text(result, within) if certificate else None
    written = str(certificate) if certificate and proof else None
    which = 1 if within else 2 if is_of_many_arms(result) else 0
    record = result.record(*(written if k == which else None for k in range(3)))
    record["seconds"]["total"] = round(waited(), 4)
    if certificate:
        write_text(certificate, proof or proof_record(result.answer))
    if html:
        from cuspaudit.auditing.limits.limit_cuts import cuts_of
        from cuspaudit.pictures.page import page_text

        if result.within is not None:
            record["limits"]["cuts"] = cuts_of(result)
        write_text(html, page_text(record, result))
    if write_json(json_file, record):
        kept = {"page": html, "certificate": written, "JSON": json_file}
        if certificate and not proof:
            kept["record of the run"] = str(certificate)
        print_summary(record, kept)
    asked = record["limits"] if within and record["limits"] else record
    raise typer.Exit(0 if exit_zero else OF_VERDICT[asked["verdict"]])


def _is_left_to_choose(opened: Robot, *files: Path | None) -> bool:
    """Whether a joint is to spare and nothing is asked that needs one verdict."""
    from cuspaudit.robot.task import DIMENSIONS

    chain = opened.chain
    if any(files) or len(chain.joints) <= DIMENSIONS[chain.task]:
        return False
    from cuspaudit.auditing.free_joint.free_joint import lockable

    return bool(lockable(opened))
