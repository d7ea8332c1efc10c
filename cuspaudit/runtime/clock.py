"""The clock of a run: it times the stages, tells the steps and keeps the time limit.

What runs long inside one step is handed no clock: it asks ``check_time`` in its loops,
and stops at the limit that is in force there (``time_limit``). A routine with a
``timeout`` puts a limit in force for what it calls.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from cuspaudit.errors import TimeLimitError

__all__ = [
    "Clock",
    "Progress",
    "check_time",
    "seconds_left",
    "time_at_least",
    "time_is_up",
    "time_left",
    "time_limit",
]

Progress = Callable[[str], None]

#: when the limit in force ends, on the performance counter, and its seconds
_LIMIT: ContextVar[tuple[float, float] | None] = ContextVar("limit", default=None)


@contextmanager
def time_limit(seconds: float | None) -> Iterator[None]:
    """Let ``check_time`` raise in the block once so many seconds have passed.

    A limit that is in force already stays, where it is the earlier one.
    """
    outer = _LIMIT.get()
    if seconds is None or (
        outer is not None and outer[0] <= time.perf_counter() + seconds
    ):
        yield
        return
    token = _LIMIT.set((time.perf_counter() + seconds, seconds))
    try:
        yield
    finally:
        _LIMIT.reset(token)


@contextmanager
def time_at_least(seconds: float) -> Iterator[None]:
    """Put off a limit that leaves the block less than so many seconds.

    For what is quick and ends well where something long was stopped.
    """
    limit = _LIMIT.get()
    end = time.perf_counter() + seconds
    if limit is None or limit[0] >= end:
        yield
        return
    token = _LIMIT.set((end, seconds))
    try:
        yield
    finally:
        _LIMIT.reset(token)


def seconds_left() -> float | None:
    """The seconds until the limit in force, at least 0; None without one."""
    limit = _LIMIT.get()
    return None if limit is None else max(0.0, limit[0] - time.perf_counter())


def check_time(step: str) -> None:
    """Stop when the limit in force has passed.

    Raises:
        TimeLimitError: it has; it names ``step``.
    """
    limit = _LIMIT.get()
    if limit is not None and time.perf_counter() >= limit[0]:
        raise TimeLimitError(step, limit[1])


def time_is_up() -> bool:
    """Whether the limit in force has passed, for a loop that ends with what it has."""
    limit = _LIMIT.get()
    return limit is not None and time.perf_counter() >= limit[0]


def time_left(step: str) -> float:
    """`seconds_left`, for a program that takes a limit itself; inf without one.

    Raises:
        TimeLimitError: the limit has passed; it names ``step``.
    """
    check_time(step)
    left = seconds_left()
    return math.inf if left is None else left


class Clock:
    """Started when it is made.

    Args:
        timeout: seconds after which no further step is begun, or None.
        progress: called with the name of each step before it runs.

    Attributes:
        seconds: the time of each stage, and in all.
        timeout: as given.
        tell: as ``progress`` was given.
    """

    def __init__(
        self, timeout: float | None = None, progress: Progress = lambda step: None
    ) -> None:
        self.seconds: dict[str, float] = {}
        self.timeout = timeout
        self.tell = progress
        self._start = time.perf_counter()

    @property
    def left(self) -> float | None:
        """The seconds left, at least 0; None without a limit."""
        if self.timeout is None:
            return None
        return max(0.0, self.timeout - (time.perf_counter() - self._start))

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Add the time of the block to ``name`` and to the total."""
        begun = time.perf_counter()
        try:
            yield
        finally:
            now = time.perf_counter()
            self.seconds[name] = self.seconds.get(name, 0.0) + now - begun
            self.seconds["total"] = now - self._start

    def step(self, name: str, always: bool = False) -> None:
        """Tell a step; unless it is made ``always``, stop when time is up.

        Raises:
            TimeLimitError: the time limit has passed.
        """
        if not always and self.timeout is not None and not self.left:
            raise TimeLimitError(name, self.timeout)
        self.tell(name)
