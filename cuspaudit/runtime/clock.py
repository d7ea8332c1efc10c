"""The clock of a run: it times the stages, tells the steps and keeps the time limit."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from cuspaudit.errors import TimeLimitError

__all__ = ["Clock", "Progress"]

Progress = Callable[[str], None]


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
