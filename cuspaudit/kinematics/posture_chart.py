"""The postures of a closed loop that are finite in one choice of half-angle tangents.

Joints 2, 3, 4 are first turned by rational angles, so that no posture has one of them
at 180 degrees. Complete by construction: every complex posture is then over a root of
D (`posture_polynomial`), where D is of its full degree. Over a root with null vector
not 0 and entry 0 of it not 0, t_3 and t_4 are finite and unique; (c, s) of joints 6 and
1 follow linearly, and joint 5 from the closed loop. So there is at most one posture.
Roots with null vector 0 are left out when the loop's equations are proved to have no
solution there; those where some 1 + t_i^2 is 0 because c_i and s_i are infinite.

The angles are computed in balls at the complex roots. Rational numerators are read off
the balls, and proved by substitution in the loop's equations modulo omega
(`loop_closure`): nothing rests on the balls.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_poly, ctx, fmpq, fmpq_poly
from numpy.typing import NDArray

from cuspaudit.algebra.ideal import groebner_basis
from cuspaudit.algebra.interpolated_points import proposed_numerators
from cuspaudit.algebra.quadratic_matrix import QuadraticField
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import PrecisionError, RetryableError, UnableError
from cuspaudit.kinematics.loop_closure import closes
from cuspaudit.kinematics.posture_polynomial import (
    PosturePolynomial,
    posture_polynomial,
)
from cuspaudit.kinematics.raghavan_roth import Arm, rigid_inverse, turned

__all__ = ["Chart", "UnluckyChartError", "cos_sin", "turn"]

Array = NDArray[Any]

_STEP = "exact postures"
_PRECISIONS = (4, 6, 12, 24)


class UnluckyChartError(RetryableError):
    """A posture may be infinite in these half-angle tangents; another chart may do."""


@dataclass(frozen=True, eq=False)
class Chart:
    """The arm with joints 2, 3, 4 turned by the angles with tangents ``turns`` of half.

    Attributes:
        field: K.
        arm: not turned; entries in K.
        pose: (4, 4), in K.
        turns: three.
    """

    field: QuadraticField
    arm: Arm
    pose: Array
    turns: Sequence[fmpq]

    def postures(self, seed: int) -> tuple[fmpq_poly, list[fmpq_poly]]:
        """All complex postures, if no other than the finite ones can exist.

        Returns:
            omega, monic and square-free with one posture over each root, and rho_i:
            (c_1, s_1, ..., c_6, s_6), and sqrt m last unless K = Q, are rho_i / omega'.
            Roots with sqrt m negative are those of the conjugate arm.

        Raises:
            UnluckyChartError: a posture may be infinite here.
            UnableError: two postures may share joint 2, or the elimination degenerates.
            PrecisionError: the numbers are longer than expected, or there is no posture
                over a root.
        """
        found = posture_polynomial(self.field, self._turned(), self.pose, seed)
        if found.determinant.degree() < found.full:
            raise UnluckyChartError("a posture with joint 2 at 180 degrees")
        omega = self._with_one_null_vector(found)
        size = int(omega.numer().height_bits())
        for bits in (64 + size * more for more in _PRECISIONS):
            with ctx.workprec(bits), suppress(PrecisionError):
                rho = self._proposed(found, omega)
                if closes(self.field, self.arm, self.pose, omega, rho):
                    return omega, rho
        raise PrecisionError("numerators of the postures", bits)

    def _turned(self) -> Arm:
        before = list(self.arm.before)
        for k, angle in zip((1, 2, 3), self.turns, strict=True):
            own = before[k] @ turn(self.arm, k, *cos_sin(angle))
            before[k] = self.field.reduced(own)
        return Arm(before, self.arm.axes, self.arm.tool, self.arm.half)

    def _with_one_null_vector(self, found: PosturePolynomial) -> fmpq_poly:
        """The roots of D that may have a posture, once each; monic.

        Raises:
            UnluckyChartError: t_3 or t_4 may be infinite.
            UnableError: two postures may be over one root.
        """
        omega = found.determinant
        while omega % found.circle == 0:
            omega = omega // found.circle
        omega = omega // omega.gcd(omega.derivative())
        shared = omega
        for entry in found.null.ravel():
            shared = shared.gcd(entry)
        for factor, _ in shared.factor()[1]:
            root = -factor[0] / factor[1]
            if factor.degree() > 1 or self._may_have_a_posture(found, root):
                raise UnableError(
                    _STEP, "two postures share a joint, or one is singular"
                )
        omega = omega // shared
        one, fourth, third = (found.null[k, -1] for k in (0, 1, 3))
        if omega.gcd(one).degree() > 0:
            raise UnluckyChartError("a posture at 180 degrees")
        for tangent in (third, fourth):
            omega = omega // omega.gcd(one * one + tangent * tangent)
        return omega / omega[omega.degree()]

    def _may_have_a_posture(self, found: PosturePolynomial, root: fmpq) -> bool:
        """Whether 1 is not in the ideal of the loop's equations with u = ``root``."""
        names = [f"{x}{k}" for k in (3, 4, 6, 1) for x in "cs"]
        ring = Ring([*names, "surd"])
        third, fourth, sixth, base = (_basis(ring, k) for k in (3, 4, 6, 1))
        t = root if self.field.radicand is None else fmpq_poly([root, 1])
        second = np.empty(3, dtype=object)
        second[:] = 1 + t * t, 1 - t * t, 2 * t
        left = self.field.reduced(np.tensordot(found.fifth, second, (1, 0)))
        right, below = found.side.reshape(14, 3, 3), _constant(ring, second[0])
        equations = [
            _bilinear(ring, x, third, fourth) - below * _bilinear(ring, y, sixth, base)
            for x, y in zip(left, right, strict=True)
        ]
        equations += [c * c + s * s - 1 for _, c, s in (third, fourth, sixth, base)]
        equations.append(ring.gen("surd") ** 2 - (self.field.radicand or 0))
        try:
            basis = groebner_basis(ring, equations)
        except UnableError:
            return True
        return not basis.contains(ring.constant(1))

    def _proposed(self, found: PosturePolynomial, omega: fmpq_poly) -> list[fmpq_poly]:
        """The numerators of the angles, and of sqrt m, read off balls."""
        roots = _roots(omega)
        values = [self._angles(found, root) for root in roots]
        return proposed_numerators(omega, roots, values)

    def _angles(self, found: PosturePolynomial, root: acb) -> list[acb]:
        """(c, s) of all joints, and sqrt m; right where a posture exists."""
        one, fourth, third = (acb_poly(found.null[k, -1])(root) for k in (0, 1, 3))
        surd = None
        if self.field.radicand is not None:
            surd = acb_poly(found.null[0, 0])(root) / one
        tangents = [root + (surd or 0), third / one, fourth / one]
        middle = [cos_sin(t) for t in tangents]
        right = _at(found.fifth, surd)
        for c, s in reversed(middle):
            right = right @ np.array([acb(1), c, s], dtype=object)
        outer = _at(found.outer, surd)
        c1, s1, c6, s6 = outer[:, 0] + outer[:, 1:] @ right
        own = [
            _difference(pair, cos_sin(angle))
            for pair, angle in zip(middle, self.turns, strict=True)
        ]
        arm, pose = self._arm_at(surd)
        ahead = _product(arm, [(c1, s1), *own]) @ arm.before[4]
        back = arm.before[5] @ turn(arm, 5, c6, s6) @ arm.tool
        fifth = _turn_of(rigid_inverse(ahead) @ pose @ rigid_inverse(back), arm.axes[4])
        pairs = [(c1, s1), *own, fifth, (c6, s6)]
        return [*(x for pair in pairs for x in pair), *([surd] if surd else [])]

    def _arm_at(self, surd: acb | None) -> tuple[Arm, Array]:
        arm = Arm(
            [_at(step, surd) for step in self.arm.before],
            [_at(axis, surd) for axis in self.arm.axes],
            _at(self.arm.tool, surd),
            self.arm.half,
        )
        return arm, _at(self.pose, surd)


def turn(arm: Arm, k: int, c: Any, s: Any) -> Array:
    """The motion of joint k, counted from 0, by the angle of cosine c and sine s."""
    entries = np.empty(2, dtype=object)
    entries[:] = c, s
    return np.asarray(turned(arm.axes[k], entries[:1], entries[1:])[0])


def cos_sin(tangent: Any) -> tuple[Any, Any]:
    """Cosine and sine of twice the angle with this tangent."""
    below = 1 / (1 + tangent * tangent)
    return (1 - tangent * tangent) * below, 2 * tangent * below


def _roots(omega: fmpq_poly) -> list[acb]:
    found: Any = omega.numer().complex_roots()  # its stub forgets the multiplicities
    return [root for root, _ in found]


def _at(array: Array, surd: acb | None) -> Array:
    """Elements of K with a value for sqrt m; as they are over Q."""
    if surd is None:
        return array
    result = np.empty(array.size, dtype=object)
    for k, entry in enumerate(array.ravel()):
        a = fmpq_poly([1]) * entry
        result[k] = surd * a[1] + a[0]
    return result.reshape(array.shape)


def _product(arm: Arm, pairs: Sequence[tuple[acb, acb]]) -> Array:
    placed = np.eye(4, dtype=object)
    for k, (c, s) in enumerate(pairs):
        placed = placed @ arm.before[k] @ turn(arm, k, c, s)
    return placed


def _turn_of(rotation: Array, axis: Array) -> tuple[acb, acb]:
    """(c, s) of a rotation about ``axis``: trace 1 + 2 c, skew part s [axis]_x."""
    r = rotation
    skew = [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]
    c = (r[0, 0] + r[1, 1] + r[2, 2] - 1) / 2
    return c, sum((x * a for x, a in zip(skew, axis, strict=True)), acb(0)) / 2


def _difference(pair: tuple[acb, acb], angle: tuple[fmpq, fmpq]) -> tuple[acb, acb]:
    """(c, s) of the sum of the two angles."""
    (c, s), (a, b) = pair, angle
    return c * a - s * b, s * a + c * b


def _basis(ring: Ring, joint: int) -> tuple[Polynomial, Polynomial, Polynomial]:
    return ring.constant(1), ring.gen(f"c{joint}"), ring.gen(f"s{joint}")


def _bilinear(
    ring: Ring,
    coefficients: Array,
    left: tuple[Polynomial, ...],
    right: tuple[Polynomial, ...],
) -> Polynomial:
    """The sum of left_i coefficient_ij right_j."""
    return ring.total(
        left[i] * right[j] * _constant(ring, coefficients[i, j])
        for i, j in np.ndindex(3, 3)
    )


def _constant(ring: Ring, element: Any) -> Polynomial:
    """An element of K, its sqrt m the variable surd."""
    a = fmpq_poly([1]) * element
    return ring.constant(a[0]) + ring.gen("surd") * ring.constant(a[1])
