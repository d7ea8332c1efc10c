"""Robot files, each held to the verdict recorded in it."""

from __future__ import annotations

import signal
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, field
from functools import partial
from multiprocessing import active_children
from pathlib import Path
from typing import Any, Literal
from xml.etree import ElementTree

from cuspaudit.auditing.audit import audit
from cuspaudit.errors import CuspauditError, InvalidInputError, unforeseen
from cuspaudit.robot.formats.registry import recorded_endings
from cuspaudit.robot.library import open_robot, uses
from cuspaudit.robot.robot import WITHIN
from cuspaudit.runtime.interruption import end_processes

__all__ = ["Checked", "check_robot", "check_robots", "junit", "robot_files"]

Status = Literal["ok", "undecided", "mismatch", "error", "fault", "no expectation"]


@dataclass(frozen=True)
class Checked:
    """One robot file, compared with its expectation.

    Attributes:
        file: the file.
        status: "undecided" when a verdict is recorded and none was reached: not a
            contradiction, but not a confirmation; "fault" when an error that nobody
            foresaw ended the audit, which says nothing of the robot.
        detail: what was found, and what was expected where it differs.
        seconds: time of the audit.
        found: the verdict and the counts that are known.
    """

    file: str
    status: Status
    detail: str
    seconds: float
    found: Mapping[str, str | int] = field(default_factory=dict)

    @property
    def is_failure(self) -> bool:
        """Whether the file contradicts its record or cannot be audited."""
        return self.status in ("mismatch", "error", "fault")

    def to_dict(self) -> dict[str, Any]:
        """The comparison as JSON has it."""
        return asdict(self)


def robot_files(paths: Iterable[Path]) -> list[Path]:
    """The robot files among ``paths``, folders searched without descending, sorted.

    Raises:
        InvalidInputError: a path does not exist, or a folder holds no robot file.
    """
    files: list[Path] = []
    known = recorded_endings()
    for path in paths:
        if path.is_dir():
            found = sorted(p for p in path.iterdir() if p.suffix.lower() in known)
            if not found:
                raise InvalidInputError(
                    file=str(path),
                    found="no robot file",
                    expected=f"name files or a folder with {', '.join(known)}",
                )
            files += found
        elif path.is_file():
            files.append(path)
        else:
            raise InvalidInputError(
                file=str(path), found="no such file", expected="name a file or folder"
            )
    return files


def check_robots(
    files: list[Path],
    workers: int = 1,
    packages: Mapping[str, str] | None = None,
    xacro_args: Mapping[str, str] | None = None,
) -> Iterator[Checked]:
    """Check every file, in order; with several workers, in parallel.

    Args:
        files: of robots.
        workers: processes.
        packages: name to folder, for those that are xacro files.
        xacro_args: name to text, for those that are xacro files.
    """
    one = partial(check_robot, packages=packages, xacro_args=xacro_args)
    if workers <= 1 or len(files) <= 1:
        yield from map(one, files)
        return
    others = active_children()
    with ProcessPoolExecutor(min(workers, len(files)), initializer=_quiet) as pool:
        try:
            for future in [pool.submit(one, file) for file in files]:
                yield future.result()
        except BaseException:
            end_processes(others)
            raise


def _quiet() -> None:
    """Leave an interruption to the process that began this one."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def check_robot(
    file: Path,
    packages: Mapping[str, str] | None = None,
    xacro_args: Mapping[str, str] | None = None,
) -> Checked:
    """Audit one file and compare what it expects."""
    try:
        if uses(file, "packages"):
            robot = open_robot(file, packages=packages, xacro_args=xacro_args)
        else:
            robot = open_robot(file)
        result = audit(robot)
    except CuspauditError as error:
        return Checked(str(file), "error", str(error), 0.0)
    except Exception as error:  # the other files are checked all the same
        return Checked(str(file), "fault", unforeseen(error), 0.0)
    record = result.record()
    found = _found(record)
    status, detail = _compare(robot.expect, found)
    known = {key: value for key, value in found.items() if value is not None}
    return Checked(str(file), status, detail, record["seconds"]["total"], known)


def _found(record: Mapping[str, Any]) -> dict[str, Any]:
    postures = record["postures"]
    return {
        "verdict": record["verdict"],
        "aspects": record["aspects"]["count"],
        "max_postures": postures["max"] if postures["proved"] else None,
        "cusps": record["singular"]["cusps"],
        "nodes": record["singular"]["nodes"],
    } | _found_within(record["limits"])


def _found_within(limits: Mapping[str, Any] | None) -> dict[str, Any]:
    """The verdict within joint limits, and its aspects where they are proved."""
    verdict, aspects = None, None
    if limits is not None:
        verdict, counted = limits["verdict"], limits["aspects"]
        aspects = counted["count"] if counted["proved"] else None
    return {f"{WITHIN}.verdict": verdict, f"{WITHIN}.aspects": aspects}


def _compare(
    expect: Mapping[str, str | int | None] | None, found: Mapping[str, Any]
) -> tuple[Status, str]:
    wanted = {k: v for k, v in (expect or {}).items() if v is not None}
    text = ", ".join(f"{k} {v}" for k, v in found.items() if v is not None)
    if not wanted:
        return "no expectation", text
    for key in ("verdict", f"{WITHIN}.verdict"):
        if found[key] == "undecided" != wanted.get(key, "undecided"):
            return "undecided", f"{text}; {key} {wanted[key]} is recorded"
    wrong = [
        f"{key} {found[key]} where {value} is recorded"
        for key, value in wanted.items()
        if found[key] is not None and found[key] != value
    ]
    if wrong:
        return "mismatch", "; ".join(wrong)
    unproved = [f"{k} {v}" for k, v in wanted.items() if found[k] is None]
    return "ok", "; not proved: ".join(filter(None, (text, ", ".join(unproved))))


def junit(results: list[Checked]) -> str:
    """The results as JUnit XML; an undecided robot counts as skipped."""
    suite = ElementTree.Element(
        "testsuite",
        name="cuspaudit check",
        tests=str(len(results)),
        failures=str(sum(r.status == "mismatch" for r in results)),
        errors=str(sum(r.status in ("error", "fault") for r in results)),
        skipped=str(sum(r.status == "undecided" for r in results)),
        time=f"{sum(r.seconds for r in results):.3f}",
    )
    tags = {
        "mismatch": "failure",
        "error": "error",
        "fault": "error",
        "undecided": "skipped",
    }
    for result in results:
        case = ElementTree.SubElement(
            suite,
            "testcase",
            classname="cuspaudit",
            name=result.file,
            time=f"{result.seconds:.3f}",
        )
        if result.status in tags:
            tag = tags[result.status]
            ElementTree.SubElement(case, tag, message=result.detail)
    ElementTree.indent(suite)
    return ElementTree.tostring(suite, encoding="unicode", xml_declaration=True) + "\n"
