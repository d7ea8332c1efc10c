"""Whether three joints are cuspidal, by brute force in floating point.

Nothing here uses the package. Postures of one place are found by a search along
theta3; aspects on a grid of the torus of theta2, theta3, twice: with only those steps
between neighbours on which det J is sure to keep its sign, and with all steps on which
it might. Two postures joined by sure steps make the arm cuspidal; it is called
noncuspidal where, at every place that was tried, not even the others join any.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from scipy.ndimage import label
from special_arms import Links, transform

_GRID = 512
_PLACES = 600

Verdict = Literal["cuspidal", "noncuspidal", "unknown"]


class ThreeJoints:
    """An arm of three joints: where its tip is from axis 1, and det J."""

    def __init__(self, links: Links) -> None:
        self.steps = [transform(*link) for link in links]

    def tip(self, t2: np.ndarray, t3: np.ndarray) -> np.ndarray:
        """(..., 3): the tip in the frame of joint 1, after its turn."""
        point = self.steps[2][:3, 3]
        for angle, step in ((t3, self.steps[1]), (t2, self.steps[0])):
            point = _turned(angle, point) @ step[:3, :3].T + step[:3, 3]
        return point

    def determinant(self, t2: np.ndarray, t3: np.ndarray) -> np.ndarray:
        """The determinant of the velocities of the tip."""
        first, second = self.steps[0], self.steps[1]
        p = self.tip(t2, t3)
        z2, o2 = first[:3, 2], first[:3, 3]
        z3 = _turned(t2, second[:3, 2]) @ first[:3, :3].T
        o3 = _turned(t2, second[:3, 3]) @ first[:3, :3].T + o2
        columns = [
            np.cross([0.0, 0.0, 1.0], p),
            np.cross(z2, p - o2),
            np.cross(z3, p - o3),
        ]
        return np.einsum("...i,...i", columns[0], np.cross(columns[1], columns[2]))

    def invariants(self, t2: np.ndarray, t3: np.ndarray) -> np.ndarray:
        """(..., 2): squared distance from the foot of axis 1, and height."""
        p = self.tip(t2, t3)
        return np.stack([(p * p).sum(-1), p[..., 2]], axis=-1)

    def postures(self, t2: float, t3: float, grid: np.ndarray) -> np.ndarray:
        """(n, 2): the postures that hold the tip where (t2, t3) does.

        Height and squared distance are linear in cosine and sine of theta2, so each
        theta3 gives these two, and those with c^2 + s^2 = 1 are looked for.
        """
        wanted = self.invariants(np.array(t2), np.array(t3))
        misfit = self._cosine_sine(grid, wanted)[2]
        ends = np.roll(misfit, -1)
        at = np.flatnonzero((misfit * ends < 0) & np.isfinite(misfit * ends))
        low, high = grid[at], grid[at] + 2 * np.pi / len(grid)
        left = misfit[at]
        for _ in range(10):
            middle = (low + high) / 2
            value = self._cosine_sine(middle, wanted)[2]
            same = value * left > 0
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        t3s = (low + high) / 2
        c, s, value = self._cosine_sine(t3s, wanted)
        found = np.stack([np.arctan2(s, c), t3s], axis=-1)
        # at a zero the misfit has shrunk; a change of sign at a pole is none
        return found[np.abs(value) < np.maximum(abs(left), abs(ends[at])) / 10]

    def _cosine_sine(
        self, t3: np.ndarray, wanted: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        first, second = self.steps[0], self.steps[1]
        w = _turned(t3, self.steps[2][:3, 3]) @ second[:3, :3].T + second[:3, 3]
        rows, sides = [], []
        t1 = first[:3, 3]
        for g, side in (
            (2 * t1, wanted[0] - (w * w).sum(-1) - t1 @ t1),
            (np.array([0.0, 0.0, 1.0]), wanted[1] - t1[2]),
        ):
            x, y, z = first[:3, :3].T @ g
            rows.append((x * w[:, 0] + y * w[:, 1], y * w[:, 0] - x * w[:, 1]))
            sides.append(side - z * w[:, 2])
        (a, b), (c, d) = rows
        with np.errstate(all="ignore"):
            below = a * d - b * c
            cosine = (sides[0] * d - sides[1] * b) / below
            sine = (a * sides[1] - c * sides[0]) / below
            return cosine, sine, cosine**2 + sine**2 - 1


def _turned(angle: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Rz(angle) point, for arrays of both."""
    angle = np.asarray(angle)
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = (np.broadcast_to(point[..., k], angle.shape) for k in range(3))
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)


def decide(links: Links, seed: int = 0) -> Verdict:
    """The verdict of three joints, "unknown" where the grid is too coarse to say."""
    arm = ThreeJoints(links)
    angles = np.arange(_GRID) * 2 * np.pi / _GRID
    h = 2 * np.pi / _GRID
    values = arm.determinant(*np.meshgrid(angles, angles, indexing="ij"))
    slopes = [np.abs(np.roll(values, -1, axis=k) - values).max() / h for k in (0, 1)]
    far = 1.2 * float(np.hypot(*slopes)) * h / np.sqrt(2)
    sure = {s: _components(s * values > far, False) for s in (1, -1)}
    maybe = {s: _components(s * values > -far, True) for s in (1, -1)}
    rng, grid = np.random.default_rng(seed), np.arange(720) * 2 * np.pi / 720
    open_pairs = False
    for t2, t3 in rng.uniform(0, 2 * np.pi, (_PLACES, 2)):
        found = arm.postures(t2, t3, grid)
        signs = np.sign(arm.determinant(found[:, 0], found[:, 1])).astype(int)
        at = np.round(found / h).astype(int) % _GRID
        for s in (1, -1):
            here = at[signs == s]
            if len(here) < 2:
                continue
            parts = sure[s][here[:, 0], here[:, 1]]
            parts = parts[parts > 0]
            if len(set(parts)) < len(parts):
                return "cuspidal"
            parts = maybe[s][here[:, 0], here[:, 1]]
            open_pairs = open_pairs or len(set(parts)) < len(parts)
    return "unknown" if open_pairs else "noncuspidal"


def _components(mask: np.ndarray, diagonals: bool) -> np.ndarray:
    """The components of a mask on the torus, numbered from 1; 0 outside."""
    parts = label(mask, np.ones((3, 3)) if diagonals else None)[0]
    leader = list(range(int(parts.max()) + 1))

    def root(k: int) -> int:
        while leader[k] != k:
            k = leader[k]
        return k

    for axis in (0, 1):
        first, last = np.take(parts, 0, axis), np.take(parts, -1, axis)
        for shift in (-1, 0, 1) if diagonals else (0,):
            moved = np.roll(first, shift)
            for a, b in {*zip(moved.tolist(), last.tolist(), strict=True)}:
                if a and b:
                    leader[root(a)] = root(b)
    return np.array([root(k) for k in range(len(leader))])[parts]
