"""The bounds of the theorem on tubes (`tube`), and what rounding adds to them.

**The bounds.** With a in the kernel of K(c) and 2 K e + K'[a] a = 0, to rounding,

    K(y) y' = t^2 (K'[e] a + 2 K'[a] e + K''[a, a] a / 2) + rest,
    K(y) N = (K + t K'[a] + t^2 (K'[e] + K''[a, a] / 2) + K'[N z]) N + rest,

y' = a + 2 t e, and the rests are bounded by the sizes of the derivatives (`expansion`).
M differs from the identity by at most the angle between hand and goal, which is at most
the integral of the angular rows of K y' from c.

**Rounding.** c, a, e, N, Y, w, t0 and t1 are the doubles that they are: the theorem is
about these. F(c) comes with its radius. What is left is the rounding of K and of sums
and products, u = 2^-53 each. `TubeBounds.is_admissible` refuses what is not of moderate
size: n <= 7, T <= 4, 2 T |e|_1 <= 4, path = T |a| + T^2 |e| <= 1, sides <= 1, and a and
N orthonormal to 4e-15. Let rows = |Y| L, columns <= sqrt(8) the sums of |N|, and
measure each term by the product of the absolute values of its factors. An entry of K is
known to u of itself and 1e-15 of L, as `expansion` checks, so to 9 u of L; |a| <= 4.2
and |a| + 2 T |e| <= 17, as the goal turns by at most pi.

- Y K N, Y K a, 2 T Y K e: at most 20 roundings each, and 2 T |e| <= 4, so 80 u = 9e-15
  of |Y| |K|, and 15e-15 of rows for K itself.
- K' : products of two known entries (18 u), 3 roundings, then two or three products of
  length 8: 48 u = 5.3e-15 of its size, which absolute values in place of norms make at
  most 3 times as large. T Y K'[a] N, T^2 Y K'[e] N and the part of the sides in Y K' N
  are at most sqrt(8) rows, so 4.5e-14 rows each; T Y K'[a] a at most 4.2 rows, so
  7e-14; T^2 Y (K'[e] a + 2 K'[a] e) at most 12.6 rows, so 2e-13; what the sides have in
  K' y' at most 17 rows, so 2.7e-13.
- K'': 87 u = 1e-14; the four products of `Expansion.twice` and absolute values in place
  of norms make its size at most 21 times as large: with T^2 |a|^2 / 2 <= 1/2 that gives
  3e-13 rows in K N and 4.5e-13 rows in K y'.

No sum of these is above 1.1e-12 (rows + |Y| |K|); NOISE is 2e-12. In coordinates there
are at most 12 roundings of numbers below 8 + |offset|, 1.3e-15 of them, and what a and
N lack to orthonormal, 3.2e-14 |offset|: ROUNDING (1 + |offset|) is more. The bounds
themselves are polynomials of positive numbers, with less than 100 roundings, 1.2e-14 of
their size: `_UP` is more.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cuspaudit.toolpath.following.expansion import NOISE, Expansion
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.tube_axis import TubeAxis

__all__ = [
    "MOST_JOINTS",
    "MOST_OFF",
    "UP",
    "TubeBounds",
    "noise_of",
    "rows_of",
    "turn_columns",
    "turn_off",
]

Array = NDArray[np.float64]

UP = 1 + 1e-12
"""More than what a bound loses by its own rounding."""
MOST_JOINTS = 7
MOST_OFF = 0.1
_THINNEST = 2e-11
_CONTRACTS = 0.9
_TRIES = 4
_MOST_T, _MOST_BEND, _MOST_PATH, _MOST_SIDE = 4.0, 4.0, 1.0, 1.0
_SQUARE = 4e-15


class TubeBounds:
    """The bounds of the module's theorem for one axis and |t| <= T."""

    def __init__(self, axis: TubeAxis, T: float) -> None:
        here, Y, N = axis.here, axis.Y, axis.across
        system, a, e = here.system, axis.along, axis.bow
        self.T, self._axis = T, axis
        along, twice = here.bend @ a, here.twice(a)
        second = here.bend @ e + twice / 2
        a1, a2 = here.length(a), here.length(e)
        self.path, self.speed = T * a1 + T**2 * a2, a1 + 2 * T * a2
        third_order = self.path**3 / 6
        self.rest = T**3 * a1 * a2 + T**4 * a2**2 / 2 + third_order
        self.rest_speed = third_order * self.speed + T**3 * a2 * (
            2 * a2 + 2 * a1**2 + 2.5 * T * a1 * a2 + T**2 * a2**2
        )
        size = np.abs(Y)
        self.rows = rows_of(Y, here)
        noise = noise_of(Y, self.rows, here)
        # K y' = r0 + t r1 + t^2 g + rest
        r0, r1 = here.slope @ a, 2 * (here.slope @ e) + along @ a
        g = second @ a + 2 * (along @ e)
        terms = np.abs(Y @ np.stack([r0, r1, g], 1))
        self.moving = terms @ [1, T, T**2] + self.rows * self.rest_speed + noise
        # the rest is of order 3 in t at least: its integral has a factor 1/4
        whole = T * (self.rows * self.rest_speed / 4 + noise)
        own = terms @ [T, T**2 / 2, T**3 / 3] + whole
        self.own = own + size @ (np.abs(here.value) + here.value_error)
        flat = np.eye(len(Y)) - Y @ (here.slope @ N)
        self.still = np.abs(flat) + noise[:, None]
        self.still += T * np.abs(Y @ along @ N) + T**2 * np.abs(Y @ second @ N)
        self.bends = Y @ np.moveaxis(here.bend @ N, 2, 0)  # (j, n, n + 1)
        self.bent = np.abs(self.bends @ N)
        self.columns = np.abs(N).sum(axis=0)
        self.turn = None
        if system.has_pose or system.signs is not None:
            self.turn = np.sqrt((Y[:, 3:] ** 2).sum(axis=1))
            s0, s1, s2 = (float(np.sqrt((r[3:] ** 2).sum())) for r in (r0, r1, g))
            row = float(np.abs(here.slope[3:]).sum(axis=1).max())
            swing = self.rest_speed / 4 + 2 * NOISE * (2 + row)
            self.turned = T * (s0 + T / 2 * s1 + T**2 / 3 * s2 + swing) + turn_off(here)
            self.turning = s0 + T * s1 + T**2 * s2 + self.rest_speed + swing
            self.turn_columns = turn_columns(N, system)
            self.own = self.own + self.turn * self.turned**2

    @property
    def is_admissible(self) -> bool:
        """Whether all sizes are such that the slack exceeds the rounding."""
        axis, square = (
            self._axis,
            np.column_stack([self._axis.along, self._axis.across]),
        )
        return bool(
            len(axis.Y) <= MOST_JOINTS
            and self.T <= _MOST_T
            and 2 * self.T * float(np.abs(axis.bow).sum()) <= _MOST_BEND
            and self.path <= _MOST_PATH
            and (self.turn is None or turn_off(axis.here) <= MOST_OFF)
            and np.abs(square.T @ square - np.eye(len(square))).max() <= _SQUARE
        )

    def widths(self) -> tuple[Array, float] | None:
        """Widths with which the test succeeds, and the bound of |1 - Y F' N|."""
        loose = max(1 - float(self.still.sum(axis=1).max()), 0.1)
        widths = 1.3 * self.own / loose + _THINNEST
        for _ in range(_TRIES):
            left = self._left(widths)
            strain = float(left.sum(axis=1).max())
            if not strain < _CONTRACTS or not self._side(widths) <= _MOST_SIDE:
                return None
            needed = (self.own + left @ widths) * UP
            if bool((needed < widths).all()):
                return np.asarray(widths), strain
            widths = np.maximum(1.2 * needed, widths)
        return None

    def drift(self, widths: Array, strain: float) -> Array:
        """Bounds of |z'|."""
        axis, side = self._axis, self._side(widths)
        pushed = np.abs(self.bends @ axis.along) + 2 * self.T * np.abs(
            self.bends @ axis.bow
        )
        slope = (
            self.moving + widths @ pushed + self.rows * self._mixed(side) * self.speed
        )
        if self.turn is not None:
            turning = self.turning + (side + self._mixed(side)) * self.speed
            slope = slope + self.turn * (self.turned + side) * turning
        return np.asarray(slope + strain / (1 - strain) * slope.max()) * UP

    def _left(self, widths: Array) -> Array:
        """Bounds of the entries of |1 - Y F' N|."""
        side = self._side(widths)
        left = self.still + np.tensordot(widths, self.bent, 1)
        left += np.outer(self.rows * (self.rest + self._mixed(side)), self.columns)
        if self.turn is not None:
            left += np.outer(self.turn * (self.turned + side), self.turn_columns)
        return np.asarray(left)

    def _side(self, widths: Array) -> float:
        """How far the sides reach, in the measure of `Expansion`."""
        return self._axis.here.length(np.abs(self._axis.across) @ widths)

    def _mixed(self, side: float) -> float:
        """Derivatives of order 2 and more in which the sides have a part."""
        third = ((self.path + side) ** 3 - self.path**3) / 6
        return self.path * side + side**2 / 2 + third


def rows_of(Y: Array, here: Expansion) -> Array:
    """What bounds Y times a derivative of a column of K."""
    rows = np.sqrt((Y[:, :3] ** 2).sum(axis=1)) * here.sizes[0]
    if len(Y) > 3:
        rows += np.sqrt((Y[:, 3:] ** 2).sum(axis=1)) * here.sizes[-1]
    return np.asarray(rows)


def noise_of(Y: Array, rows: Array, here: Expansion) -> Array:
    """More than the rounding of Y times K and its derivatives, by rows."""
    own = np.abs(Y) @ np.abs(here.slope).sum(axis=1)
    return np.asarray(NOISE * (1 + rows + own))


def turn_off(here: Expansion) -> float:
    """How far the hand at most is turned from its goal at c: its sine is less."""
    return 1.01 * float(np.abs(here.value[3:]).sum() + here.value_error[3:].sum())


def turn_columns(across: Array, system: LegSystem) -> Array:
    """Bounds of the angular parts of K N."""
    joints = np.abs(across[:-1]).sum(axis=0)
    return np.asarray(joints + system.rate * np.abs(across[-1]))
