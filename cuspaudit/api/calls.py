"""The commands as functions.

Each loads what it needs when it is called. Errors are of the family under
`CuspauditError`; a message says what was found and what to do.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from cuspaudit.errors import InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.api.results import Audit, SystemAudit
    from cuspaudit.auditing.check import Checked
    from cuspaudit.certificate.checker import Verification
    from cuspaudit.family.sweep import Swept
    from cuspaudit.robot.robot import Robot
    from cuspaudit.robot.tolerance import AxisTolerance

__all__ = ["audit", "check", "decide", "load", "sweep", "verify"]

File = str | os.PathLike[str]
Progress = Callable[[str], None]


def load(
    source: File,
    *,
    tip: str | None = None,
    base: str | None = None,
    task: str | None = None,
    lock: Mapping[str, str] | None = None,
    calibration: File | None = None,
    convention: str | None = None,
    angle_unit: str | None = None,
    length_unit: str | None = None,
    packages: Mapping[str, str] | None = None,
    xacro_args: Mapping[str, str] | None = None,
) -> Robot:
    """The robot in a file, or of a name in the library.

    Args:
        source: a URDF, MJCF, SDF or xacro file, a D-H table, or a name that
            ``cuspaudit import --list`` shows.
        tip: tip link of a URDF that has several ends.
        base: base link of a URDF; its root when left out.
        task: ``position``, ``position-and-angle``, ``position-and-z-axis`` (or x, y)
            or ``pose``; by the number of joints when left out.
        lock: joint name to the value at which it is held, as text: ``"0"``,
            ``"pi/4"``, ``"30 deg"``, ``"0.1"`` for a slide.
        calibration: a file with the axes as they were built (docs/calibration.md); give
            ``snap="none"`` to its audit, so that nothing that was measured is rounded.
        convention: ``standard`` or ``modified``, of a table that does not say.
        angle_unit: ``rad`` or ``deg``, of bare angles in a table that does not say.
        length_unit: ``m`` or ``mm``, of a table that does not say.
        packages: name to folder, for ``$(find NAME)`` in a xacro file.
        xacro_args: name to text, for ``$(arg NAME)`` in a xacro file.

    Raises:
        InvalidRobotError: no such robot, or it cannot be read, or its joints do not
            fit its task.
    """
    from cuspaudit.robot.library import open_robot

    held = None if lock is None else {k: _text(k, value) for k, value in lock.items()}
    robot = open_robot(
        os.fspath(source),
        tip=tip,
        base=base,
        task=task,
        lock=held,
        convention=convention,
        angle_unit=angle_unit,
        length_unit=length_unit,
        packages=packages,
        xacro_args=xacro_args,
    )
    if calibration is None:
        return robot
    from cuspaudit.robot.calibration import calibrated, read_calibration

    return calibrated(robot, read_calibration(Path(os.fspath(calibration))))


def audit(
    robot: Robot,
    *,
    seed: int = 0,
    timeout: float | None = None,
    engine: Literal["auto", "roadmap", "routing", "pairs"] = "auto",
    snap: File = "default",
    tolerance: File | Mapping[str, str] | None = None,
    progress: Progress = lambda step: None,
) -> Audit:
    """The audit of ``robot``: verdict, proof, witness, cross-check.

    Args:
        robot: from `load`.
        seed: of every random choice; the same seed gives the same audit.
        timeout: seconds after which the search for a verdict ends undecided.
        engine: the route of the decision.
        snap: which rounded numbers are made exact: ``default``, ``none`` or a file.
        tolerance: how far each axis may be off: a YAML file, or ``{"lengths": "1e-4",
            "angles": "1e-4"}`` (the robot's unit, and rad); that of the robot's file
            when left out.
        progress: called with the name of each step before it runs.

    Raises:
        AssumptionError: a hypothesis of the theory fails for this robot and task.
        CrossCheckError: exact and numeric answers disagree; then there is no verdict.
    """
    from cuspaudit.api.results import Audit
    from cuspaudit.auditing.audit import Options
    from cuspaudit.auditing.audit import audit as run
    from cuspaudit.robot.robot import Robot
    from cuspaudit.robot.snap_policy import policy_from_name

    if not isinstance(robot, Robot):
        raise InvalidInputError(
            file="audit",
            found=f"{robot!r} is not a robot",
            expected="give what load returns: audit(load(...))",
        )
    policy = policy_from_name(os.fspath(snap))
    options = Options(seed, timeout, progress, policy, engine, _allowed(tolerance))
    return Audit(run(robot, options))


def decide(
    *,
    variables: Sequence[str],
    map: Sequence[str],
    equations: Sequence[str] = (),
    engine: Literal["auto", "roadmap", "routing"] = "auto",
    complete: bool = False,
    seed: int = 1,
    timeout: float | None = None,
    progress: Progress = lambda step: None,
) -> SystemAudit:
    """Whether the map R on V = {f = 0} is cuspidal: Algorithm 1, without a robot.

    Args:
        variables: names of the coordinates of R^n.
        map: R, d polynomials as text, d the dimension of V; parsed, never evaluated.
        equations: f, polynomials as text; none for V = R^n.
        engine: the route to connectivity; "auto" looks for a couple first.
        complete: whether "auto" makes the whole run although there is a couple.
        seed: of every random choice.
        timeout: seconds after which it ends undecided.
        progress: called with the name of each step before it runs.

    Raises:
        InvalidSystemError: a polynomial cannot be read.
        AssumptionError: a hypothesis of the algorithm fails for this map.
    """
    from cuspaudit.api.results import SystemAudit
    from cuspaudit.auditing.systems.file import system_from_entries
    from cuspaudit.auditing.systems.report import decide_system

    entries = {
        "variables": list(variables),
        "equations": list(equations),
        "map": list(map),
    }
    system = system_from_entries("decide", entries)
    return SystemAudit(
        decide_system(
            system,
            engine,
            complete=complete,
            seed=seed,
            timeout=timeout,
            progress=progress,
        )
    )


def verify(certificate: File) -> Verification:
    """What the checker says of a certificate file, from the file alone.

    Raises:
        InvalidCertificateError: the file is no certificate.
    """
    from cuspaudit.certificate import read_certificate
    from cuspaudit.certificate import verify as prove

    return prove(read_certificate(Path(certificate)))


def sweep(
    family: File,
    folder: File,
    *,
    workers: int = 1,
    timeout: float | None = None,
    scheduler: str | None = None,
    progress: Callable[[int, int], None] = lambda done, size: None,
) -> Swept:
    """Decide every member of a family that the table in ``folder`` lacks.

    A script that calls it with several workers keeps the call under
    ``if __name__ == "__main__":``, as every use of processes does.

    Args:
        family: a family file.
        folder: where ``results.parquet`` is, or will be; a sweep that stopped goes on.
        workers: processes.
        timeout: seconds a member may take; beyond them it is a row with this error.
        scheduler: the address of a Dask scheduler that runs already.
        progress: called with how many members are done, and of how many.

    Raises:
        InvalidInputError: the family cannot be read, or the folder is another's.
    """
    from cuspaudit.family.sweep import sweep as run

    return run(Path(family), Path(folder), workers, progress, scheduler, timeout)


def check(paths: File | Iterable[File], *, workers: int = 1) -> list[Checked]:
    """Hold robot files to the verdicts recorded in them.

    Args:
        paths: files, or folders of them.
        workers: processes.

    Raises:
        InvalidInputError: a path does not exist, or a folder holds no robot file.
    """
    from cuspaudit.auditing.check import check_robots, robot_files

    several = [paths] if isinstance(paths, str | os.PathLike) else paths
    return list(check_robots(robot_files([Path(p) for p in several]), workers))


def _allowed(tolerance: File | Mapping[str, str] | None) -> AxisTolerance | None:
    from cuspaudit.robot.place import Place
    from cuspaudit.robot.tolerance import parse_tolerance, tolerance_from_file

    if tolerance is None:
        return None
    if isinstance(tolerance, str | os.PathLike):
        return tolerance_from_file(os.fspath(tolerance))
    return parse_tolerance(tolerance, Place("audit", "tolerance"))


def _text(joint: str, value: object) -> str:
    if not isinstance(value, str):
        raise InvalidInputError(
            file="load",
            where=f"lock {joint}",
            found=f"{value!r} is not a text",
            expected='write the value with its unit, for example "pi/4" or "30 deg"',
        )
    return value
