"""Which members an adaptive sweep decides: the corners of cells whose corners differ.

The parameters named span a lattice of 2**levels steps a coarse one; a point of it is
its index in the family. The cells of the coarse grid are decided at their corners; a
cell whose corners differ is halved along every side, and so on. What is decided next
depends on what was decided alone, so a sweep that stopped goes on as if it had not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any

from cuspaudit.family.family import Family

__all__ = ["waves"]

Point = tuple[int, ...]
Values = Mapping[int, tuple[Any, ...]]


def waves(family: Family, values: Values) -> Iterator[Iterator[int]]:
    """The members to be decided, level by level, coarsest first.

    Args:
        family: an adaptive one.
        values: index to what is compared, of every member decided so far; it must
            hold those of a wave before the next is asked for.

    Yields:
        The indices of a wave; those in ``values`` already are among them.
    """
    assert family.adaptive is not None
    grid = [p for p in family.parameters if p.seed is None]
    axes = [k for k, p in enumerate(grid) if p.name in family.adaptive.parameters]
    step = 2**family.adaptive.levels
    cells = _coarse(family, axes, step)
    yield _members(family, _coarse_points(family, axes, step))
    while step > 1:
        refined = [c for c in cells if _differ(family, c, axes, step, values)]
        step //= 2
        cells = [s for c in refined for s in _shifted(c, axes, (0, step))]
        points = {p for c in refined for p in _shifted(c, axes, (0, step, 2 * step))}
        yield _members(family, iter(sorted(points)))


def _coarse(family: Family, axes: list[int], step: int) -> list[Point]:
    """The lowest corner of every coarse cell."""
    ranges = [
        range(0, size - 1, step) if k in axes else range(size)
        for k, size in enumerate(family.shape)
    ]
    return list(product(*ranges))


def _coarse_points(family: Family, axes: list[int], step: int) -> Iterator[Point]:
    ranges = [
        range(0, size, step if k in axes else 1) for k, size in enumerate(family.shape)
    ]
    return product(*ranges)


def _differ(
    family: Family, cell: Point, axes: list[int], step: int, values: Values
) -> bool:
    """Whether two corners of a cell differ; excluded corners are not compared."""
    corners = map(family.index_of, _shifted(cell, axes, (0, step)))
    return len({values[k] for k in corners if k in values}) > 1


def _shifted(point: Point, axes: list[int], shifts: tuple[int, ...]) -> Iterator[Point]:
    """The points beside ``point`` along ``axes``, by every choice of ``shifts``."""
    for shift in product(shifts, repeat=len(axes)):
        moved = list(point)
        for axis, by in zip(axes, shift, strict=True):
            moved[axis] += by
        yield tuple(moved)


def _members(family: Family, points: Iterator[Point]) -> Iterator[int]:
    indices = map(family.index_of, points)
    return (k for k in indices if family.values(k) is not None)
