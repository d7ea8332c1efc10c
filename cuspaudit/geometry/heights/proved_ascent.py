"""Ascents that are proved to stay above a level and to end at a maximum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from flint import arb, ctx
from numpy.typing import NDArray

from cuspaudit.geometry.heights.ascent import climb
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.geometry.heights.morse import Basin, middle
from cuspaudit.geometry.heights.proved_path import follow_places
from cuspaudit.geometry.lifts.continuation import BITS
from cuspaudit.geometry.lifts.lifting import Box, Lift

__all__ = ["Ascent", "prove_ascent"]

Array = NDArray[np.float64]

_REACHES = (0.9, 0.5, 0.2, 0.05)


@dataclass(frozen=True, eq=False)
class Ascent:
    """A proved way to a maximum.

    Attributes:
        top: the number of the maximum among the basins.
        steps: boxes that cover the way up to its basin.
        places: (m, n) way points on it, in doubles; the last is the maximum.
        level: G where it begins, in doubles.
    """

    top: int
    steps: tuple[Lift, ...]
    places: Array
    level: float

    def after(self, step: Lift, place: Array) -> Ascent:
        """The same ascent with a step before it that begins at ``place``."""
        places = np.concatenate([place[None, :], self.places])
        return replace(self, steps=(step, *self.steps), places=places)


def prove_ascent(
    landscape: ChartedHeight,
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


def _prove(
    landscape: ChartedHeight,
    start: Box,
    level: arb | None,
    basins: Sequence[Basin],
    places: Array,
) -> Ascent | None:
    distances = [np.abs(b.top.place - places[-1]).max() for b in basins]
    top = int(np.argmin(distances))
    legs = follow_places(landscape, start, places, basins[top].holds, level)
    if legs is None:
        return None
    way = [middle(start), *(middle(leg.end) for leg in legs), basins[top].top.place]
    steps = tuple(step for leg in legs for step in leg.steps)
    return Ascent(top, steps, np.array(way), landscape.value_at(middle(start)))
