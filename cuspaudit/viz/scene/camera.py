"""Where to stand and what to see: ground, camera, ghosts and the lines in the air."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames
from cuspaudit.viz.scene.arm import bar_ends, elbows, tube_radius, unit_axis
from cuspaudit.viz.scene.motion import PathFrames
from cuspaudit.viz.scene.shapes import Triangles

__all__ = ["Camera", "nice_step", "ring", "tube"]

Matrix = NDArray[np.float64]


class Camera:
    """The drawn arm as points in space, and what follows from them.

    Attributes:
        chain: the robot.
        shown: the postures drawn.
        scale: drawn length of one unit of the chain.
        ground: height of the ground, at the base or below the lowest posture.
        pitch: side of a square of the grid, in the chain's unit.
    """

    def __init__(self, chain: Chain, shown: PathFrames, scale: float) -> None:
        """Place the arm's corners in a few dozen of the postures."""
        self.chain, self.shown, self.scale = chain, shown, scale
        low = float(self._corners[..., 2].min()) - 1.8 * tube_radius(chain, 0)
        self.ground = min(low, -0.055)
        self.pitch = nice_step(0.1 / scale)

    @cached_property
    def _indices(self) -> list[int]:
        count = len(self.shown.postures)
        return sorted({round(x) for x in np.linspace(0, count - 1, min(count, 36))})

    @cached_property
    def _corners(self) -> Matrix:
        """(postures, points, 3) corners of the drawn links."""
        return np.array([self._corners_at(i) for i in self._indices])

    def _corners_at(self, index: int) -> Matrix:
        placed = frames(self.chain, list(self.shown.postures[index]))
        bodies = [np.eye(4), *placed[:-1]]
        points = []
        for body, frame in enumerate(bodies, start=-1):
            local = elbows(self.chain, body, self.scale)
            points.append(local @ frame[:3, :3].T + frame[:3, 3] * self.scale)
        return np.concatenate(points)

    @property
    def _keys(self) -> Matrix:
        """The corners of the postures that are drawn as ghosts."""
        return np.array([self._corners_at(i) for i in self.ghost_indices()])

    def ghost_indices(self) -> list[int]:
        """The postures drawn as ghosts: both ends of a path, or each of a list."""
        count = len(self.shown.postures)
        return [0, count - 1] if self.shown.is_path else list(range(count))

    def ghosts(self, colours: Sequence[str]) -> list[dict[str, Any]]:
        """Each ghost's posture, colour, label, and the point its label stands at."""
        keys, result = self._keys, []
        is_path = self.shown.is_path
        groups = ("A", "B") if is_path else self.shown.groups
        ranks = {group: i for i, group in enumerate(dict.fromkeys(groups))}
        for order, index in enumerate(self.ghost_indices()):
            group = groups[order]
            result.append(
                {
                    "index": index,
                    "colour": colours[ranks[group] % len(colours)],
                    "label": group if is_path else str(order + 1),
                    "group": group,
                    "at": [round(float(x), 4) for x in _loneliest(keys, order)],
                }
            )
        return result

    def fit_points(self) -> Matrix:
        """Points that the first view must hold, with the stand."""
        corners = self._corners.reshape(-1, 3)
        stand = [[x, y, self.ground] for x in (-0.08, 0.08) for y in (-0.08, 0.08)]
        target = self.shown.tips[0, :3, 3] * self.scale
        reach = 0.05 if self.chain.task == "position" else 0.15
        around = target + reach * self.shown.tips[0, :3, :3].T
        points = np.vstack([corners, stand, around, *self._bars()])
        return np.unique(np.round(points, 3), axis=0)

    def _bars(self) -> list[Matrix]:
        """The ends of the bars of prismatic joints, in every posture placed."""
        ends = []
        for body, joint in enumerate(self.chain.joints):
            if joint.kind != "prismatic":
                continue
            low, high = bar_ends(self.shown.postures[:, body] * self.scale, 0.05)
            axis = unit_axis(joint)
            for index in self._indices:
                frame = frames(self.chain, list(self.shown.postures[index]))[body]
                local = np.array([low * axis, high * axis])
                moved = local @ frame[:3, :3].T + frame[:3, 3] * self.scale
                ends.append(moved)
        return ends

    def view_direction(self) -> Matrix:
        """The direction from the arm to a camera that sees it broad and unfolded.

        Of 72 directions from above, the one in which the drawn postures cover much,
        their links look long, and the ghosts stand far from one another.
        """
        keys = self._keys
        best, found = -1.0, np.array([1.0, -1.0, 0.6])
        for elevation in (math.radians(14), math.radians(26)):
            for azimuth in np.radians(np.arange(-180, 180, 10)):
                level = math.cos(elevation)
                toward = np.array(
                    [
                        level * math.cos(azimuth),
                        level * math.sin(azimuth),
                        math.sin(elevation),
                    ]
                )
                score = _breadth(keys, toward)
                if score > best * 1.001:
                    best, found = score, toward
        return found

    def grid(self) -> Matrix:
        """(2k, 3) ends of the lines of a square grid under the arm."""
        reach = float(np.abs(self._corners[..., :2]).max()) + 0.15
        step = self.pitch * self.scale
        count = math.ceil(reach / step)
        edge, ends = count * step, []
        for i in range(-count, count + 1):
            x = i * step
            ends += [[x, -edge, self.ground], [x, edge, self.ground]]
            ends += [[-edge, x, self.ground], [edge, x, self.ground]]
        return np.array(ends)


def nice_step(about: float) -> float:
    """The number 1, 2 or 5 times a power of ten nearest below or at ``about``.

    >>> nice_step(0.07), nice_step(430.0)
    (0.05, 200.0)
    """
    power = 10.0 ** math.floor(math.log10(about))
    step = max(m for m in (1.0, 2.0, 5.0) if m * power <= about * (1 + 1e-9))
    return float(f"{step * power:.6g}")


def tube(points: Matrix, radius: float, sides: int = 8) -> Triangles:
    """A tube along the (m, 3) ``points``, which may close on themselves."""
    directions = np.gradient(points, axis=0)
    lengths = np.linalg.norm(directions, axis=1, keepdims=True)
    directions = directions / np.where(lengths > 0, lengths, 1.0)
    side = np.cross(directions[0], np.eye(3)[int(np.argmin(np.abs(directions[0])))])
    circles = []
    for point, direction in zip(points, directions, strict=True):
        side = side - (side @ direction) * direction
        side = side / (np.linalg.norm(side) or 1.0)
        other = np.cross(direction, side)
        angles = np.linspace(0.0, 2 * math.pi, sides, endpoint=False)
        circle = np.outer(np.cos(angles), side) + np.outer(np.sin(angles), other)
        circles.append(point + radius * circle)
    faces = []
    for i in range(len(points) - 1):
        for j in range(sides):
            a, b = i * sides + j, i * sides + (j + 1) % sides
            faces += [[a, b, a + sides], [b, b + sides, a + sides]]
    return Triangles(np.concatenate(circles), np.array(faces, dtype=np.int64))


def ring(axis: Matrix, radius: float, thickness: float) -> Triangles:
    """A ring about the origin, square to a coordinate ``axis``."""
    first, second = np.roll(axis, 1), np.roll(axis, 2)
    angles = np.linspace(0.0, 2 * math.pi, 49)
    points = np.outer(np.cos(angles), first) + np.outer(np.sin(angles), second)
    return tube(radius * points, thickness)


def _loneliest(keys: Matrix, order: int) -> Matrix:
    """The corner of one ghost that stands furthest from every other ghost."""
    others = np.delete(keys, order, axis=0).reshape(-1, 3)
    own = keys[order]
    if not len(others):
        return np.asarray(own[len(own) // 2])
    gaps = np.linalg.norm(own[:, None] - others[None], axis=2).min(axis=1)
    return np.asarray(own[int(np.argmax(gaps))])


def _breadth(keys: Matrix, toward: Matrix) -> float:
    right = np.cross([0.0, 0.0, 1.0], toward)
    right /= np.linalg.norm(right)
    screen = keys @ np.column_stack([right, np.cross(toward, right)])
    flat = screen.reshape(-1, 2)
    area = math.sqrt(max(0.0, float(np.linalg.det(np.cov(flat.T)))))
    apart = float(np.linalg.norm(screen - screen.mean(axis=0), axis=2).mean())
    links = float(np.linalg.norm(np.diff(screen, axis=1), axis=2).mean())
    return math.sqrt(area) * (0.1 + apart) * links**2
