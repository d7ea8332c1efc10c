"""A way inside one open cell, in floating point turned rational: a proposal."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from flint import fmpq

from cuspaudit.algebra.rationals import simplest_between
from cuspaudit.algebra.univariate import RealRoot
from cuspaudit.geometry.cells.open_cells import Cell, OpenCells, Point

__all__ = ["way_inside"]

#: a coordinate may move by this part of its distance from the walls, to be simple
_SLACK = fmpq(1, 32)

_Bounds = tuple[fmpq | None, fmpq | None]


def way_inside(
    cells: OpenCells, first: Point, second: Point, steps: int
) -> list[Point]:
    """Rational points from ``first`` to ``second``, both in one cell, in ``steps``.

    Each coordinate keeps its place relative to the walls below and above it, blended
    from that of ``first`` to that of ``second``. Walls are rounded to doubles, so the
    points lie in the cell but for rounding.
    """
    cell = cells.cell(first)
    start, end = (_places(cells, cell, point) for point in (first, second))
    way = [first]
    for k in range(1, steps):
        s = fmpq(k, steps)
        point: Point = ()
        for i, a, b in zip(cell, start, end, strict=True):
            bounds = _bounds(cells, point, i)
            point = (*point, _coordinate((1 - s) * a + s * b, bounds))
        way.append(point)
    return [*way, second]


def _places(cells: OpenCells, cell: Cell, point: Point) -> list[fmpq]:
    places = []
    for k, (i, y) in enumerate(zip(cell, point, strict=True)):
        low, high = _bounds(cells, point[:k], i)
        if low is None:
            places.append(y if high is None else high - y)
        else:
            places.append(y - low if high is None else (y - low) / (high - low))
    return places


def _coordinate(place: fmpq, bounds: _Bounds) -> fmpq:
    low, high = bounds
    slack = place * _SLACK
    if low is not None and high is not None:
        y = low + place * (high - low)
        slack = min(place, 1 - place) * (high - low) * _SLACK
    elif low is not None:
        y = low + place
    elif high is not None:
        y = high - place
    else:
        y, slack = place, _SLACK
    return simplest_between(y - slack, y + slack)


def _bounds(cells: OpenCells, below: Sequence[fmpq], place: int) -> _Bounds:
    """The walls below and above, None at infinity."""
    roots = [None, *cells.stack(below), None]
    low, high = list(pairwise(roots))[place]
    return _rounded(low), _rounded(high)


def _rounded(root: RealRoot | None) -> fmpq | None:
    return None if root is None else fmpq(*float(root).as_integer_ratio())
