"""The three answers."""

from __future__ import annotations

from enum import StrEnum

__all__ = ["Verdict"]


class Verdict(StrEnum):
    """CUSPIDAL, NONCUSPIDAL or UNDECIDED; equal to its word, and without truth value.

    >>> Verdict.CUSPIDAL == "cuspidal"
    True
    >>> bool(Verdict.UNDECIDED)
    Traceback (most recent call last):
    TypeError: a verdict is one of three, not true or false; compare it: == "cuspidal"
    """

    CUSPIDAL = "cuspidal"
    NONCUSPIDAL = "noncuspidal"
    UNDECIDED = "undecided"

    def __bool__(self) -> bool:
        raise TypeError(
            'a verdict is one of three, not true or false; compare it: == "cuspidal"'
        )
