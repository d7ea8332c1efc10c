"""The critical curve and the curve of critical values, traced strip by strip.

Over a strip of the roadmap with both signs the critical curve has two branches, the
ends of the arc {Delta > 0}. Where a zero of D ends the strip and only one sign
passes, the branches meet in a fold; with x = middle - half cos(s) they are then one
smooth curve in s, upper branch for s in (0, pi), lower one for s in (pi, 2 pi). At
other zeros of D the curve crosses itself or meets a fiber that is critical as a
whole, and a piece ends. Points are as exact as doubles are: no grid, no threshold.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import FULL_TURN
from cuspaudit.pictures.joint_surface import Array, JointSurface

__all__ = ["Band", "CurvePiece", "bands", "pieces", "trace", "wall_pieces"]

_STEPS = 360
_ROUNDS = 7
_END = 1e-4  # a piece stops so far, in s, from where it meets another
_FROM = 0.123  # a closed piece starts where no symmetry puts a special point


@dataclass(frozen=True)
class Band:
    """The interval of the base that carries one strip of the roadmap.

    Attributes:
        strip: its number; on a circle the last strip is part of strip 0.
        low: base coordinate of its left end.
        high: of its right end.
        folds: whether the two branches meet in a fold at either end.
        is_ring: whether it is the whole base circle.
    """

    strip: int
    low: float
    high: float
    folds: tuple[bool, bool] = (False, False)
    is_ring: bool = False

    def base(self, s: Array) -> Array:
        """The base coordinate at parameter s."""
        if self.is_ring:
            return self.low + s
        middle, half = (self.low + self.high) / 2, (self.high - self.low) / 2
        return np.asarray(middle - half * np.cos(s))


@dataclass(frozen=True)
class CurvePiece:
    """A smooth piece of the critical curve, a function of s in [start, stop].

    Attributes:
        surface: where it lies.
        band: the strip over which it lies; None for a fiber critical as a whole.
        start: of s.
        stop: of s.
        side: +1 or -1 for one branch, 0 for both in turn (see the module).
        wall: base coordinate of the fiber that is critical as a whole.
    """

    surface: JointSurface
    band: Band | None
    start: float
    stop: float
    side: int = 0
    wall: float = 0.0

    def points(self, s: Array) -> Array:
        """Points (y, x), (m, 2); y is not reduced modulo a turn, but may jump by it."""
        if self.band is None:
            return np.stack([s, np.full_like(s, self.wall)], axis=1)
        base = self.band.base(s)
        if self.surface.fiber.kind == "line":
            return np.stack([self.surface.edges(base)[1], base], axis=1)
        middle, half = self.surface.arcs(base)
        side = self.side or np.where(np.sin(s) >= 0, 1, -1)
        return np.stack([middle + side * half, base], axis=1)

    @property
    def is_closed(self) -> bool:
        """Whether its two ends are one point."""
        band = self.band
        return band is None or band.is_ring or all(band.folds)


def bands(surface: JointSurface) -> list[Band]:
    """The intervals of the base between zeros of D, each once round a circle."""
    road = surface.decision.roadmap
    at = [surface.base_at(root) for root in road.critical]
    if road.is_closed:
        if not at:
            return [Band(0, -math.pi, math.pi, is_ring=True)]
        ends = [*at, at[0] + FULL_TURN]
        numbers = [*range(1, len(at)), 0]
    else:
        ends = [-surface.reach, *at, surface.reach]
        numbers = list(range(len(road.strips)))
    signs = [road.strips[number].signs for number in numbers]
    found = []
    for i, (number, (low, high)) in enumerate(
        zip(numbers, pairwise(ends), strict=True)
    ):
        folds = [False, False]
        if surface.fiber.kind == "circle":
            inner = road.is_closed or i > 0
            folds[0] = inner and len(signs[i - 1]) == 1
            inner = road.is_closed or i + 1 < len(numbers)
            folds[1] = inner and len(signs[(i + 1) % len(signs)]) == 1
        found.append(Band(number, low, high, (folds[0], folds[1])))
    return found


def pieces(surface: JointSurface) -> list[CurvePiece]:
    """The critical curve, without the fibers that are critical as a whole."""
    found: list[CurvePiece] = []
    for band in bands(surface):
        if len(surface.decision.roadmap.strips[band.strip].signs) == 2:
            found += (
                CurvePiece(surface, band, *span) for span in _spans(surface, band)
            )
    return found


def wall_pieces(surface: JointSurface) -> list[CurvePiece]:
    """The fibers on which Delta vanishes as a whole."""
    reach = math.pi if surface.fiber.kind == "circle" else surface.reach
    return [
        CurvePiece(surface, None, -reach, reach, 0, surface.base_at(root))
        for root in surface.decision.roadmap.walls.values()
    ]


def trace(piece: CurvePiece) -> tuple[Array, Array]:
    """Parameters s and points (y, x), close enough for a smooth drawing.

    Steps are halved until they are small in the plane of values as well. Angles run on
    without a jump; points out of reach on a line are nan.
    """
    surface = piece.surface
    s = np.linspace(piece.start, piece.stop, _STEPS + 1)
    for _ in range(_ROUNDS):
        points = _drawable(surface, piece.points(s))
        far = _far(points, 0.04) | _far(surface.plane(surface.values(points)), None)
        if not far.any():
            break
        s = np.sort(np.concatenate([s, (s[:-1] + s[1:])[far] / 2]))
    return s, _drawable(surface, piece.points(s))


def _spans(surface: JointSurface, band: Band) -> Iterator[tuple[float, float, int]]:
    if surface.fiber.kind == "line":
        yield _END, math.pi - _END, 0
    elif band.is_ring:
        yield _FROM, _FROM + FULL_TURN, 1
        yield _FROM, _FROM + FULL_TURN, -1
    elif all(band.folds):
        yield _FROM, _FROM + FULL_TURN, 0
    elif band.folds[0]:
        yield _END - math.pi, math.pi - _END, 0
    elif band.folds[1]:
        yield _END, FULL_TURN - _END, 0
    else:
        yield _END, math.pi - _END, 0
        yield math.pi + _END, FULL_TURN - _END, 0


def _far(points: Array, limit: float | None) -> NDArray[np.bool_]:
    """Which steps are longer than ``limit``, by default 1/300 of the whole extent."""
    steps = np.abs(np.diff(points, axis=0)).max(axis=1)
    if limit is None:
        finite = points[np.isfinite(points).all(axis=1)]
        limit = float(np.ptp(finite, axis=0).max()) / 300 if len(finite) else 1.0
    return np.asarray(steps > max(limit, 1e-12))


def _drawable(surface: JointSurface, points: Array) -> Array:
    points = points.copy()
    if surface.fiber.kind == "circle":
        points[:, 0] = np.unwrap(points[:, 0])
    else:
        points[np.abs(points[:, 0]) > surface.reach] = np.nan
    return points
