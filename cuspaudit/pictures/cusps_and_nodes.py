"""Cusps and nodes on the traced curve of critical values, and their proved number.

The exact engine counts them; here they are located in floating point. A cusp is where
the map stands still along the critical curve: with T tangent to that curve, dR T lies
on the line that is the image of dR, and changes its direction there. A node is a value
with two different critical postures: the traced curve meets itself.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cuspaudit.count import Count
from cuspaudit.errors import CrossCheckError
from cuspaudit.pictures.critical_curve import CurvePiece
from cuspaudit.pictures.joint_surface import Array, JointSurface

__all__ = ["CriticalPoints", "critical_points"]

_HALVINGS = 60
_NEWTON = 20
_SAME = 1e-6
_STEP = 1e-7
_CLEAR = 0.01  # nearer to a crossing, where T = 0, rounding hides the sign of dR T


@dataclass(frozen=True, eq=False)
class CriticalPoints:
    """Special points of the curve of critical values.

    Attributes:
        cusps: (k, 2) points (y, x) of the surface, one a cusp.
        nodes: (k, 2) values (u, v).
    """

    cusps: Array
    nodes: Array


def critical_points(
    surface: JointSurface,
    traced: list[tuple[CurvePiece, Array, Array]],
    cusps: Count | None,
    nodes: Count | None,
) -> CriticalPoints:
    """Locate cusps and nodes and hold them to their proved numbers.

    Args:
        surface: of joints 2 and 3.
        traced: pieces of the critical curve with `trace` of each; those critical as
            a whole fiber last or absent.
        cusps: the count of the exact engine.
        nodes: likewise; nodes are looked for only when it is proved, because an arm
            may have whole curves of values with two critical postures.

    Raises:
        CrossCheckError: the number found is not the number proved.
    """
    found = _distinct(
        [point for piece, s, _ in traced if piece.band for point in _cusps(piece, s)]
    )
    _hold("cusps", len(found), cusps)
    if nodes is None or not nodes.proved:
        return CriticalPoints(found, np.empty((0, 2)))
    crossings = _distinct(_nodes(surface, traced) + _wall_nodes(surface, traced))
    _hold("nodes", len(crossings), nodes)
    return CriticalPoints(found, crossings)


def _hold(what: str, found: int, proved: Count | None) -> None:
    if proved is not None and proved.proved and found != proved.count:
        raise CrossCheckError(
            f"{found} {what} are on the traced curve of critical values, and "
            f"{proved.count} are proved"
        )


def _cusps(piece: CurvePiece, s: Array) -> list[Array]:
    """The points where the curve of values turns back, by bisection in s."""
    if not piece.is_closed:
        s = s[(s > piece.start + _CLEAR) & (s < piece.stop - _CLEAR)]
    motion, line = _motion(piece, s)
    turn = np.cumprod(np.where((line[1:] * line[:-1]).sum(axis=1) < 0, -1, 1))
    line[1:] *= turn[:, None]
    forward = (motion * line).sum(axis=1) >= 0
    found = []
    for i in np.flatnonzero(forward[1:] != forward[:-1]):
        low, high = s[i], s[i + 1]
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            at = _motion(piece, np.array([middle]))[0][0]
            if (at @ line[i] >= 0) == forward[i]:
                low = middle
            else:
                high = middle
        found.append(piece.points(np.array([low]))[0])
    return found


def _motion(piece: CurvePiece, s: Array) -> tuple[Array, Array]:
    """(dR T, a unit vector of the image of dR) at s, (m, 2) each."""
    by_y, by_x = np.moveaxis(piece.surface.slopes(piece.points(s)), 1, 0)
    motion = by_y[:, :1] * by_x[:, 1:] - by_x[:, :1] * by_y[:, 1:]
    size_y, size_x = (np.linalg.norm(by[:, 1:], axis=1) for by in (by_y, by_x))
    line = np.where((size_y > size_x)[:, None], by_y[:, 1:], by_x[:, 1:])
    norm = np.maximum(size_y, size_x)[:, None]
    return motion, np.divide(line, norm, out=np.zeros_like(line), where=norm > 0)


def _nodes(
    surface: JointSurface, traced: list[tuple[CurvePiece, Array, Array]]
) -> list[Array]:
    starts, ends, owners = [], [], []
    for number, (_, s, points) in enumerate(traced):
        plane = surface.plane(surface.values(points))
        if np.ptp(plane, axis=0).max() < _SAME:
            continue
        starts.append(plane[:-1])
        ends.append(plane[1:])
        owners += [(number, s[i], s[i + 1]) for i in range(len(s) - 1)]
    if not owners:
        return []
    found = []
    for i, j in _crossings(np.vstack(starts), np.vstack(ends)):
        value = _refine(traced, owners[i], owners[j])
        if value is not None:
            found.append(value)
    return found


def _crossings(a: Array, b: Array) -> list[tuple[int, int]]:
    """Pairs of segments a_i b_i that cross, by a sweep along the first axis."""
    low, high = np.minimum(a, b), np.maximum(a, b)
    order = np.argsort(low[:, 0])
    last = np.searchsorted(low[order, 0], high[order, 0], side="right")
    count = np.maximum(last - np.arange(len(order)) - 1, 0)
    i = np.repeat(np.arange(len(order)), count)
    j = i + 1 + np.arange(len(i)) - np.repeat(np.cumsum(count) - count, count)
    i, j = order[i], order[j]
    near = (low[i, 1] <= high[j, 1]) & (low[j, 1] <= high[i, 1])
    i, j = i[near], j[near]
    apart = (_side(a[i], b[i], a[j]) * _side(a[i], b[i], b[j]) < 0) & (
        _side(a[j], b[j], a[i]) * _side(a[j], b[j], b[i]) < 0
    )
    return list(zip(i[apart].tolist(), j[apart].tolist(), strict=True))


def _side(a: Array, b: Array, point: Array) -> Array:
    (x, y), (p, q) = (b - a).T, (point - a).T
    return np.asarray(x * q - y * p)


def _refine(
    traced: list[tuple[CurvePiece, Array, Array]],
    first: tuple[int, float, float],
    second: tuple[int, float, float],
) -> Array | None:
    """The common value of two critical postures that differ, by Newton's method."""
    curves = [traced[number][0] for number, *_ in (first, second)]
    s = np.array([(low + high) / 2 for _, low, high in (first, second)])

    def value(curve: CurvePiece, at: float) -> Array:
        return np.asarray(curve.surface.values(curve.points(np.array([at])))[0])

    for _ in range(_NEWTON):
        here = [value(curve, at) for curve, at in zip(curves, s, strict=True)]
        slope = [
            (value(curve, at + _STEP) - value(curve, at - _STEP)) / (2 * _STEP)
            for curve, at in zip(curves, s, strict=True)
        ]
        J = np.column_stack([slope[0], -slope[1]])
        s = s - np.linalg.lstsq(J, here[0] - here[1], rcond=None)[0]
    p, q = (c.points(np.array([at]))[0] for c, at in zip(curves, s, strict=True))
    gap = value(curves[0], s[0]) - value(curves[1], s[1])
    if np.abs(gap).max() > _SAME or np.abs(np.sin((p - q) / 2)).max() < _SAME:
        return None
    return value(curves[0], s[0])


def _wall_nodes(
    surface: JointSurface, traced: list[tuple[CurvePiece, Array, Array]]
) -> list[Array]:
    """Values of wholly critical fibers with one value, where two branches meet."""
    road = surface.decision.roadmap
    found = []
    for index, root in road.walls.items():
        wall = surface.base_at(root)
        fiber = next(
            p for piece, _, p in traced if piece.wall == wall and not piece.band
        )
        values = surface.values(fiber)
        beside = (road.strips[index], road.strips[(index + 1) % len(road.strips)])
        if np.ptp(values, axis=0).max() < _SAME and all(
            len(strip.signs) == 2 for strip in beside
        ):
            found.append(values[0])
    return found


def _distinct(points: list[Array]) -> Array:
    kept: list[Array] = []
    for point in points:
        if all(np.abs(point - other).max() > 10 * _SAME for other in kept):
            kept.append(point)
    return np.array(kept).reshape(-1, 2)
