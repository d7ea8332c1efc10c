"""Whether three joints are cuspidal within limits, by brute force in floating point.

Nothing here uses the package. Joint values 2 and 3 of a box are a grid; components of
{det J != 0} are those of its points, twice: by steps on which det J is sure to keep its
sign, and by all steps on which both ends have one sign. Postures of the place of a
random posture are found by Newton's method from every corner of a coarse grid over the
box. A range over a turn is an interval longer than a turn: postures are different only
when they are not whole turns of revolute joints apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.ndimage import label

Array = np.ndarray
Range = tuple[float, float] | None
Verdict = Literal["cuspidal", "noncuspidal", "unknown"]

_STEPS = 14
_NEAR = 1e-9
_APART = 1e-3
_FREE_SLIDE = 8.0


@dataclass(frozen=True)
class Arm:
    """Three rows (a, alpha, d) of a standard D-H table, angles in rad; R or P each."""

    rows: tuple[tuple[float, float, float], ...]
    kinds: str

    def steps(self, k: int, q: Array) -> tuple[Array, Array]:
        """Rotation (..., 3, 3) and shift (..., 3) of row k at joint values q."""
        a, alpha, d = self.rows[k]
        turns = self.kinds[k] == "R"
        theta = q if turns else np.zeros_like(q)
        rise = np.full_like(q, d) if turns else q + d
        c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
        zero, one = np.zeros_like(c), np.ones_like(c)
        rotation = np.stack(
            [
                np.stack([c, -s * ca, s * sa], -1),
                np.stack([s, c * ca, -c * sa], -1),
                np.stack([zero, sa * one, ca * one], -1),
            ],
            -2,
        )
        return rotation, np.stack([a * c, a * s, rise], -1)

    def tip(self, q2: Array, q3: Array) -> tuple[Array, Array, Array]:
        """The tip with joint 1 at 0, and its velocities by joints 2 and 3."""
        r1, p1 = self.steps(0, np.zeros_like(q2))
        r2, p2 = self.steps(1, q2)
        _, p3 = self.steps(2, q3)
        r12 = r1 @ r2
        tip = p1 + _turn(r1, p2) + _turn(r12, p3)
        axis2, axis3 = r1[..., :, 2], r12[..., :, 2]
        v2 = np.cross(axis2, tip - p1) if self.kinds[1] == "R" else axis2
        third = p1 + _turn(r1, p2)
        v3 = np.cross(axis3, tip - third) if self.kinds[2] == "R" else axis3
        return tip, v2, v3

    def values(self, q2: Array, q3: Array) -> tuple[Array, Array]:
        """What of the place joint 1 does not change, (..., 2), and its Jacobian."""
        tip, v2, v3 = self.tip(q2, q3)
        velocity = np.stack([v2, v3], -1)
        if self.kinds[0] == "P":
            return tip[..., :2], velocity[..., :2, :]
        flat = tip[..., :2]
        square = (flat * flat).sum(-1) / 2
        value = np.stack([square, tip[..., 2]], -1)
        row = (flat[..., None] * velocity[..., :2, :]).sum(-2)
        return value, np.stack([row, velocity[..., 2, :]], -2)

    def determinant(self, q2: Array, q3: Array) -> Array:
        """The determinant that decides regularity, up to a constant factor."""
        jacobian = self.values(q2, q3)[1]
        return (
            jacobian[..., 0, 0] * jacobian[..., 1, 1]
            - jacobian[..., 0, 1] * jacobian[..., 1, 0]
        )

    def first(self, here: Array, there: Array) -> Array:
        """How far joint 1 moves between two pairs (..., 2) of one value."""
        a, b = (self.tip(q[..., 0], q[..., 1])[0] for q in (here, there))
        if self.kinds[0] == "P":
            return np.abs(a[..., 2] - b[..., 2])
        across = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
        return np.abs(np.arctan2(across, (a[..., :2] * b[..., :2]).sum(-1)))


def _turn(rotation: Array, vector: Array) -> Array:
    return (rotation @ vector[..., None])[..., 0]


class Box:
    """The grid of a box: two axes, each an interval or a circle."""

    def __init__(self, arm: Arm, limits: Sequence[Range], size: int) -> None:
        self.arm, self.limits = arm, limits
        self.wraps, self.axes = [], []
        for kind, pair in zip(arm.kinds[1:], limits[1:], strict=True):
            wraps = pair is None and kind == "R"
            low, high = pair or (
                (-np.pi, np.pi) if wraps else (-_FREE_SLIDE, _FREE_SLIDE)
            )
            turns = (high - low) / (2 * np.pi) if kind == "R" else 1.0
            count = max(int(size * max(turns, 0.5)), 48)
            self.axes.append(low + (np.arange(count) + 0.5) * (high - low) / count)
            self.wraps.append(wraps)
        q2, q3 = np.meshgrid(*self.axes, indexing="ij")
        self.height = arm.determinant(q2, q3)
        self.sure = self._labels(self._slack())
        self.loose = self._labels(np.zeros_like(self.height))

    def _slack(self) -> Array:
        """How much det J may change within half a step, roughly."""
        changes = [np.abs(np.gradient(self.height, axis=k)) for k in (0, 1)]
        return 0.75 * (changes[0] + changes[1])

    def _labels(self, slack: Array) -> Array:
        found = np.zeros(self.height.shape, dtype=int)
        top = 0
        for sign in (1, -1):
            labels, count = label(sign * self.height > slack)
            labels = _wrapped(labels, self.wraps)
            found = np.where(labels > 0, labels + top, found)
            top += count
        return found

    def at(self, labels: Array, q: Array) -> Array:
        """The labels at pairs (m, 2) inside the box; 0 where none is known."""
        places = []
        for k, axis in enumerate(self.axes):
            step = axis[1] - axis[0]
            value = q[:, k]
            if self.wraps[k]:
                value = (value + np.pi) % (2 * np.pi) - np.pi
            index = np.round((value - axis[0]) / step).astype(int)
            places.append(np.clip(index, 0, len(axis) - 1))
        return labels[tuple(places)]

    def windings(self, q: Array) -> Array:
        """All joint vectors in the box that are whole turns from (m, 2) ones."""
        found = q
        for k, pair in enumerate(self.limits[1:]):
            if self.arm.kinds[k + 1] == "R" and pair is not None:
                turns = np.arange(-3, 4) * 2 * np.pi
                base = (found[:, k] + np.pi) % (2 * np.pi) - np.pi
                many = np.repeat(found[:, None], len(turns), 1)
                many[..., k] = base[:, None] + turns
                found = many.reshape(-1, 2)
            if pair is not None:
                inside = (found[:, k] > pair[0]) & (found[:, k] < pair[1])
                found = found[inside]
        return found


def _wrapped(labels: Array, wraps: Sequence[bool]) -> Array:
    """Labels joined across the ends of circles."""
    for axis in (0, 1):
        if not wraps[axis]:
            continue
        first, last = np.take(labels, 0, axis), np.take(labels, -1, axis)
        changed = True
        while changed:
            changed = False
            first, last = np.take(labels, 0, axis), np.take(labels, -1, axis)
            for a, b in zip(first, last, strict=True):
                if a and b and a != b:
                    labels = np.where(labels == max(a, b), min(a, b), labels)
                    changed = True
                    break
    return labels


def postures(box: Box, value: Array) -> Array:
    """Pairs (m, 2) of one value, as far as Newton's method meets them."""
    arm = box.arm
    grids = [axis[:: max(len(axis) // 24, 1)] for axis in box.axes]
    q = np.stack(np.meshgrid(*grids, indexing="ij"), -1).reshape(-1, 2)
    with np.errstate(all="ignore"):
        for _ in range(_STEPS):
            found, jacobian = arm.values(q[:, 0], q[:, 1])
            gap = found - value
            det = (
                jacobian[:, 0, 0] * jacobian[:, 1, 1]
                - jacobian[:, 0, 1] * jacobian[:, 1, 0]
            )
            step = (
                np.stack(
                    [
                        jacobian[:, 1, 1] * gap[:, 0] - jacobian[:, 0, 1] * gap[:, 1],
                        jacobian[:, 0, 0] * gap[:, 1] - jacobian[:, 1, 0] * gap[:, 0],
                    ],
                    -1,
                )
                / det[:, None]
            )
            size = np.abs(step).max(1, keepdims=True)
            q = q - step * np.minimum(1.0, 0.6 / (size + 1e-300))
        found, _ = arm.values(q[:, 0], q[:, 1])
        good = np.abs(found - value).max(1) < _NEAR * (1 + np.abs(value).max())
    kept: list[Array] = []
    for candidate in q[good & np.isfinite(q).all(1)]:
        if not any(is_same(arm, candidate, other) for other in kept):
            kept.append(candidate)
    return np.array(kept).reshape(-1, 2)


def is_same(arm: Arm, a: Array, b: Array) -> bool:
    """Whether two pairs are one posture."""
    gap = a - b
    for k in (0, 1):
        if arm.kinds[k + 1] == "R":
            gap[k] = (gap[k] + np.pi) % (2 * np.pi) - np.pi
    return bool(np.abs(gap).max() < _APART)


def verdict(
    arm: Arm, limits: Sequence[Range], seed: int = 0, size: int = 360, places: int = 200
) -> tuple[Verdict, int]:
    """The verdict within limits, and the number of sure components of the box.

    "cuspidal": two postures of one place are joined by sure steps, and joint 1 can
    follow with 1e-6 to spare. "noncuspidal": no two of any place that was tried are
    joined even by loose steps. Else "unknown".
    """
    box = Box(arm, limits, size)
    rng = np.random.default_rng(seed)
    seen_loose = False
    for _ in range(places):
        q = np.array([rng.uniform(axis[0], axis[-1]) for axis in box.axes])
        value = arm.values(*(q[None, k] for k in (0, 1)))[0][0]
        different = postures(box, value)
        for i in range(len(different)):
            for j in range(i):
                found = _joined(box, different[i], different[j])
                if found == "sure":
                    return "cuspidal", _count(box.sure)
                seen_loose |= found == "loose"
    return ("unknown" if seen_loose else "noncuspidal"), _count(box.sure)


def _count(labels: Array) -> int:
    """How many components there are; 0 is none."""
    return len(set(np.unique(labels).tolist()) - {0})


def _joined(box: Box, one: Array, two: Array) -> str:
    """Whether windings of two postures lie in one component: sure, loose or no."""
    arm, pair = box.arm, box.limits[0]
    if pair is not None:
        room = pair[1] - pair[0]
        if not arm.first(one, two) < room - 1e-6:
            return "no"
    ways = [box.windings(q[None].copy()) for q in (one, two)]
    if not all(len(way) for way in ways):
        return "no"
    for name, labels in (("sure", box.sure), ("loose", box.loose)):
        here, there = (set(box.at(labels, way).tolist()) - {0} for way in ways)
        if here & there:
            return name
    return "no"
