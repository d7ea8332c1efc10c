"""A pytest plugin: ``pytest --cuspaudit robots/`` makes one test of every robot file.

The test audits the robot and compares what the file expects. A robot on which no
verdict was reached, or whose file expects nothing, is skipped with the reason.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

__all__ = ["RobotFile", "RobotTest"]


class _MismatchError(Exception):
    """A robot that contradicts its file, in one line."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add ``--cuspaudit``."""
    parser.getgroup("cuspaudit").addoption(
        "--cuspaudit",
        action="store_true",
        help="hold every robot file (.yaml with joints:, .csv) to its expectation",
    )


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> RobotFile | None:
    """Collect ``file_path`` when robots are asked for and it is one."""
    if not parent.config.getoption("--cuspaudit"):
        return None
    from cuspaudit.robot.formats.registry import is_recorded

    if is_recorded(file_path):
        return RobotFile.from_parent(parent, path=file_path)
    return None


class RobotFile(pytest.File):
    """A robot file: one test."""

    def collect(self) -> Iterator[RobotTest]:
        """The one test of this file."""
        yield RobotTest.from_parent(self, name=self.path.stem)


class RobotTest(pytest.Item):
    """The audit of one robot, compared with what its file expects."""

    def runtest(self) -> None:
        """Audit and compare."""
        from cuspaudit.auditing.check import check_robot

        result = check_robot(self.path)
        if result.is_failure:
            raise _MismatchError(result.detail)
        if result.status != "ok":
            pytest.skip(f"{result.status}: {result.detail}")

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        """One line for a mismatch; pytest's own report for anything else."""
        if isinstance(excinfo.value, _MismatchError):
            return f"{self.path}: {excinfo.value}"
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Where and what this test is."""
        return self.path, 0, f"robot {self.name}"
