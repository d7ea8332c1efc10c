"""The three answers."""

from __future__ import annotations

from enum import Enum

__all__ = ["Verdict"]


class Verdict(Enum):
    """CUSPIDAL, NONCUSPIDAL or UNDECIDED; it has no truth value.

    >>> bool(Verdict.UNDECIDED)
    Traceback (most recent call last):
    TypeError: a verdict is one of three, not true or false; compare it with `is`
    """

    CUSPIDAL = "cuspidal"
    NONCUSPIDAL = "noncuspidal"
    UNDECIDED = "undecided"

    def __bool__(self) -> bool:
        raise TypeError(
            "a verdict is one of three, not true or false; compare it with `is`"
        )
