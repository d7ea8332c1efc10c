"""Certified continuation of a point of V along a path of values of R.

Where Delta != 0 on V, R is a local diffeomorphism: a point of V over y_0 continues in
one way over a path of values, as long as the path of points stays away from {Delta =
0}. Each step is one Krawczyk test over a whole segment of values
(``geometry.lifts.lifting``), which proves existence, uniqueness and Delta != 0
together; the next step begins at the point over the shared value, known to lie in both
boxes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

from flint import arb, ctx, fmpq

from cuspaudit.algebra.evaluation import Differentiable
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import NotSquareError
from cuspaudit.geometry.lifts.lifting import Box, Chart, Lift, lift, sharpen
from cuspaudit.runtime.clock import check_time

__all__ = ["Continuation", "continue_point", "follow", "square_chart"]

#: working precision
BITS = 106
#: the part of a segment below which a step is given up
SMALLEST_STEP = fmpq(1, 2**40)
_MOST_STEPS = 2000


@dataclass(frozen=True)
class Continuation:
    """The lift of a path of values, proved.

    Attributes:
        steps: lifts of consecutive segments, each linked to the next: the point of V
            over the value they share lies in both boxes.
        points: for every way point of the path, a small box with the point of V that
            the start was continued to.
    """

    steps: tuple[Lift, ...]
    points: tuple[Box, ...]

    @property
    def boxes(self) -> tuple[Box, ...]:
        """Boxes that cover the path on V, in order; Delta != 0 on each."""
        return tuple(step.image for step in self.steps)

    @property
    def end(self) -> Box:
        """The point over the last value."""
        return self.points[-1]


def continue_point(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    start: Sequence[arb],
    path: Sequence[Sequence[fmpq]],
) -> Continuation | None:
    """Continue a point of V along straight segments of values of R.

    Guarantee, when the result is not None: at most one point of V over ``path[0]``
    lies in ``start`` (exactly one when V has n - d equations; else the caller claims
    it), it continues over the whole path, and Delta != 0 all along.

    Args:
        variety: V = {f = 0} in R^n of dimension d under assumption (A) of the paper,
            not checked. Of more than n - d equations, n - d are chosen whose
            Jacobian matrix with R is regular at ``start``. Their zero set is a
            manifold of dimension d wherever a step holds, so near a point of V it
            is V, and the path does not leave V.
        mapping: R = (r_1, ..., r_d).
        start: balls in ring order around one point of V over ``path[0]``.
        path: y_0, y_1, ..., y_m in Q^d.

    Returns:
        The lift, or None when the proof stops (the path comes near a singularity, or
        ``start`` is too wide).
    """
    with ctx.workprec(BITS):
        chart = square_chart(variety, mapping, start)
        if chart is None:
            return None
        values = [tuple(map(arb, y)) for y in path]
        found = lift(chart, start, values[0], start)
        if found is None or not found.holds(values[0], start):
            return None
        steps, points = list[Lift](), [found.image]
        for y0, y1 in pairwise(values):
            leg = follow(chart, points[-1], y0, y1)
            if leg is None:
                return None
            steps += leg.steps
            points.append(leg.end)
    return Continuation(tuple(steps), tuple(points))


def follow(
    chart: Chart,
    start: Box,
    y0: Box,
    y1: Box,
    accept: Callable[[Lift, Box, Box], bool] = lambda step, begin, change: True,
    smallest: fmpq = SMALLEST_STEP,
) -> Continuation | None:
    """Continue along one segment of values, at the working precision.

    Steps are halved until the test holds; two that hold in a row are doubled.

    Args:
        chart: F = (f, g), whose coordinates stand for R.
        start: a box with a point of V.
        y0: its values, where the segment begins; d balls.
        y1: where it ends.
        accept: what else has to be proved on a step for it to count, given the
            lift, the box where it begins and the change of the values.
        smallest: the part of the segment below which a step is given up.
    """
    at, size, grow = fmpq(0), fmpq(1), True
    point, here, steps = start, y0, list[Lift]()
    while at < 1 and len(steps) < _MOST_STEPS:
        check_time("continuation")
        step = min(size, 1 - at)
        there = y1 if at + step == 1 else _between(y0, y1, at + step)
        done = _step(chart, point, here, there)
        change = tuple(b - a for a, b in zip(here, there, strict=True))
        if done is None or not accept(done[0], point, change):
            size, grow = step / 2, False
            if size < smallest:
                return None
            continue
        steps.append(done[0])
        point, here, at = done[1], there, at + step
        size, grow = (2 * step if grow else step), True
    return Continuation(tuple(steps), (start, point)) if at == 1 else None


def square_chart(
    variety: PolynomialSystem, mapping: PolynomialMap, point: Sequence[arb]
) -> Chart | None:
    """(f', R) with f' the n - d equations that make its Jacobian most regular.

    Returns:
        None when no choice of equations is proved regular at ``point``.

    Raises:
        NotSquareError: fewer than n - d equations.
    """
    ring, size = variety.ring, len(variety.ring.variables)
    need = size - len(mapping.components)
    if len(variety.equations) < need:
        rows = len(variety.equations) + len(mapping.components)
        raise NotSquareError(rows=rows, variables=size)
    coordinates = Differentiable(ring, mapping.components)
    candidates = (
        Chart(Differentiable(ring, chosen), coordinates)
        for chosen in combinations(variety.equations, need)
    )
    ranked = [(abs(c.jacobian(point).det()).lower(), c) for c in candidates]
    best, chart = max(ranked, key=lambda pair: pair[0])
    return chart if best > 0 else None


def _step(chart: Chart, point: Box, here: Box, there: Box) -> tuple[Lift, Box] | None:
    """The lift of one segment that holds ``point``, and the point at its end."""
    values = tuple(a.union(b) for a, b in zip(here, there, strict=True))
    found = lift(chart, point, values, point)
    if found is None or not found.holds(here, point):
        return None
    end = sharpen(chart, found, there)
    return None if end is None else (found, end)


def _between(y0: Box, y1: Box, t: fmpq) -> Box:
    return tuple(a + t * (b - a) for a, b in zip(y0, y1, strict=True))
