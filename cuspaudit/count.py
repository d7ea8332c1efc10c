"""A number that was counted, and whether it is proved."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Count"]


@dataclass(frozen=True)
class Count:
    """A number, and whether it is proved.

    Attributes:
        count: how many were found.
        proved: False when a degenerate place was left out of the count.
    """

    count: int
    proved: bool
