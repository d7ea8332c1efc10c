"""Proof that a proposed ascent stays above a level and ends in the basin of a maximum.

The way is cut into legs, each a straight segment in the tangent chart of the point
where it begins, lifted to V by Krawczyk steps. A step stays above the level if the
enclosure of G over its box does, or its Taylor enclosure (``geometry.segment``).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb, ctx, fmpq
from numpy.typing import NDArray

from cuspaudit.geometry.ascent import climb
from cuspaudit.geometry.continuation import BITS, SMALLEST_STEP, Continuation, follow
from cuspaudit.geometry.landscape import Landscape
from cuspaudit.geometry.lifting import Box, Lift
from cuspaudit.geometry.morse import Basin, middle
from cuspaudit.geometry.segment import segment

__all__ = ["Ascent", "prove_ascent", "prove_path"]

Array = NDArray[np.float64]

_REACHES = (0.9, 0.5, 0.2, 0.05)
_LEAP = fmpq(1, 4)


@dataclass(frozen=True, eq=False)
class Ascent:
    """A proved way to a maximum.

    Attributes:
        top: the number of the maximum among the basins.
        steps: boxes that cover the way up to its basin.
        places: (m, n) way points on it, in doubles; the last is the maximum.
    """

    top: int
    steps: tuple[Lift, ...]
    places: Array


def prove_ascent(
    landscape: Landscape,
    start: Box,
    level: arb | None,
    basins: Sequence[Basin],
    seed: int,
) -> Ascent | None:
    """A proved way from a point of V to a maximum; None if every effort fails.

    Args:
        landscape: V and G.
        start: a box with a point of V, and no other that matters.
        level: G stays above it on the way; ``start`` must be above; None for no level.
        basins: of all maxima.
        seed: for the directions in which saddles on the way are left.
    """
    with ctx.workprec(BITS):
        for number, reach in enumerate(_REACHES):
            chance = np.random.default_rng((seed, number))
            places, at_top = climb(landscape, middle(start), reach, chance)
            if at_top:
                found = _prove(landscape, start, level, basins, places)
                if found is not None:
                    return found
    return None


def prove_path(
    landscape: Landscape,
    start: Box,
    places: Array,
    done: Callable[[Box], bool],
    level: arb | None = None,
) -> tuple[Continuation, ...] | None:
    """Legs along ``places`` from a point of V, until ``done`` holds of where one ends.

    Guarantee: P != 0 on every box, and G > ``level`` if it is so at ``start``.

    Args:
        landscape: V and G.
        start: a box with a point of V.
        places: (m, n) points close to V, the first close to ``start``.
        done: a proved property of a box around a point of V.
        level: a level of G, or None.

    Returns:
        The legs, or None when one cannot be proved or ``done`` never holds.
    """
    legs, here, at = list[Continuation](), start, 0
    last = len(places) - 1
    stride = max(last, 1)
    while not done(here):
        if at == last:
            return None
        stride = min(stride, last - at)
        leg = _leg(landscape, here, places[at + stride], level, stride == 1)
        if leg is None and stride == 1:
            return None
        if leg is None:
            stride = stride // 2
            continue
        legs.append(leg)
        here, at, stride = leg.end, at + stride, 2 * stride
    return tuple(legs)


def _prove(
    landscape: Landscape,
    start: Box,
    level: arb | None,
    basins: Sequence[Basin],
    places: Array,
) -> Ascent | None:
    distances = [np.abs(b.top.place - places[-1]).max() for b in basins]
    top = int(np.argmin(distances))
    legs = prove_path(landscape, start, places, basins[top].holds, level)
    if legs is None:
        return None
    way = [middle(start), *(middle(leg.end) for leg in legs), basins[top].top.place]
    steps = tuple(step for leg in legs for step in leg.steps)
    return Ascent(top, steps, np.array(way))


def _leg(
    landscape: Landscape, here: Box, target: Array, level: arb | None, patient: bool
) -> Continuation | None:
    """A straight segment in the chart of ``here`` that ends close to ``target``."""
    tangent = landscape.tangent(middle(here))
    along = tangent.forms.matrix @ (target - middle(here))
    tangent = landscape.aligned(tangent, along)
    y0 = tuple(tangent.forms.values(here))
    y1 = tuple(tangent.forms.values([arb(float(x)) for x in target]))

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
    missed = np.abs(middle(leg.end) - target).max()
    return leg if missed < 1e-6 * (1 + np.abs(target).max()) else None
