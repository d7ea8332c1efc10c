"""Tests on boxes for h = P c + Q s + S on circle x B, by Taylor polynomials.

Over y in B the largest value of h is f = S + sqrt(P^2 + Q^2), taken where (c, s) is the
unit vector u* of (P, Q). At the center of a box P, Q, S, their gradients and Hessians
are known up to a bound of the rounding; third derivatives are bounded on the torus.
With u fixed, g_u = u . (P, Q) + S bounds f from below, and with all u from above.

A local maximum of f lifts to one of h at u*. So f has none in a box if the circle, or
the arc that u* keeps to over the box, is covered by arcs on each of which h on arc x
box has a derivative without zeros, or a positive second derivative, along some line.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cuspaudit.geometry.torus.box_waves import BoxWaves

__all__ = ["Boxes"]

Array = NDArray[np.float64]
Truths = NDArray[np.bool_]

_ARCS = 32
_NARROW = 0.15


@dataclass(frozen=True, eq=False)
class Boxes:
    """Boxes of one size with what is known of P, Q, S on them.

    Attributes:
        r: half the edge.
        slack: a bound of the rounding in every test.
        value: (m, 3) P, Q, S at the centers.
        slope: (m, 3, k) their gradients.
        second: (m, 3, k, k) their Hessians.
        third: (2, k, k, k) bounds of the third derivatives of (P, Q), and of S.
    """

    r: float
    slack: float
    value: Array
    slope: Array
    second: Array
    third: Array

    @classmethod
    def at(cls, waves: BoxWaves, depth: int, corner: NDArray[np.int64]) -> Boxes:
        """Boxes with edges 2 pi / 2^depth and given numbers of the lowest corners."""
        angles, bits = 2 * corner + 1, depth + 1
        third = np.stack([np.hypot(waves.twist[0], waves.twist[1]), waves.twist[2]])
        return cls(
            np.pi / (1 << depth) * (1 + 1e-12),
            32 * float(waves.slack.sum()),
            *waves.first(angles, bits),
            waves.second(angles, bits),
            third,
        )

    def only(self, chosen: Truths | NDArray[np.int64]) -> Boxes:
        """The chosen boxes, in the order chosen."""
        value, slope = self.value[chosen], self.slope[chosen]
        return Boxes(self.r, self.slack, value, slope, self.second[chosen], self.third)

    def inside(self) -> Truths:
        """Where f > 0 on the box."""
        u = self.value[:, :2] / np.maximum(self._size[:, 0], 1e-300)[:, None]
        along = np.einsum("mr,mrk->mk", u, self.slope[:, :2]) + self.slope[:, 2]
        low = self.value[:, 2] + self._size[:, 0] - self.r * np.abs(along).sum(1)
        return np.asarray(low > self._rest)

    def outside(self) -> Truths:
        """Where f < 0 on the box."""
        steepest = self.r * self._steep.sum((1, 2))
        high = self.value[:, 2] + self._size[:, 0] + steepest
        return np.asarray(high < -self._rest)

    def no_maximum(self) -> Truths:
        """Where no point of the box is a local maximum of f with f > 0."""
        angle = np.arctan2(self.value[:, 1], self.value[:, 0])
        moved = self.r * self._steep[:, 0].sum(1) + self._curve[:, 0]
        ratio = (moved + self.slack) / np.maximum(self._size[:, 0], 1e-300)
        found = ratio < _NARROW
        near = np.flatnonzero(found)
        # arcsin x <= 1.01 x up to 0.15, and the center is off by rounding only
        found[near] = self.only(near)._flat_on_no_arc(angle[near], 1.02 * ratio[near])
        left = np.flatnonzero(~found)
        for k in range(_ARCS):
            centers = np.full(len(left), 2 * np.pi * k / _ARCS)
            width = np.full(len(left), 1.001 * np.pi / _ARCS)
            left = left[self.only(left)._flat_on_no_arc(centers, width)]
        found[left] = True
        return np.asarray(found)

    @cached_property
    def _size(self) -> Array:
        """|(P, Q)| and |S|: (m, 2)."""
        return _paired(self.value)

    @cached_property
    def _steep(self) -> Array:
        """|d_i (P, Q)| and |d_i S|: (m, 2, k)."""
        return _paired(self.slope)

    @cached_property
    def _bent(self) -> Array:
        """Bounds on the box of |d_i d_j (P, Q)| and |d_i d_j S|: (m, 2, k, k)."""
        return np.asarray(_paired(self.second) + self.r * self.third.sum(3))

    @cached_property
    def _curve(self) -> Array:
        """Bounds of the second terms of Taylor's formula of (P, Q) and S: (m, 2)."""
        return np.asarray(self.r**2 / 2 * self._bent.sum((2, 3)))

    @property
    def _rest(self) -> Array:
        return np.asarray(self._curve.sum(1) + self.slack)

    def _flat_on_no_arc(self, angle: Array, width: Array) -> Truths:
        """Where h has no local maximum with h > 0 on one arc x box each.

        Args:
            angle: (m,) the middles of the arcs.
            width: (m,) half their lengths.
        """
        u = np.stack([np.cos(angle), np.sin(angle)], 1)
        found = self._negative(u, width) | self._rising(u, width)
        left = np.flatnonzero(~found)
        if len(left):
            found[left] = self.only(left)._convex(u[left], width[left])
        return found

    def _negative(self, u: Array, width: Array) -> Truths:
        """Where h < 0 on arc x box."""
        middle = (u * self.value[:, :2]).sum(1) + self.value[:, 2]
        moved = self.r * self._steep.sum((1, 2)) + self._rest
        pair = self._size[:, 0] + self.r * self._steep[:, 0].sum(1) + self._curve[:, 0]
        return np.asarray(middle + moved + width * pair < -self.slack)

    def _rising(self, u: Array, width: Array) -> Truths:
        """Where the derivative of h along the gradient in the middle has no zero."""
        gradient = self._gradient(u)
        length = np.linalg.norm(gradient, axis=1)
        v = np.abs(gradient) / np.maximum(length, 1e-300)[:, None]
        bent, steep = self._bent, self._steep[:, 0]
        cross = steep + self.r * bent[:, 0].sum(2)
        turned = self._size[:, 0] + self.r * cross.sum(1)
        along = np.einsum("mij,mj->m", bent.sum(1), v[:, 1:])
        spread = self.r * (along + v[:, 0] * cross.sum(1))
        spread = spread + width * ((cross * v[:, 1:]).sum(1) + v[:, 0] * turned)
        return np.asarray(length > spread + self.slack)

    def _convex(self, u: Array, width: Array) -> Truths:
        """Where the second derivative of h along one line is positive.

        Any line will do: that of the largest curvature is tried. Where floating point
        has overflowed there is none, and no answer but False.
        """
        hessian = self._hessian(u)
        finite = np.isfinite(hessian).all(axis=(1, 2))
        hessian[~finite] = np.eye(hessian.shape[1])
        v = np.linalg.eigh(hessian)[1][:, :, -1]
        own = np.einsum("mij,mi,mj->m", hessian, v, v)
        turn, move = np.abs(v[:, 0]), np.abs(v[:, 1:])
        # with A, B, C the second, first, zeroth derivatives of (P, Q) along the line,
        # the second derivative is u . A + S'' + 2 v_0 u' . B - v_0^2 u . C
        middle = [
            np.linalg.norm(x, axis=1)
            for x in (
                np.einsum("mrij,mi,mj->mr", self.second[:, :2], v[:, 1:], v[:, 1:]),
                np.einsum("mri,mi->mr", self.slope[:, :2], v[:, 1:]),
                self.value[:, :2],
            )
        ]
        third = np.einsum("rijl,mi,mj->mr", self.third, move, move) * self.r
        moved = [
            third[:, 0],
            self.r * np.einsum("mij,mj->m", self._bent[:, 0], move),
            self.r * self._steep[:, 0].sum(1) + self._curve[:, 0],
        ]
        weight = (1, 2 * turn, turn * turn)
        spread = third[:, 1]
        for w, a, change in zip(weight, middle, moved, strict=True):
            spread = spread + w * (change + width * (a + change))
        return np.asarray(finite & (own > spread + self.slack))

    def _gradient(self, u: Array) -> Array:
        """The gradient of h at u and the centers: (m, 1 + k), the circle first."""
        across = np.stack([-u[:, 1], u[:, 0]], 1)
        turn = (across * self.value[:, :2]).sum(1)
        move = np.einsum("mr,mrk->mk", u, self.slope[:, :2]) + self.slope[:, 2]
        return np.concatenate([turn[:, None], move], 1)

    def _hessian(self, u: Array) -> Array:
        """The Hessian of h at u and the centers: (m, 1 + k, 1 + k)."""
        across = np.stack([-u[:, 1], u[:, 0]], 1)
        size = 1 + self.slope.shape[2]
        result = np.empty((len(u), size, size))
        result[:, 0, 0] = -(u * self.value[:, :2]).sum(1)
        cross = np.einsum("mr,mrk->mk", across, self.slope[:, :2])
        result[:, 0, 1:] = result[:, 1:, 0] = cross
        own = np.einsum("mr,mrij->mij", u, self.second[:, :2])
        result[:, 1:, 1:] = own + self.second[:, 2]
        return result


def _paired(three: Array) -> Array:
    """The length of the first two and the size of the third, along axis 1."""
    return np.stack([np.hypot(three[:, 0], three[:, 1]), np.abs(three[:, 2])], 1)
