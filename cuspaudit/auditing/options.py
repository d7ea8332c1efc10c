"""How an audit is made, and the clock that keeps it to its time."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from cuspaudit.errors import UnableError
from cuspaudit.robot.snap_policy import DEFAULT_POLICY, SnapPolicy

__all__ = ["Clock", "Options"]


@dataclass(frozen=True)
class Options:
    """How an audit is made.

    Attributes:
        seed: of every random choice; it is kept in the result.
        timeout: seconds after which the next step is not begun, or None.
        progress: called with the name of each step before it runs.
        snap: which numbers are taken for others.
        engine: the route to connectivity, "auto", "roadmap" or "routing"; or "pairs",
            which decides three joints, and gives a witness or evidence for six.
    """

    seed: int = 0
    timeout: float | None = None
    progress: Callable[[str], None] = lambda step: None
    snap: SnapPolicy = DEFAULT_POLICY
    engine: str = "auto"


class Clock:
    """Times the stages, reports the steps, and keeps the time limit."""

    def __init__(self, options: Options) -> None:
        self.seconds: dict[str, float] = {}
        self._start = time.perf_counter()
        self._options = options

    @property
    def engine(self) -> str:
        """The route to connectivity that was asked for."""
        return self._options.engine

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Add the time of the block to ``name`` and to the total."""
        begun = time.perf_counter()
        try:
            yield
        finally:
            now = time.perf_counter()
            self.seconds[name] = now - begun
            self.seconds["total"] = now - self._start

    @property
    def seed(self) -> int:
        """The seed of the audit."""
        return self._options.seed

    @property
    def left(self) -> float | None:
        """The seconds left, at least 0; None without a limit."""
        limit = self._options.timeout
        if limit is None:
            return None
        return max(0.0, limit - (time.perf_counter() - self._start))

    def step(self, name: str, always: bool = False) -> None:
        """Report a step; unless it is made ``always``, stop when time is up.

        Raises:
            UnableError: the time limit has passed.
        """
        limit = self._options.timeout
        late = limit is not None and time.perf_counter() - self._start > limit
        if late and not always:
            raise UnableError(name, f"the time limit of {limit:g} s has passed")
        self._options.progress(name)
