"""The plane of joints 2 and 3 of an arm: what the paper's Figure 3 shows.

The aspects as regions, each bounded by the critical curve, with the roadmap in them;
the postures of one value, each in its aspect; the path between two that share one. On
a torus every curve is drawn in all its copies, a full turn apart, that meet the window.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product

import numpy as np

from cuspaudit.algebra.angles import FULL_TURN, shortest_turn
from cuspaudit.cuspidality.surface_path import posture_angles
from cuspaudit.pictures.critical_curve import Band, CurvePiece, bands
from cuspaudit.pictures.joint_surface import Array, JointSurface
from cuspaudit.pictures.limit_lines import limit_sides
from cuspaudit.pictures.value_plane import finite_runs
from cuspaudit.surface.graph_isotop import RoadmapGraph
from cuspaudit.surface.sample_points import Fiber
from cuspaudit.viz.plot.data import Aspect, JointPlane, Window

__all__ = ["joint_plane"]

_STEPS = 500


def joint_plane(
    surface: JointSurface,
    traced: list[tuple[CurvePiece, Array, Array]],
    fiber: Fiber,
    graph: RoadmapGraph,
    path: Array | None,
) -> JointPlane:
    """The plane of joints of ``surface``.

    Args:
        surface: of joints 2 and 3.
        traced: the pieces of the critical curve with `trace` of each.
        fiber: the fiber in focus.
        graph: with its postures placed.
        path: points (y, x) from one of them to another, or None.
    """
    sheet = _Sheet(surface)
    angles = [posture_angles(surface.decision, p) for p in fiber.postures]
    ends = surface.points_at(np.array(angles).reshape(-1, 2))
    numbers = tuple(graph.aspect(posture) + 1 for posture in fiber.postures)
    return JointPlane(
        labels=_labels(surface),
        window=sheet.window,
        is_turn=sheet.is_turn,
        aspects=tuple(_aspects(surface, sheet, graph, ends, numbers)),
        curve=tuple(c for *_, points in traced for c in sheet.copies(points)),
        postures=sheet.home(surface.joint_values(ends)),
        posture_aspects=numbers,
        paths=() if path is None else tuple(sheet.copies(path)),
        limits=tuple(c for s in limit_sides(surface) for c in sheet.copies(s)),
    )


class _Sheet:
    """The window of the drawing, and the copies of curves that meet it."""

    def __init__(self, surface: JointSurface) -> None:
        self._surface = surface
        kinds = [joint.kind for joint in surface.model.joints[1:]]
        self.is_turn = (kinds[0] == "revolute", kinds[1] == "revolute")
        half = [math.pi if turn else surface.reach for turn in self.is_turn]
        self.window: Window = (-half[0], half[0], -half[1], half[1])

    def copies(self, points: Array) -> Iterator[Array]:
        """Joint values of a polyline of points (y, x), a full turn apart."""
        for line in finite_runs(self._surface.joint_values(points)):
            shifts = [
                self._shifts(values, low, high, turn)
                for values, low, high, turn in zip(
                    line.T,
                    self.window[::2],
                    self.window[1::2],
                    self.is_turn,
                    strict=True,
                )
            ]
            for shift in product(*shifts):
                yield line + np.array(shift)

    def home(self, values: Array) -> Array:
        """Joint values with every angle in [-pi, pi)."""
        return np.where(self.is_turn, shortest_turn(values), values)

    @staticmethod
    def _shifts(values: Array, low: float, high: float, turn: bool) -> list[float]:
        if not turn:
            return [0.0]
        first = math.ceil((low - values.max()) / FULL_TURN)
        last = math.floor((high - values.min()) / FULL_TURN)
        return [FULL_TURN * k for k in range(first, last + 1)]


def _aspects(
    surface: JointSurface,
    sheet: _Sheet,
    graph: RoadmapGraph,
    ends: Array,
    numbers: tuple[int, ...],
) -> Iterator[Aspect]:
    strips = surface.decision.roadmap.strips
    parts: dict[int, list[tuple[Band, int]]] = {}
    for band in bands(surface):
        for sign in strips[band.strip].signs:
            number = graph.aspects[band.strip, sign]
            parts.setdefault(number, []).append((band, sign))
    for number, members in sorted(parts.items()):
        regions: list[Array] = []
        lines: list[Array] = []
        places: list[tuple[float, Array]] = []
        sign = members[0][1]
        for band, _ in members:
            base = band.base(_parameters(band))
            low, high = _extent(surface, base, sign)
            regions += sheet.copies(_polygon(low, high, base))
            middle = np.stack([(low + high) / 2, base], axis=1)
            lines += sheet.copies(middle[1:-1])
            places += _places(surface, sheet, low, high, base, ends)
        for end, owner in zip(ends, numbers, strict=True):
            if owner == number + 1:
                lines += sheet.copies(_through(surface, end, sign))
        label = max(places, key=lambda place: place[0])[1]
        yield Aspect(number + 1, sign, tuple(regions), tuple(lines), label)


def _places(
    surface: JointSurface,
    sheet: _Sheet,
    low: Array,
    high: Array,
    base: Array,
    ends: Array,
) -> Iterator[tuple[float, Array]]:
    """Places for a name, with the distance to all that it could cover."""
    home = sheet.home(surface.joint_values(ends))
    left, right, bottom, top = sheet.window
    rows = slice(_STEPS // 60, -_STEPS // 60, _STEPS // 30)
    inside = np.minimum(base - base[0], base[-1] - base)[rows]
    for part in (0.3, 0.42, 0.58, 0.7):
        across = low + part * (high - low)
        points = np.stack([across, base], axis=1)[rows]
        spots = sheet.home(surface.joint_values(points))
        edge = np.minimum(spots - (left, bottom), (right, top) - spots).min(axis=1)
        room = np.minimum(edge, 0.3 * (high - low)[rows])
        room = np.minimum(room, inside)
        for point in home:
            room = np.minimum(room, np.linalg.norm(spots - point, axis=1))
        best = int(np.argmax(room))
        yield float(room[best]), spots[best]


def _parameters(band: Band) -> Array:
    return np.linspace(0, FULL_TURN if band.is_ring else math.pi, _STEPS)


def _extent(surface: JointSurface, base: Array, sign: int) -> tuple[Array, Array]:
    """The ends of the arc of one sign over base coordinates, without a jump."""
    if surface.fiber.kind == "line":
        slope, edge = surface.edges(base)
        edge = np.clip(edge, -surface.reach, surface.reach)
        above = sign * slope > 0
        reach = surface.reach
        return np.where(above, edge, -reach), np.where(above, reach, edge)
    middle, half = surface.arcs(base)
    middle = np.unwrap(middle)
    if sign > 0:
        return middle - half, middle + half
    return middle + half, middle + FULL_TURN - half


def _polygon(low: Array, high: Array, base: Array) -> Array:
    edges = [np.stack([edge, base], axis=1) for edge in (low, high)]
    return np.vstack([edges[0], edges[1][::-1]])


def _through(surface: JointSurface, end: Array, sign: int) -> Array:
    """The arc of the fiber on which a posture lies."""
    (low,), (high,) = _extent(surface, end[1:], sign)
    along = np.linspace(low, high, 60)
    return np.stack([along, np.full_like(along, end[1])], axis=1)


def _labels(surface: JointSurface) -> tuple[str, str]:
    found = []
    for number, joint in enumerate(surface.model.joints[1:], 2):
        unit = "rad" if joint.kind == "revolute" else surface.model.chain.unit
        letter = "θ" if joint.kind == "revolute" else "d"
        name = joint.name.replace("_", " ")
        found.append(f"{letter}{'₂₃'[number - 2]}: {name} ({unit})")
    return found[0], found[1]
