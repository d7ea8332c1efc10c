"""A path between the two postures of a couple, along the roadmap.

In floating point: the path is a proposal, and a certificate proves it. It follows the
roadmap: along the fiber from the first posture to the silhouette, along the silhouette
through the strips that connect the two, along the fiber to the second posture. Where
a straight stretch keeps well inside the aspect it replaces the detour, so that a
person can watch the result.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import beside
from cuspaudit.algebra.numeric import NumericPolynomial, numeric_values
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.surface.sample_points import FiberPosture
from cuspaudit.surface.surface import Factor, Surface

__all__ = [
    "SignedDelta",
    "SurfacePath",
    "is_swapped",
    "posture_angles",
    "propose_path",
    "propose_paths",
    "resampled",
    "shortened",
]

Array = NDArray[np.float64]
if TYPE_CHECKING:
    from cuspaudit.cuspidality.pair_decision import PairCouple, PairDecision, PairEnd
    from cuspaudit.cuspidality.surface_decision import SurfaceCouple, SurfaceDecision

    Decided = SurfaceDecision | PairDecision
    Couple = SurfaceCouple | PairCouple
_BITS = 128
_STEPS = 120
_KEPT = 0.7
_GRID = 181


@dataclass(frozen=True)
class SurfacePath:
    """A path on V between the postures of a couple.

    Attributes:
        points: (m, 2) way points, in the order of V's factors in the ring: angles in
            rad on a circle, coordinates on a line. Not reduced modulo 2 pi.
        sign: the sign of Delta along it.
        first: |Delta| at the first way point.
        smallest: the smallest sampled |Delta| along it.
        largest: the largest sampled |Delta| on V; inf when V is not compact.
    """

    points: Array
    sign: int
    first: float
    smallest: float
    largest: float

    @property
    def clearance(self) -> float:
        """The smallest over the largest |Delta|, in [0, 1]."""
        return self.smallest / self.largest


def propose_paths(decision: Decided) -> Iterator[SurfacePath]:
    """A path for every couple, those that stand farthest from the singular set first.

    The two ends bound how far from it a path can keep.
    """
    land = SignedDelta(decision.surface, decision.delta, 1)

    def height(couple: Couple) -> float:
        ends = np.array([_angles(decision.surface, p) for p in couple.postures])
        return float(np.abs(land.height(ends)).min())

    for couple in sorted(decision.couples, key=height, reverse=True):
        yield propose_path(decision, couple)


def posture_angles(decision: SurfaceDecision, posture: FiberPosture) -> Array:
    """The coordinates of a posture as in `SurfacePath.points`."""
    pair = _angles(decision.surface, posture)
    return pair[::-1] if is_swapped(decision.surface) else pair


def propose_path(decision: Decided, couple: Couple) -> SurfacePath:
    """A path joining the couple inside its aspect, as far as sampling can tell."""
    land = SignedDelta(decision.surface, decision.delta, couple.sign)
    path = land.follow(decision, couple)
    smallest = land.height(resampled(path)).min()
    keep = _KEPT * min(smallest, *land.height(path[[0, -1]]))
    path = shortened(path, lambda piece: land.height(resampled(piece)).min() >= keep)
    smallest = float(land.height(resampled(path)).min())
    order = [1, 0] if is_swapped(land.surface) else [0, 1]
    first = float(land.height(path[:1])[0])
    return SurfacePath(path[:, order], couple.sign, first, smallest, land.largest)


class SignedDelta:
    """sign * Delta on V in floating point; points are (fiber, base) pairs."""

    def __init__(self, surface: Surface, delta: Polynomial, sign: int) -> None:
        self.surface = surface
        self.delta = NumericPolynomial(surface.ring, sign * delta)
        parts = surface.affine_parts(sign * delta)
        assert parts is not None, "orient chose the fiber so"
        self.parts = parts

    def variables(self, points: Array) -> Array:
        """The coordinates of R^n, in ring order, of (m, 2) points."""
        columns: dict[str, Array] = {}
        for factor, values in zip(
            (self.surface.fiber, self.surface.base), points.T, strict=True
        ):
            if factor.kind == "line":
                columns[factor.names[0]] = values
            else:
                columns[factor.names[0]] = np.cos(values)
                columns[factor.names[1]] = np.sin(values)
        return np.stack([columns[n] for n in self.surface.ring.variables], axis=1)

    def height(self, points: Array) -> Array:
        """Sign * Delta at (m, 2) points."""
        return self.delta(self.variables(points))

    @property
    def largest(self) -> float:
        """The largest sampled |Delta| on V."""
        if "line" in (self.surface.fiber.kind, self.surface.base.kind):
            return math.inf
        angles = np.linspace(-np.pi, np.pi, _GRID)
        grid = np.stack(np.meshgrid(angles, angles), axis=-1).reshape(-1, 2)
        return float(np.abs(self.height(grid)).max())

    def silhouette(self, base: Array) -> Array:
        """The fiber coordinate of the middle of the arc over each base coordinate."""
        points = np.stack([np.zeros_like(base), base], axis=1)
        values = numeric_values(self.surface.ring, self.parts, self.variables(points))
        if self.surface.fiber.kind == "circle":
            return np.unwrap(np.arctan2(values[:, 1], values[:, 0]))
        slope, constant = values.T
        steep = np.abs(slope) > 1e-9
        reach = np.where(steep, -constant / np.where(steep, slope**2, 1.0), 0.0)
        return np.asarray(slope * (max(float(reach.max()), 0.0) + 1.0))

    def follow(self, decision: Decided, couple: Couple) -> Array:
        """The path along the roadmap."""
        start, goal = (_angles(self.surface, p) for p in couple.postures)
        turns = decision.graph.turns(*couple.postures)
        base = np.linspace(start[1], goal[1] + 2 * np.pi * turns, _STEPS)
        middle = self.silhouette(base)
        if self.surface.fiber.kind == "circle":
            start[:1] = beside(start[:1], middle[:1])
            goal[:1] = beside(goal[:1], middle[-1:])
        along = np.stack([middle, base], axis=1)
        last = np.array([goal[0], base[-1]])
        return np.vstack([start, along, last])


def is_swapped(surface: Surface) -> bool:
    """Whether the fiber comes after the base in the ring's order."""
    place = surface.ring.variables.index
    return place(surface.fiber.names[0]) > place(surface.base.names[0])


def _angles(surface: Surface, posture: FiberPosture | PairEnd) -> Array:
    """The (fiber, base) coordinates of a posture, angles in (-pi, pi] of the chart."""
    y, x = (float(ball.mid()) for ball in posture.chart(_BITS))
    return np.array([_angle(surface.fiber, y), _angle(surface.base, x)])


def _angle(factor: Factor, t: float) -> float:
    """The angle (or coordinate) at chart coordinate ``t``, increasing in t."""
    if factor.kind == "line":
        return t
    c, s = (float(int(v.p) / int(v.q)) for v in factor.rotation)
    return math.atan2(s, c) + 2 * math.atan(t)


def resampled(path: Array, density: float = 0.01) -> Array:
    """The way points with points between them, at most ``density`` apart."""
    pieces = [path[:1]]
    for a, b in pairwise(path):
        count = max(int(np.abs(b - a).max() / density), 1)
        steps = np.linspace(0, 1, count + 1)[1:, None]
        pieces.append(a + steps * (b - a))
    return np.vstack(pieces)


def shortened(path: Array, allowed: Callable[[Array], bool]) -> Array:
    """Replace stretches of the path by straight ones wherever ``allowed``."""
    kept, at = [0], 0
    while at < len(path) - 1:
        for ahead in range(len(path) - 1, at, -1):
            if ahead == at + 1 or allowed(path[[at, ahead]]):
                kept.append(ahead)
                at = ahead
                break
    return path[kept]
