"""A time limit kept by the system, in a process that may be ended for it."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

__all__ = ["TimeUp", "alarm"]


class TimeUp(BaseException):
    """The time has passed; no ``Exception``, so that no step takes it."""


@contextmanager
def alarm(seconds: float | None) -> Iterator[None]:
    """Run the block for at most ``seconds``; only in the main thread of a process.

    A library that does not come back is not interrupted: after twice the time on the
    processor the system ends the process.

    Raises:
        TimeUp: the time has passed.
    """
    if seconds is None:
        yield
        return
    signal.signal(signal.SIGALRM, _time_is_up)
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    try:
        signal.setitimer(signal.ITIMER_PROF, 2 * seconds)
        signal.setitimer(signal.ITIMER_REAL, seconds)
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.setitimer(signal.ITIMER_PROF, 0)


def _time_is_up(number: int, frame: FrameType | None) -> None:
    raise TimeUp
