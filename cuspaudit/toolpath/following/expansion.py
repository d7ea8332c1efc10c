"""The equations of a leg near one point, to second order, with bounds of the rest.

At a point c, in balls and then rounded, `expansion_at` gives F(c), K = K(c) and the
first derivatives of K. What follows is bounded for all postures at once.

**Bound.** A column of K is a velocity of the tip or of the hand. Its derivatives by
joint values are again vector products with unit axes: d v_i / dq_j = w_a x v_b, and
d w_i / dq_j = w_j x w_i or 0, with a = min(i, j), b = max(i, j), and a slide has w = 0.
So at all points, for directions d_1, ..., d_k measured by |d| = the sum of the
absolute values of their joint coordinates (for angular rows also the turn of the goal),
the k-th derivative of a column of K in these directions is at most L |d_1| ... |d_k|,
L the greatest distance of the tip from an axis (or the unit of a slide), and 1 for
angular rows. *Proof.* |v_b| <= L or is the unit, |w| <= 1, and induction: a derivative
is a sum over joints j of a vector product of w_j with a part of the vector, or with w's
in other places; each term has norm at most L. The goal turns R^T w by -R^T (omega x w).
QED.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import arb
from numpy.typing import NDArray

from cuspaudit.toolpath.ball_arm import cross
from cuspaudit.toolpath.following.leg_system import LegSystem

__all__ = ["NOISE", "ROUNDING", "Expansion", "expansion_at"]

Array = NDArray[np.float64]

ROUNDING = 1e-13
"""Covers the rounding of a few sums and products in coordinates, relative to them."""

NOISE = 2e-12
"""Covers the rounding of K and its derivatives, relative to their size (`tube`)."""

_NARROW = 1e-15
_ROOM = 2.0


@dataclass(frozen=True, eq=False)
class Expansion:
    """F, K and its derivatives at a point.

    Attributes:
        system: the leg.
        at: c, (n + 1,).
        value: F(c), nearly; ``value_error`` bounds the difference.
        value_error: likewise (n,).
        slope: K(c), (n, n + 1), correct to rounding.
        turns: (n, 3), angular velocities of the joints.
        speeds: (n, 3).
        back: R(s)^T.
        sound: whether the balls of K were narrower than 1e-15 of its size, and the
            hand is not half a turn off, proved.
    """

    system: LegSystem
    at: Array
    value: Array
    value_error: Array
    slope: Array
    turns: Array
    speeds: Array
    back: Array
    sound: bool = True

    @cached_property
    def bend(self) -> Array:
        """The derivatives of K: (n, n + 1, n + 1), the last index the variable."""
        system, n = self.system, self.system.size
        inner, outer = _ORDER[n]
        result = np.zeros((n, n + 1, n + 1))
        changed = cross(self.turns[inner], self.speeds[outer])
        result[:3, :n, :n] = np.moveaxis(changed, 2, 0)
        if system.has_pose:
            turned = cross(self.turns[None, :, :], self.turns[:, None, :])
            turned[np.triu_indices(n)] = 0.0
            result[3:, :n, :n] = np.moveaxis(turned @ self.back.T, 2, 0)
            moved = -cross(system.omega[None, :], self.turns) @ self.back.T
            result[3:, :n, n] = moved.T
        return result

    def twice(self, step: Array) -> Array:
        """The second derivative of K along ``step``, (n, n + 1)."""
        system, n = self.system, self.system.size
        w, v, x = self.turns, self.speeds, step[:n, None]
        inner = np.zeros((n, 3))
        inner[1:] = np.cumsum(w * x, axis=0)[:-1]
        outer = np.cumsum((v * x)[::-1], axis=0)[::-1]
        dw = cross(inner, w)
        dv = cross(inner, v) + cross(w, outer)
        d_inner = np.zeros((n, 3))
        d_inner[1:] = np.cumsum(dw * x, axis=0)[:-1]
        d_outer = np.cumsum((dv * x)[::-1], axis=0)[::-1]
        ddv = cross(d_inner, v) + cross(inner, dv) + cross(dw, outer)
        ddv += cross(w, d_outer)
        result = np.zeros((n, n + 1))
        result[:3, :n] = ddv.T
        if system.has_pose:
            own = (system.omega * step[n])[None, :]
            ddw = cross(d_inner, w) + cross(inner, dw)
            ddw += cross(own, cross(own, w)) - 2 * cross(own, dw)
            result[3:, :n] = self.back @ ddw.T
        return result

    @cached_property
    def sizes(self) -> Array:
        """L for each row: what bounds derivatives of K of any order.

        Slides may move by 2 in all from the point.
        """
        system = self.system
        slides = np.abs(self.at[:-1][~system.arm.turns]).sum() + _ROOM
        if system.arm.turns.all():
            slides = 0.0
        result = np.zeros(system.size)
        result[:3] = system.arm.reach + slides * system.arm.unit
        if system.has_pose:
            result[3:] = 1.0
        return result

    def length(self, step: Array) -> float:
        """|d|, the sum in the bound, for angular rows and speeds alike."""
        n = self.system.size
        system = self.system
        turn = system.rate if system.has_pose or system.signs else 0.0
        return float(np.abs(step[:n]).sum() + turn * abs(step[n]))


def expansion_at(system: LegSystem, at: Array) -> Expansion:
    """The expansion at a point, from balls at it."""
    y = [arb(x) for x in at]
    placed = system.arm.placed(y[:-1])
    value = system.value_of(placed, y).entries()
    n = system.size
    turns, speeds = (
        np.array(placed.turns, dtype=float),
        np.array(placed.speeds, dtype=float),
    )
    slope = np.empty((n, n + 1))
    slope[:3, :n] = speeds.T
    slope[:3, n] = [-float(v) for v in system.goal.velocity]
    back = np.eye(3)
    if system.signs is not None:
        slope[3, :n], slope[3, n] = system.signs, -float(system.goal.angle)
    elif system.has_pose:
        back = np.array(system.goal.back(y[-1]).tolist(), dtype=float)
        slope[3:, :n], slope[3:, n] = back @ turns.T, -back @ system.omega
    middle = np.array([float(v) for v in value])
    error = np.array([float(v.rad()) for v in value]) * 1.001 + np.abs(middle) * 1e-15
    sound = (
        _widest(placed.turns) < _NARROW
        and _widest(placed.speeds) < _NARROW * system.arm.reach
        and system.is_genuine_at(placed, y)
    )
    return Expansion(system, at, middle, error, slope, turns, speeds, back, sound)


def _widest(rows: list[list[arb]]) -> float:
    """The largest radius."""
    return max(float(x.rad()) for row in rows for x in row)


def _orders(n: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    i, j = np.indices((n, n))
    return np.minimum(i, j), np.maximum(i, j)


_ORDER = {n: _orders(n) for n in range(1, 8)}
