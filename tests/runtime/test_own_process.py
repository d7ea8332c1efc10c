"""Work in a process of its own ends within its limits and takes all along."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable
from multiprocessing import get_context
from pathlib import Path

import pytest
from flint import fmpz

from cuspaudit.errors import NotSquareError, UnableError
from cuspaudit.runtime.own_process import run_in_own_process

Progress = Callable[[str], None]


def test_value_and_steps_come_back() -> None:
    """The result and the names of the steps arrive in the calling process."""
    seen: list[str] = []

    def work(progress: Progress) -> int:
        progress("crit")
        time.sleep(0.5)
        return 7

    assert run_in_own_process(work, progress=seen.append) == 7
    assert "crit" in seen


def test_the_time_limit_ends_programs_started_within(tmp_path: Path) -> None:
    """At the limit the step is named, and a program it started is gone too."""
    sign = tmp_path / "alive"

    def work(progress: Progress) -> None:
        progress("roadmap")
        subprocess.run(["sh", "-c", f"sleep 1.5; touch {sign}"], check=False)

    with pytest.raises(UnableError, match=r"roadmap: the time limit of 0\.4 s"):
        run_in_own_process(work, timeout=0.4)
    time.sleep(1.6)
    assert not sign.exists()


def test_the_memory_limit_is_an_answer() -> None:
    """A kernel that runs out of memory ends as an error naming the step."""

    def work(progress: Progress) -> bool:
        progress("resultants")
        return bool(fmpz(3) ** (10**11) > 0)

    with pytest.raises(UnableError, match=r"resultants: .* memory"):
        run_in_own_process(work, memory=10**9)


def test_errors_keep_their_facts() -> None:
    """An error raised inside arrives with its attributes and its message."""

    def work(progress: Progress) -> None:
        raise NotSquareError(rows=2, variables=5)

    with pytest.raises(NotSquareError, match="2 equations") as caught:
        run_in_own_process(work)
    assert caught.value.variables == 5


def test_a_bug_is_not_taken_for_a_limit() -> None:
    """An exception that is no error of this package comes through as it is."""

    def work(progress: Progress) -> None:
        raise ZeroDivisionError("a bug")

    with pytest.raises(ZeroDivisionError, match="a bug"):
        run_in_own_process(work)


def test_a_worker_of_a_pool_does_the_work_in_place() -> None:
    """Where a process may start none, the value comes back all the same."""
    with get_context("fork").Pool(1) as pool:
        assert pool.apply(_seven_in_own_process) == 7


def _seven_in_own_process() -> int:
    return int(run_in_own_process(lambda progress: 7, timeout=5.0))
