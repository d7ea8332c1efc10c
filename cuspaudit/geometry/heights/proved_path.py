"""Proof that there is a path on V - {Delta = 0} along proposed way points.

The way is cut into legs, each a straight segment in the tangent chart of the point
where it begins, lifted to V by Krawczyk steps. On a step P != 0, and G stays above a
level where one is given, if the enclosure of G over its box says so, or its Taylor
enclosure (``geometry.heights.segment``).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from flint import arb, ctx, fmpq
from numpy.typing import NDArray

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.geometry.heights.height import plain_height
from cuspaudit.geometry.heights.morse import middle
from cuspaudit.geometry.heights.segment import segment
from cuspaudit.geometry.lifts.continuation import (
    BITS,
    SMALLEST_STEP,
    Continuation,
    follow,
)
from cuspaudit.geometry.lifts.lifting import Box, Lift, contains

__all__ = ["follow_places", "prove_path"]

Array = NDArray[np.float64]

_LEAP = fmpq(1, 4)


def prove_path(
    variety: PolynomialSystem,
    dimension: int,
    minors: Sequence[Polynomial],
    first: Box,
    places: Array,
    last: Box,
) -> tuple[Box, ...] | None:
    """Prove a path on V where not all ``minors`` vanish, along way points.

    Guarantee: the one point of V in ``first`` and the one in ``last`` are joined by a
    path on V inside the boxes returned; on each box some minor has no zero on V. That
    ``first`` and ``last`` hold points of V is the caller's claim.

    Args:
        variety: V = {f = 0} under assumption (A), not checked.
        dimension: d.
        minors: those of ``crit``.
        first: a small box with a point of V.
        places: (m, n) points close to V, from ``first`` to ``last``.
        last: a small box with a point of V.

    Returns:
        Boxes that cover the path, in order, or None when it could not be proved.
    """
    landscape = ChartedHeight(variety, dimension, plain_height(variety.ring, minors))
    with ctx.workprec(BITS):
        legs = follow_places(landscape, first, places)
        if legs is None:
            return None
        here = legs[-1].end if legs else first
        closing = _leg(landscape, here, last, None, True)
    # T last is the end of the values lifted: in X there is one point over it
    if closing is None or not contains(closing.steps[-1].box, last):
        return None
    return tuple(box for leg in (*legs, closing) for box in leg.boxes)


def follow_places(
    landscape: ChartedHeight,
    start: Box,
    places: Array,
    done: Callable[[Box], bool] | None = None,
    level: arb | None = None,
) -> tuple[Continuation, ...] | None:
    """Legs along ``places`` from a point of V, all of them or until ``done`` holds.

    Guarantee: P != 0 on every box, and G > ``level`` if it is so at ``start``.

    Args:
        landscape: V and G.
        start: a box with a point of V.
        places: (m, n) points close to V, the first close to ``start``.
        done: a proved property of the box where a leg ends.
        level: a level of G, or None.

    Returns:
        The legs, or None when one cannot be proved or ``done`` never holds.
    """
    legs, here, at = list[Continuation](), start, 0
    last = len(places) - 1
    stride = max(last, 1)
    while done is None or not done(here):
        if at == last:
            return tuple(legs) if done is None else None
        stride = min(stride, last - at)
        target = tuple(arb(float(x)) for x in places[at + stride])
        leg = _leg(landscape, here, target, level, stride == 1)
        if leg is None and stride == 1:
            return None
        if leg is None:
            stride = stride // 2
            continue
        legs.append(leg)
        here, at, stride = leg.end, at + stride, 2 * stride
    return tuple(legs)


def _leg(
    landscape: ChartedHeight, here: Box, target: Box, level: arb | None, patient: bool
) -> Continuation | None:
    """A straight segment in the chart of ``here`` that ends close to ``target``."""
    tangent, place = landscape.tangent(middle(here)), middle(target)
    along = tangent.forms.matrix @ (place - middle(here))
    tangent = landscape.aligned(tangent, along)
    y0 = tuple(tangent.forms.values(here))
    y1 = tuple(tangent.forms.values(target))

    def accept(step: Lift, begin: Box, change: Box) -> bool:
        height = landscape.height.value(step.image)
        if height is not None and (level is None or height > level):
            return True
        found = segment(landscape, tangent, begin, step.image, change)
        return found is not None and (level is None or found.is_above(level))

    smallest = SMALLEST_STEP if patient else _LEAP
    leg = follow(tangent.chart, here, y0, y1, accept, smallest)
    if leg is None:
        return None
    missed = np.abs(middle(leg.end) - place).max()
    return leg if missed < 1e-6 * (1 + np.abs(place).max()) else None
