"""The least move of two axes in a row that makes three of them meet in one point.

In the first link the axis k + 1 moves, in the second the axis k + 2, each seen from the
axis before it. Let the meeting point W lie at height m over the place of axis k + 1.
Without tilts the first link shifts axis k + 1 by the distance of W from axis k, the
second one axis k + 2 by its distance from W. Both are convex in m, so the larger is
least at the least of one of them or where they are equal. Tilts about the places
help where W is far from these: a tilt by epsilon moves the axis at W by at most epsilon
times its lever, so nothing is nearer by a factor of more than 1 + lever / reach. Where
that is much, tilts are looked for beside m and the height s of W on axis k.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cuspaudit.kinematics.nearest.links import Link, Vector
from cuspaudit.kinematics.nearest.meeting import PREFERRED

__all__ = ["CommonPoint", "concurrent"]

_PARALLEL = 1e-6
_POINTS, _ZOOMS, _BISECTIONS = 4, 12, 20

Heights = float | Vector


@dataclass(frozen=True, eq=False)
class CommonPoint:
    """Two links whose three axes meet in one point, at which their steps are 0.

    Attributes:
        lengths: the shifts of the second and of the third axis, in the chain's unit.
        angles: their tilts, in rad.
        first: the link of the first two axes.
        second: the link of the last two.
        before: how far along the first axis the point is from its place.
        after: how far along the last axis it is from its place.
    """

    lengths: tuple[float, float]
    angles: tuple[float, float]
    first: Link
    second: Link
    before: float
    after: float

    def size(self, reach: float) -> float:
        """The larger of length over reach and angle."""
        return max(max(self.lengths) / reach, *self.angles)


def concurrent(first: Link, second: Link, reach: float) -> CommonPoint | None:
    """The nearest links whose axes meet in one point.

    None where neighbours are parallel: no shift lets them meet in one point only.
    """
    for link in (first, second):
        if np.linalg.norm(np.cross(link.axis, link.next)) < _PARALLEL:
            return None
    m = _height(first, second)
    s = float((first.step + m * first.next) @ first.axis)
    plain = _meeting(first, second, m, s, (0.0, 0.0))
    lever = max(abs(m), float(np.linalg.norm(m * second.axis - second.step)))
    if PREFERRED * reach > reach + lever or max(plain.lengths) == 0:
        return plain
    m, s = _tilting(first, second, (m, s), max(plain.lengths), reach)
    tilts = _tilts(first, second, m, s, reach)
    mixture = _meeting(first, second, m, s, (float(tilts[0]), float(tilts[1])))
    much = plain.size(reach) > PREFERRED * mixture.size(reach)
    return mixture if much else plain


def _tilting(
    first: Link,
    second: Link,
    start: tuple[float, float],
    width: float,
    reach: float,
) -> tuple[float, float]:
    """Where the larger tilt of `_tilts` is least: ever finer grids."""
    (m, s), grid = start, np.linspace(-1, 1, 2 * _POINTS + 1)
    for _ in range(_ZOOMS):
        heights, others = m + width * grid[:, None], s + width * grid[None, :]
        tilts = np.maximum(*_tilts(first, second, heights, others, reach))
        i, j = np.unravel_index(int(np.argmin(tilts)), tilts.shape)
        m, s = float(heights[i, 0]), float(others[0, j])
        width /= 2.5
    return m, s


def _height(first: Link, second: Link) -> float:
    """The m at which the larger distance from the two other axes is least."""
    # the square of each is a m^2 + 2 b m + c; the axis between is in a frame of each
    u, p = (np.cross(x, first.axis) for x in (first.next, first.step))
    v, q = (np.cross(x, second.next) for x in (second.axis, -second.step))
    a, b, c = float(u @ u), float(u @ p), float(p @ p)
    d, e, f = float(v @ v), float(v @ q), float(q @ q)
    equal = np.roots([a - d, 2 * (b - e), c - f])
    candidates = [-b / a, -e / d, *equal[np.isreal(equal)].real]
    return float(
        min(
            candidates,
            key=lambda m: max((a * m + 2 * b) * m + c, (d * m + 2 * e) * m + f),
        )
    )


def _tilts(
    first: Link, second: Link, m: Heights, s: Heights, reach: float
) -> tuple[Vector, Vector]:
    """The least tilt of each link that leaves a shift of at most that times the reach.

    The point is at height ``m`` on the axis between and at ``s`` on the first; arrays
    are taken entry by entry. A tilt of axis k + 1 turns the point at ``m`` towards the
    other point, on a circle; one of axis k + 2 brings it nearer to the point.
    """
    m, s = np.asarray(m, dtype=float), np.asarray(s, dtype=float)
    side = np.where(m < 0, -1.0, 1.0)
    along = s * float(first.axis @ first.next) - float(first.step @ first.next)
    square = s * s - 2 * s * float(first.axis @ first.step) + first.step @ first.step
    length = np.sqrt(np.maximum(square, 0))
    gap = np.arctan2(np.sqrt(np.maximum(square - along**2, 0)), side * along)
    rise = m * float(second.axis @ second.next) - float(second.step @ second.next)
    whole = m * m - 2 * m * float(second.axis @ second.step) + second.step @ second.step
    far = np.sqrt(np.maximum(whole, 0))
    off = np.arctan2(np.sqrt(np.maximum(whole - rise**2, 0)), np.abs(rise))

    def aside(tilt: Vector) -> Vector:
        sine = np.sin(np.maximum(gap - tilt, 0) / 2)
        square = (length - np.abs(m)) ** 2 + 4 * sine**2 * length * np.abs(m)
        return np.asarray(np.sqrt(square))

    def across(tilt: Vector) -> Vector:
        return np.asarray(far * np.sin(np.maximum(off - tilt, 0)))

    return _balanced(aside, reach), _balanced(across, reach)


def _balanced(left: Callable[[Vector], Vector], reach: float) -> Vector:
    """The tilt that leaves a shift of ``reach`` times itself; shifts fall with it."""
    low = np.zeros(())
    high = left(low) / reach
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        far = left(middle) > reach * middle
        low, high = np.where(far, middle, low), np.where(far, high, middle)
    return high


def _meeting(
    first: Link, second: Link, m: float, s: float, tilts: tuple[float, float]
) -> CommonPoint:
    """The links after both axes are tilted towards the point, and shifted onto it."""
    nothing = np.zeros(3)
    point = s * first.axis - first.step
    between = _tilted(first.next, math.copysign(1.0, m) * point, tilts[0])
    other = m * second.axis - second.step
    towards = math.copysign(1.0, float(other @ second.next)) * other
    last = _tilted(second.next, towards, tilts[1])
    after = float(other @ last)
    shifts = (point - m * between, other - after * last)
    return CommonPoint(
        (float(np.linalg.norm(shifts[0])), float(np.linalg.norm(shifts[1]))),
        tilts,
        first.with_step(nothing, between),
        second.with_step(nothing, last),
        s,
        after,
    )


def _polar(vector: Vector, axis: Vector) -> tuple[float, float]:
    """The length of a vector and its angle with a unit ``axis``."""
    side = float(np.linalg.norm(np.cross(axis, vector)))
    along = float(axis @ vector)
    return math.hypot(side, along), math.atan2(side, along)


def _tilted(axis: Vector, towards: Vector, angle: float) -> Vector:
    """A unit ``axis`` turned by at most ``angle`` to another direction."""
    side = towards - (towards @ axis) * axis
    size = float(np.linalg.norm(side))
    if angle == 0 or size == 0:
        return axis
    angle = min(angle, _polar(towards, axis)[1])
    return np.asarray(math.cos(angle) * axis + math.sin(angle) * side / size)
