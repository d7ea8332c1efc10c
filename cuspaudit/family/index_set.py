"""A set of whole numbers kept as runs, small where it has few gaps."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["IndexSet"]


class IndexSet:
    """Whole numbers, held as the ends of their runs.

    >>> some = IndexSet()
    >>> some.update([3, 1, 2, 7])
    >>> [k for k in range(9) if k in some], len(some)
    ([1, 2, 3, 7], 4)
    """

    def __init__(self) -> None:
        self._first: list[int] = []
        self._last: list[int] = []

    def update(self, numbers: Sequence[int] | NDArray[np.int64]) -> None:
        """Add ``numbers``."""
        new = np.unique(np.asarray(numbers, dtype=np.int64))
        if not new.size:
            return
        breaks = np.flatnonzero(np.diff(new) > 1)
        first = new[np.concatenate(([0], breaks + 1))].tolist()
        last = new[np.concatenate((breaks, [new.size - 1]))].tolist()
        pairs = sorted(zip(self._first + first, self._last + last, strict=True))
        self._first, self._last = [], []
        for low, high in pairs:
            if self._last and low <= self._last[-1] + 1:
                self._last[-1] = max(self._last[-1], high)
            else:
                self._first.append(low)
                self._last.append(high)

    def __contains__(self, number: int) -> bool:
        place = bisect_right(self._first, number) - 1
        return place >= 0 and number <= self._last[place]

    def __len__(self) -> int:
        pairs = zip(self._first, self._last, strict=True)
        return sum(high - low + 1 for low, high in pairs)
