"""All postures of a pose of a six-joint arm, in floating point, for searching.

The roots z_2 of det M(z_2) = 0 (`raghavan_roth`) are eigenvalues; the null vectors hold
joints 3 and 4, linear equations then joints 6 and 1, the closed loop joint 5. Newton's
method settles each posture. Any number of poses is solved in one call of the kernel.

Nothing is decided here. A lost posture can be noticed: a regular pose has as many
postures with det J > 0 as with det J < 0, because the map from the compact torus to
the connected group of motions has degree 0 (it is not onto) [facts, erratum 9].
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import separation, shortest_turn
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.postures.arm import (
    ArmArrays,
    reversed_arm,
    rigid_inverse,
    turned,
)
from cuspaudit.kinematics.postures.moving import gap, moved, scaled_arm
from cuspaudit.kinematics.postures.raghavan_roth import closed, fifth_axis, first_side
from cuspaudit.robot.chain import Chain

__all__ = ["PostureSolver", "arm_of", "is_even"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_TO_POWERS = np.array([[0, 0.5, 0.5j], [1, 0, 0], [0, 0.5, -0.5j]])
"""Coefficients of (1, c, s) to those of (1/z, 1, z)."""
_PIVOT = 0.6 * np.exp(1.234j)
_NEAR_CIRCLE = 1e-2
_NEWTON = 8
_REACHED = 1e-10
_EQUAL = 1e-6
_NUDGE = 1e-5
_TILTS = (0.003, -0.02)


def arm_of(chain: Chain) -> tuple[ArmArrays, float]:
    """The arm in doubles, lengths divided by the longest, and that length.

    Raises:
        UnableError: the chain has not six revolute joints.
    """
    if chain.kinds != ("revolute",) * 6:
        raise UnableError("postures", "only arms of six revolute joints are solved")
    return scaled_arm(chain)


def is_even(signs: Array) -> bool:
    """Whether as many determinants are positive as negative: else one is lost."""
    return bool((signs > 0).sum() == (signs < 0).sum())


@dataclass(frozen=True, eq=False)
class PostureSolver:
    """Solves the inverse kinematics of one arm.

    Attributes:
        arm: in doubles, lengths of order 1.
        scale: the length that is 1.
    """

    arm: ArmArrays
    scale: float

    @classmethod
    def of(cls, chain: Chain) -> PostureSolver:
        """The solver of ``chain``."""
        return cls(*arm_of(chain))

    @cached_property
    def _fifth(self) -> Array:
        return fifth_axis(self.arm)

    def poses(self, postures: Array) -> Array:
        """The poses of postures (..., 6): (..., 4, 4), the unit of length ``scale``."""
        return np.asarray(self._frames(postures)[0])

    def determinants(self, postures: Array) -> Array:
        """The determinants of J at postures (..., 6), the unit of length ``scale``."""
        return np.asarray(np.linalg.det(self._frames(postures)[1]))

    def solve(self, poses: Array) -> list[Array]:
        """The postures found of every pose.

        Args:
            poses: (m, 4, 4), lengths in units of ``scale``.

        Returns:
            For each pose (k, 6) postures in (-pi, pi], k at most 16, all distinct,
            each settled to rounding. A posture near a singular one may be missing.

        Raises:
            UnableError: the elimination degenerates for this arm, whichever way it is
                done.
        """
        return self._tried(poses, (*self._ways, self._tilted))

    @property
    def _ways(self) -> tuple[Callable[[Array], list[Array]], ...]:
        direct, nudged = partial(self._from, self), partial(self._from, self._nudged)
        return direct, self._backwards, nudged

    def _tried(
        self, poses: Array, ways: Sequence[Callable[[Array], list[Array]]]
    ) -> list[Array]:
        """What the ways find, each asked for the poses that are short of postures."""
        found, unable = [np.zeros((0, 6))] * len(poses), list[UnableError]()
        for way in ways:
            again = [k for k, postures in enumerate(found) if self._is_short(postures)]
            if not again:
                break
            try:
                more = way(poses[again])
            except UnableError as degenerate:
                unable.append(degenerate)
                continue
            for k, postures in zip(again, more, strict=True):
                found[k] = _distinct(np.vstack([found[k], postures]))
        if len(unable) == len(ways):
            raise unable[0]
        return found

    def _backwards(self, poses: Array) -> list[Array]:
        """From tip to base: the roots are those of joint 5, two sides of a wrist."""
        solver = PostureSolver(reversed_arm(self.arm), self.scale)
        found = solver._from(solver, rigid_inverse(poses))
        return [postures[:, ::-1] for postures in found]

    def _tilted(self, poses: Array) -> list[Array]:
        """From poses turned a little, back to the true ones by Newton's method.

        Where axis 6 stands along axis 1, a tool held upright, the equations fall short:
        they tell the sum or difference of joints 1 and 6 alone.
        """
        found = [np.zeros((0, 6))] * len(poses)
        for tilt in _TILTS:
            turn = turned(np.array([0.48, 0.6, 0.64]), *_cos_sin(tilt))
            near = self._tried(poses @ turn, self._ways)
            owner = np.repeat(np.arange(len(poses)), [len(some) for some in near])
            settled, error = self._settle(np.vstack(near), poses[owner])
            good = error < _REACHED
            found = [
                _distinct(np.vstack([some, settled[good & (owner == k)]]))
                for k, some in enumerate(found)
            ]
        return found

    def _is_short(self, postures: Array) -> bool:
        """Whether some are certainly lost (none at all is suspect)."""
        return not len(postures) or not is_even(self.determinants(postures))

    @cached_property
    def _nudged(self) -> PostureSolver:
        """The solver of an arm near by, whose roots z_2 are not double."""
        rng = np.random.default_rng(0)
        before = [step.copy() for step in self.arm.before]
        for step in before:
            turn = turned(np.array([0.6, 0.8, 0.0]), *_cos_sin(_NUDGE * rng.normal()))
            step[:] = step @ turn
            step[:3, 3] += _NUDGE * rng.normal(size=3)
        return PostureSolver(
            ArmArrays(before, self.arm.axes, self.arm.tool), self.scale
        )

    def _from(self, solver: PostureSolver, poses: Array) -> list[Array]:
        """Postures of this arm settled from those that ``solver`` proposes."""
        starts, owner = solver._starts(poses)
        found, error = self._settle(starts, poses[owner])
        good = error < _REACHED
        return [_distinct(found[good & (owner == k)]) for k in range(len(poses))]

    def _starts(self, poses: Array) -> tuple[Array, NDArray[np.int64]]:
        """Postures near the true ones, and which pose each belongs to."""
        side = first_side(self.arm, closed(self.arm, poses)).reshape(-1, 14, 9)
        z2, vectors = _eigenvectors(self._fifth, side)
        z3, z4 = _ratio(vectors, 2), _ratio(vectors, 3)
        z = np.stack([z2, z3, z4], axis=-1)
        near = (np.abs(np.abs(z) - 1) < _NEAR_CIRCLE).all(axis=-1)
        owner, _ = np.nonzero(near)
        return self._completed(np.angle(z[near]), side[owner], poses[owner]), owner

    def _completed(self, middle: Array, side: Array, poses: Array) -> Array:
        """The postures whose joints 2, 3, 4 are ``middle``."""
        arm = self.arm
        c, s = np.cos(middle).T, np.sin(middle).T
        base = [
            np.stack([np.ones_like(x), x, y], -1) for x, y in zip(c, s, strict=True)
        ]
        value = np.einsum("mijk,ni,nj,nk->nm", self._fifth, *base, optimize=True)
        rest = (value - side[:, :, 0])[..., None]
        products = (np.linalg.pinv(side[:, :, 1:]) @ rest)[..., 0]
        first = np.arctan2(products[:, 1], products[:, 0])
        sixth = np.arctan2(products[:, 5], products[:, 2])
        ahead = arm.before[0] @ turned(arm.axes[0], np.cos(first), np.sin(first))
        for k in (1, 2, 3):
            ahead = ahead @ arm.before[k] @ turned(arm.axes[k], c[k - 1], s[k - 1])
        back = arm.before[5] @ turned(arm.axes[5], np.cos(sixth), np.sin(sixth))
        fifth = rigid_inverse(ahead @ arm.before[4]) @ poses
        fifth = fifth @ rigid_inverse(back @ arm.tool)
        angle = _angle(fifth[..., :3, :3], arm.axes[4])
        return np.column_stack([first, middle, angle, sixth])

    def _settle(self, postures: Array, poses: Array) -> tuple[Array, Array]:
        """Newton's method from ``postures``, and the error that is left."""
        error = np.full(len(postures), np.inf)
        for _ in range(_NEWTON):
            placed, jacobian = self._frames(postures)
            error = np.abs(placed - poses).max(axis=(-2, -1))
            if (error < _REACHED * 1e-4).all():
                break
            step = np.linalg.pinv(jacobian, rcond=1e-12) @ gap(placed, poses)
            postures = postures + np.clip(step[..., 0], -0.3, 0.3)
        return shortest_turn(postures), error

    def _frames(self, postures: Array) -> tuple[Array, Array]:
        """Poses and Jacobians, rows linear velocity of the tip, then angular."""
        return moved(self.arm, postures)


def _eigenvectors(fifth: Array, side: Array) -> tuple[Complex, Complex]:
    """The roots z_2 of det M, (m, 24), and null vectors, (m, 24, 4, 3).

    With z_2 = pivot + 1/w, M(z_2) v = 0 is a quadratic eigenvalue problem in w whose
    leading matrix M(pivot) is regular.
    """
    low, middle, high = _pencil(fifth, side)
    leading = low + _PIVOT * middle + _PIVOT**2 * high
    right = np.concatenate([-(middle + 2 * _PIVOT * high), -high], axis=-1)
    companion = np.zeros((len(side), 24, 24), dtype=complex)
    companion[:, 12:, :12] = np.eye(12)
    try:
        companion[:, :12] = _solved(leading, right)
        w, vectors = np.linalg.eig(companion)
    except np.linalg.LinAlgError as error:
        raise UnableError("postures", f"the elimination degenerates: {error}") from None
    null = np.swapaxes(vectors[:, 12:], 1, 2).reshape(len(side), 24, 4, 3)
    with np.errstate(divide="ignore", invalid="ignore"):
        return _PIVOT + 1 / w, null


def _solved(matrix: Complex, right: Complex) -> Complex:
    """Solutions; of a matrix that is singular the shortest, which serve nothing."""
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(matrix) @ right)


def _pencil(fifth: Array, side: Array) -> tuple[Complex, Complex, Complex]:
    """The three (m, 12, 12) coefficients of z_2 M(z_2).

    The six combinations orthogonal to the eight products of joints 6 and 1 are taken.
    """
    cancel = np.swapaxes(np.linalg.svd(side[:, :, 1:])[0][:, :, 8:], 1, 2)
    equations = np.tensordot(cancel, fifth, (2, 0))
    equations[:, :, 0, 0, 0] -= (cancel @ side[:, :, :1])[..., 0]
    for axis in (2, 3, 4):
        turned = np.tensordot(equations, _TO_POWERS, (axis, 1))
        equations = np.moveaxis(turned, -1, axis)
    rows = np.zeros((len(side), 12, 3, 4, 3), dtype=complex)
    rows[:, :6, :, :3], rows[:, 6:, :, 1:] = equations, equations
    low, middle, high = np.moveaxis(rows.reshape(-1, 12, 3, 12), 2, 0)
    return low, middle, high


def _ratio(vectors: Complex, axis: int) -> Complex:
    """The common ratio of neighbours along ``axis``, by least squares."""
    size = vectors.shape[axis]
    below = vectors.take(range(size - 1), axis)
    above = vectors.take(range(1, size), axis)
    product = (below.conj() * above).sum(axis=(2, 3))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(product / (np.abs(below) ** 2).sum(axis=(2, 3)))


def _cos_sin(angle: float) -> tuple[Array, Array]:
    return np.cos(np.array(angle)), np.sin(np.array(angle))


def _angle(turn: Array, axis: Array) -> Array:
    """The angle of rotations about ``axis`` (nearly)."""
    skew = turn - np.swapaxes(turn, -1, -2)
    vector = np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], -1)
    cosine = (np.trace(turn, axis1=-2, axis2=-1) - 1) / 2
    return np.asarray(np.arctan2(vector @ axis / 2, cosine))


def _distinct(postures: Array) -> Array:
    """One of each, angles compared modulo 2 pi."""
    kept: list[Array] = []
    for posture in postures:
        if all(_distance(posture, other) > _EQUAL for other in kept):
            kept.append(posture)
    return np.array(kept).reshape(-1, 6)


def _distance(a: Array, b: Array) -> float:
    return float(separation(a, b).max())
