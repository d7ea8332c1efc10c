"""Tubes: boxes round a curved axis that hold a piece of a curve of zeros, nothing else.

Let F map n + 1 unknowns y to n values, F' = M K. A tube has a center c, a unit vector
a, n directions N that make an orthonormal basis with it, and a vector e = N f; its
points are

    y = c + t a + t^2 e + N z,    t0 <= t <= t1,  |z_k| <= w_k.

**Theorem.** Let Y be any matrix, and suppose that for all t and z of the tube

    |Y F(c + t a + t^2 e)|  +  |1 - Y F'(y) N| w  <  w.

Then for every t there is exactly one z in the tube with F(y) = 0, and it depends
smoothly on t. *Proof.* Krawczyk's test at every t [Krawczyk 1969; Neumaier 1990,
Theorem 5.1.8] gives existence and uniqueness, and F' N is regular on the tube, as
|1 - Y F' N| w < w, so that the implicit function theorem gives smoothness. QED.

The bounds are those of `tube_bounds`.

**Slopes.** Along the curve dy/dt = a + 2 t e + N z' with F' N z' = -F' y', so z' is
bounded by |Y F' y'| and the same contraction. Where a component keeps away from 0 the
curve is monotone in it.

A knot is a box round a point with a zero in it. If it lies in two tubes, its zero
belongs to the curves of both, and they are pieces of one curve.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from flint import arb
from numpy.typing import NDArray

from cuspaudit.toolpath.following.expansion import ROUNDING, Expansion, expansion_at
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.tube_axis import TubeAxis, inverse
from cuspaudit.toolpath.following.tube_bounds import (
    MOST_JOINTS,
    MOST_OFF,
    UP,
    TubeBounds,
    noise_of,
    rows_of,
    turn_columns,
    turn_off,
)

__all__ = ["Knot", "Tube", "knot_at", "tube_round"]

Array = NDArray[np.float64]

_BEYOND = 1.0 / 64
_KNOTS = 1e-12, 1e-11


@dataclass(frozen=True, slots=True, eq=False)
class Knot:
    """A box with a zero of F in it, and no other zero at its parameter of a plane.

    Attributes:
        at: its center, (n + 1,).
        reach: its half sides.
    """

    at: Array
    reach: Array

    def balls(self) -> list[arb]:
        """The box."""
        return [arb(x, r) for x, r in zip(self.at, self.reach, strict=True)]


@dataclass(frozen=True, slots=True, eq=False)
class Tube:
    """A proved tube.

    Attributes:
        center: c.
        along: a.
        across: N, (n + 1, n).
        bow: e.
        span: (t0, t1).
        widths: w.
        low: a lower bound of every coordinate on the tube.
        high: an upper bound.
        rise_low: a lower bound of dy/dt.
        rise_high: an upper bound.
        strain: the bound of |1 - Y F' N|: how near the tube was to failing.
    """

    center: Array
    along: Array
    across: Array
    bow: Array
    span: tuple[float, float]
    widths: Array
    low: Array
    high: Array
    rise_low: Array
    rise_high: Array
    strain: float

    @property
    def length(self) -> float:
        """Of its axis, nearly."""
        return self.span[1] - self.span[0]

    def trend(self, k: int) -> int:
        """The sign of dy_k/dt on the whole tube; 0 where it is not proved."""
        return int(self.rise_low[k] > 0) - int(self.rise_high[k] < 0)

    def holds(self, knot: Knot) -> bool:
        """Whether the box of ``knot`` is inside, proved."""
        offset = knot.at - self.center
        t = float(self.along @ offset)
        slack = ROUNDING * (1.0 + float(np.abs(offset).sum()))
        reach = float(np.abs(self.along) @ knot.reach) + slack
        if not self.span[0] < t - reach <= t + reach < self.span[1]:
            return False
        z = self.across.T @ (offset - t * t * self.bow)
        moved = (2 * abs(t) + reach) * reach * np.abs(self.across.T @ self.bow) * UP
        sides = np.abs(self.across.T) @ knot.reach + moved + slack
        return bool((np.abs(z) + sides < self.widths).all())

    def heads_with(self, other: Tube) -> bool:
        """Whether the tangents of ``other`` go the way this tube goes, proved."""
        middle = (other.rise_low + other.rise_high) / 2
        spread = (other.rise_high - other.rise_low) / 2 * UP
        return float(self.along @ middle - np.abs(self.along) @ spread) > ROUNDING


def knot_at(system: LegSystem, at: Array, across: Array) -> Knot | None:
    """A tiny box round ``at``, in the directions ``across``, with exactly one zero.

    Krawczyk's test with the inverse of K(at) N, as in the theorem with t = 0; on the
    box K differs from K(at) by its first derivative times the reach at most.

    Args:
        system: the leg.
        at: a zero, nearly.
        across: N, (n + 1, n), orthonormal columns.
    """
    here = expansion_at(system, at)
    Y = inverse(here.slope @ across)
    if Y is None or not here.sound or system.size > MOST_JOINTS:
        return None
    for size in _KNOTS:
        reach = np.abs(across).sum(axis=1) * size * UP
        if _has_zero(here, Y, across, reach, size):
            return Knot(at, reach)
    return None


def _has_zero(
    here: Expansion, Y: Array, across: Array, reach: Array, size: float
) -> bool:
    """Whether Krawczyk's test succeeds for |z_k| <= size, a box of this reach."""
    system, moved, rows = here.system, here.length(reach) * UP, rows_of(Y, here)
    left = np.abs(np.eye(len(Y)) - Y @ (here.slope @ across))
    left += noise_of(Y, rows, here)[:, None]
    left += np.outer(rows * moved, np.abs(across).sum(axis=0))
    if system.has_pose or system.signs is not None:
        off = turn_off(here)
        if not off < MOST_OFF:
            return False
        turn = np.sqrt((Y[:, 3:] ** 2).sum(axis=1))
        left += np.outer(turn * (off + moved), turn_columns(across, system))
    own = np.abs(Y) @ (np.abs(here.value) + here.value_error)
    return bool(((own + left.sum(axis=1) * size) * UP < size).all())


def tube_round(axis: TubeAxis, ends: tuple[Array, Array]) -> Tube | None:
    """The tube along ``axis`` that reaches a little beyond two points, if proved.

    Args:
        axis: its axis.
        ends: points of the curve, the first behind the other.
    """
    c, along = axis.here.at, axis.along
    first, last = (float(along @ (end - c)) for end in ends)
    if not first < last:
        return None
    margin = _BEYOND * (last - first)
    span = first - margin, last + margin
    bounds = TubeBounds(axis, max(abs(span[0]), abs(span[1])))
    found = bounds.widths() if bounds.is_admissible else None
    if found is None:
        return None
    widths, strain = found
    T, bow = bounds.T, np.abs(axis.bow)
    slack = ROUNDING * (1 + np.abs(c))
    aside = np.abs(axis.across) @ widths * UP + T * T * bow + slack
    one, other = along * span[0], along * span[1]
    rise = (
        2 * T * bow + np.abs(axis.across) @ bounds.drift(widths, strain) * UP + ROUNDING
    )
    return Tube(
        center=c,
        along=along,
        across=axis.across,
        bow=axis.bow,
        span=span,
        widths=widths,
        low=c + np.minimum(one, other) - aside,
        high=c + np.maximum(one, other) + aside,
        rise_low=along - rise,
        rise_high=along + rise,
        strain=strain,
    )
