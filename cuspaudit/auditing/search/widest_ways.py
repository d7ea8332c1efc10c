"""Widest ways in a graph: those whose lowest edge is as high as possible.

A way along a spanning tree of the highest edges is a widest one: cut the tree at its
lowest edge on that way, and no edge across the cut is higher.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

__all__ = ["WidestWays"]


class WidestWays:
    """A graph on the numbers from 0, its edges with levels.

    >>> ways = WidestWays(3)
    >>> for edge in ((0, 1, 0.2), (0, 2, 0.9), (2, 1, 0.8)):
    ...     ways.join(*edge)
    >>> ways.between(0, 1)
    [0, 2, 1]
    """

    def __init__(self, size: int) -> None:
        self.size = size
        self._edges: list[tuple[float, int, int]] = []
        self._tree: dict[int, list[int]] | None = None

    def join(self, i: int, j: int, level: float) -> None:
        """Add an edge."""
        self._edges.append((level, i, j))
        self._tree = None

    def levels(self, pairs: Sequence[tuple[int, int]]) -> NDArray[np.float64]:
        """The lowest edge on the widest way of each pair; 0 where there is no way."""
        edges = {(min(i, j), max(i, j)): level for level, i, j in self._highest()}
        found = []
        for start, goal in pairs:
            way = self.between(start, goal)
            steps = [(min(a, b), max(a, b)) for a, b in pairwise(way)]
            found.append(min((edges[step] for step in steps), default=0.0))
        return np.array(found)

    def between(self, start: int, goal: int) -> list[int]:
        """The numbers along the widest way; empty where there is none."""
        tree = self._spanning()
        before = {start: start}
        waiting = deque([start])
        while waiting and goal not in before:
            here = waiting.popleft()
            for other in tree.get(here, []):
                if other not in before:
                    before[other] = here
                    waiting.append(other)
        if goal not in before:
            return []
        way = [goal]
        while way[-1] != start:
            way.append(before[way[-1]])
        return way[::-1]

    def _highest(self) -> list[tuple[float, int, int]]:
        """The edges of a spanning forest, the highest first."""
        root = list(range(self.size))

        def top(k: int) -> int:
            while root[k] != k:
                root[k] = root[root[k]]
                k = root[k]
            return k

        kept = []
        for level, i, j in sorted(self._edges, reverse=True):
            a, b = top(i), top(j)
            if a != b:
                root[a] = b
                kept.append((level, i, j))
        return kept

    def _spanning(self) -> dict[int, list[int]]:
        if self._tree is None:
            self._tree = {}
            for _, i, j in self._highest():
                self._tree.setdefault(i, []).append(j)
                self._tree.setdefault(j, []).append(i)
        return self._tree
