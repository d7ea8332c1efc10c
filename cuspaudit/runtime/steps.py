"""The steps of a decision, timed: their names, seconds and peak memory."""

from __future__ import annotations

import resource
import sys
import time
from dataclasses import dataclass

from cuspaudit.runtime.clock import Clock, Progress

__all__ = ["Step", "Steps"]


@dataclass(frozen=True)
class Step:
    """One step of Algorithm 1 that has ended.

    Attributes:
        name: the paper's routine.
        seconds: its wall time.
        megabytes: the largest resident memory of the process so far, programs that it
            started included; None where it is not known.
    """

    name: str
    seconds: float
    megabytes: float | None


class Steps:
    """Keeps the steps and their time limit."""

    def __init__(self, progress: Progress, timeout: float | None = None) -> None:
        self.done: list[Step] = []
        self._clock = Clock(timeout, progress)
        self._begun = time.perf_counter()
        self._name: str | None = None
        self._asked = "start"

    @property
    def current(self) -> str:
        """The name of the step under way, or of the one that had no time to begin."""
        return self._asked

    @property
    def left(self) -> float | None:
        """Seconds until the time limit, at least 0; None without one."""
        return self._clock.left

    def begin(self, name: str) -> None:
        """End the step under way and begin ``name``.

        Raises:
            TimeLimitError: the time limit has passed.
        """
        self.end()
        self._asked = name
        self._clock.step(name)
        self._name, self._begun = name, time.perf_counter()

    def end(self) -> None:
        """End the step under way, if there is one."""
        if self._name is not None:
            seconds = time.perf_counter() - self._begun
            self.done.append(Step(self._name, seconds, _peak()))
            self._name = None


def _peak() -> float:
    """Peak resident memory in MB; the kernel counts in bytes on macOS, else in kB."""
    unit = 1e6 if sys.platform == "darwin" else 1e3
    who = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    return max(resource.getrusage(w).ru_maxrss for w in who) / unit
