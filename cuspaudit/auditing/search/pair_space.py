"""Pairs of postures of one pose, and the height |h h'| on them [mathematics 6.4].

W = {(q, q') : R(q) = R(q'), q != q', h(q) h(q') != 0}, h = det J, is a manifold: q may
move freely and q' follows by dq' = B dq, B = J(q')^-1 J(q). Its components stand apart
by the aspects of both ends, and for a compact arm each carries a local maximum of
|h(q) h(q')|. First and last joint of a pose task (the first of a position task) shift
both ends alike and change no height: they are the symmetry that is divided out where
points are compared.

In floating point, many pairs at once: pairs are (m, 2, n) joint values.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import separation
from cuspaudit.geometry.torus.function import TorusFunction
from cuspaudit.kinematics.postures.arm import ArmArrays
from cuspaudit.kinematics.postures.moving import gap, moved, scaled_arm
from cuspaudit.robot.chain import Chain

__all__ = ["Maxima", "PairSpace"]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_NEWTON = 24
_FOLLOW = 4
_REACHED = 1e-9
_APART = 1e-3
_STEPS = 80
_STRIDE = 0.2
_SHORTEST = 1e-3
_SETTLED = 1e-9
_POLISH = 8
_DIFFERENCE = 1e-4
_FLAT = 1e-5
_DAMPED = 1e-10


@dataclass(frozen=True, eq=False)
class Maxima:
    """Where ascents ended.

    Attributes:
        pairs: (m, 2, n), settled at a maximum of |h h'|.
        heights: (m,) log |h h'|.
        lost: number of ascents that did not settle at one.
    """

    pairs: Array
    heights: Array
    lost: int


@dataclass(frozen=True, eq=False)
class PairSpace:
    """W of one arm.

    Attributes:
        arm: in doubles, lengths of order 1.
        h: det J up to a constant, on the torus of all joints.
        zeros: (n,) what is added to joint values to get the angles of ``h``.
        rows: of the Jacobian that the task has, 3 or 6.
    """

    arm: ArmArrays
    h: TorusFunction
    zeros: Array
    rows: int

    @classmethod
    def of(cls, chain: Chain, h: TorusFunction, zeros: Array) -> PairSpace:
        """W of a chain with revolute joints and a square task.

        Raises:
            UnableError: a joint is prismatic.
        """
        return cls(scaled_arm(chain)[0], h, zeros, len(chain.joints))

    @property
    def inner(self) -> list[int]:
        """The joints that do not shift both ends alike."""
        n = len(self.zeros)
        return list(range(1, n - 1 if self.rows == 6 else n))

    def random_pairs(self, count: int, rng: np.random.Generator) -> Array:
        """Pairs of different postures in which h has one sign, from ``count`` starts.

        Where h differs in sign, so do the aspects: such pairs are left out.
        """
        starts = rng.uniform(-np.pi, np.pi, (count, 2, len(self.zeros)))
        pairs, reached = self.settle(starts, _NEWTON)
        apart = separation(pairs[:, 0], pairs[:, 1])[:, self.inner].max(1) > _APART
        one_sign = self._h(pairs).prod(1) > 0
        return np.asarray(pairs[reached & apart & one_sign])

    def settle(self, pairs: Array, steps: int) -> tuple[Array, Mask]:
        """The pairs with q' moved to the pose of q, and which have reached it."""
        target = moved(self.arm, pairs[:, 0])[0]
        other, error = pairs[:, 1], np.full(len(pairs), np.inf)
        for _ in range(steps + 1):
            placed, jacobian = moved(self.arm, other)
            missing = gap(placed, target)[..., : self.rows, :]
            error = self._error(placed, target)
            if (error < _REACHED * 1e-3).all():
                break
            step = _least(jacobian[..., : self.rows, :], missing)
            other = other + np.clip(step[..., 0], -0.5, 0.5)
        return np.stack([pairs[:, 0], other], 1), error < _REACHED

    def heights(self, pairs: Array) -> Array:
        """Log |h h'|, (m,)."""
        return np.asarray(np.log(np.abs(self._h(pairs)) + 1e-300).sum(1))

    def slopes(self, pairs: Array) -> tuple[Array, Array]:
        """The derivative of the height along q, (m, n), and B, (m, n, n)."""
        jacobian = moved(self.arm, pairs)[1][..., : self.rows, :]
        follow = np.linalg.solve(jacobian[:, 1], jacobian[:, 0]).astype(np.float64)
        angles = pairs + self.zeros
        own = self.h.gradient(angles) / self.h(angles)[..., None]
        return own[:, 0] + np.einsum("mji,mj->mi", follow, own[:, 1]), follow

    def maxima(self, pairs: Array) -> Maxima:
        """Where ascents from ``pairs`` end, settled by Newton's method."""
        climbed = self._climb(pairs)
        settled, slope, bend = self._polish(climbed)
        size = np.abs(bend).max(1)
        good = (slope < _FLAT * (1 + size)) & (bend[:, -1] < _FLAT * size)
        one_sign = self._h(settled).prod(1) > 0
        good &= one_sign & (self.heights(settled) > self.heights(pairs) - _FLAT)
        kept = settled[good]
        return Maxima(kept, self.heights(kept), int((~good).sum()))

    def _climb(self, pairs: Array) -> Array:
        """Uphill in the metric that |dq|^2 + |dq'|^2 gives W."""
        stride, height = np.full(len(pairs), _STRIDE), self.heights(pairs)
        for _ in range(_STEPS):
            slope, follow = self.slopes(pairs)
            metric = np.eye(slope.shape[1]) + np.swapaxes(follow, 1, 2) @ follow
            ahead = np.linalg.solve(metric, slope[..., None])
            both = np.stack([ahead, follow @ ahead], 1)[..., 0]
            length = np.linalg.norm(both, axis=(1, 2))
            guess = pairs + (stride / (length + 1e-300))[:, None, None] * both
            new, reached = self.settle(guess, _FOLLOW)
            value = self.heights(new)
            near = np.abs(new - guess).max((1, 2)) < stride
            up = reached & near & (value > height)
            pairs = np.where(up[:, None, None], new, pairs)
            height = np.where(up, value, height)
            stride = np.where(up, np.minimum(1.5 * stride, _STRIDE), stride / 3)
            if (stride < _SHORTEST).all():
                break
            stride = np.maximum(stride, _SHORTEST / 2)
        return pairs

    def _polish(self, pairs: Array) -> tuple[Array, Array, Array]:
        """Newton's method in the inner joints of q: pairs, |slope|, sorted bends."""
        inner = self.inner
        for last in range(_POLISH + 1):
            slope, follow = self.slopes(pairs)
            slope, bend = slope[:, inner], self._bend(pairs, follow)
            values, vectors = np.linalg.eigh(bend)
            if last == _POLISH or (np.abs(slope) < _SETTLED).all():
                break
            flat = np.abs(values) < _FLAT * np.abs(values).max(1, keepdims=True)
            along = np.einsum("mij,mi->mj", vectors, slope)
            step = np.where(flat, 0.0, -along / np.where(flat, 1.0, values))
            ahead = np.zeros((len(pairs), len(self.zeros)))
            ahead[:, inner] = np.einsum("mij,mj->mi", vectors, step)
            both = np.stack([ahead, np.einsum("mij,mj->mi", follow, ahead)], 1)
            length = np.abs(both).max((1, 2))[:, None, None]
            pairs = pairs + both * np.minimum(1, 0.1 / (length + 1e-300))
            pairs = self.settle(pairs, _FOLLOW)[0]
        return pairs, np.abs(slope).max(1), values

    def _bend(self, pairs: Array, follow: Array) -> Array:
        """The Hessian of the height along the inner joints of q, by differences."""
        inner, columns = self.inner, []
        for k in inner:
            ahead = np.zeros((len(pairs), len(self.zeros)))
            ahead[:, k] = _DIFFERENCE
            both = np.stack([ahead, np.einsum("mij,mj->mi", follow, ahead)], 1)
            plus, minus = (self.settle(pairs + e * both, _FOLLOW)[0] for e in (1, -1))
            rise = self.slopes(plus)[0] - self.slopes(minus)[0]
            columns.append(rise[:, inner] / (2 * _DIFFERENCE))
        bend = np.stack(columns, -1)
        return np.asarray((bend + np.swapaxes(bend, 1, 2)) / 2)

    def _h(self, pairs: Array) -> Array:
        return self.h(pairs + self.zeros)

    def _error(self, placed: Array, target: Array) -> Array:
        """Of poses, or of positions alone."""
        apart = np.abs(placed - target)[:, :3]
        return np.asarray((apart if self.rows == 6 else apart[..., 3:]).max((1, 2)))


def _least(matrix: Array, right: Array) -> Array:
    """Solutions that stay small where a matrix is singular."""
    back = np.swapaxes(matrix, -1, -2)
    square = back @ matrix + _DAMPED * np.eye(matrix.shape[-1])
    return np.asarray(np.linalg.solve(square, back @ right))
