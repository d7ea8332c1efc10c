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

from cuspaudit.algebra.points.ideal import groebner_basis
from cuspaudit.algebra.points.interpolated_points import proposed_numerators
from cuspaudit.algebra.quadratic_matrix import QuadraticField
from cuspaudit.errors import PrecisionError, RetryableError, UnableError
from cuspaudit.kinematics.postures.arm import ArmArrays
from cuspaudit.kinematics.postures.loop_closure import closes
from cuspaudit.kinematics.postures.loop_equations import element_in, loop_equations
from cuspaudit.kinematics.postures.loop_turns import (
    arm_at,
    closing_turn,
    cos_sin,
    elements_at,
    turn,
)
from cuspaudit.kinematics.postures.polynomial import (
    PosturePolynomial,
    posture_polynomial,
)

__all__ = ["PostureChart", "UnluckyChartError"]

Array = NDArray[Any]

_STEP = "exact postures"
_PRECISIONS = (4, 6, 12, 24)


class UnluckyChartError(RetryableError):
    """A posture may be infinite in these half-angle tangents; another chart may do."""


@dataclass(frozen=True, eq=False)
class PostureChart:
    """The arm with joints 2, 3, 4 turned by the angles with tangents ``turns`` of half.

    Attributes:
        field: K.
        arm: not turned; entries in K.
        pose: (4, 4), in K.
        turns: three.
    """

    field: QuadraticField
    arm: ArmArrays
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

    def _turned(self) -> ArmArrays:
        before = list(self.arm.before)
        for k, angle in zip((1, 2, 3), self.turns, strict=True):
            own = before[k] @ turn(self.arm, k, *cos_sin(angle))
            before[k] = self.field.reduced(own)
        return ArmArrays(before, self.arm.axes, self.arm.tool, self.arm.half)

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
        side = found.side.reshape(14, 3, 3)
        ring, equations = loop_equations(self.field, found.fifth, side)
        t = root if self.field.radicand is None else fmpq_poly([root, 1])
        below, c, s = (
            element_in(ring, self.field.reduced_element(x))
            for x in (1 + t * t, 1 - t * t, 2 * t)
        )
        equations += [below * ring.gen("c2") - c, below * ring.gen("s2") - s]
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
        right = elements_at(found.fifth, surd)
        for c, s in reversed(middle):
            right = right @ np.array([acb(1), c, s], dtype=object)
        outer = elements_at(found.outer, surd)
        c1, s1, c6, s6 = outer[:, 0] + outer[:, 1:] @ right
        own = [
            _difference(pair, cos_sin(angle))
            for pair, angle in zip(middle, self.turns, strict=True)
        ]
        others = dict(zip((1, 2, 3, 4, 6), [(c1, s1), *own, (c6, s6)], strict=True))
        arm, pose = arm_at(self.arm, surd), elements_at(self.pose, surd)
        fifth = closing_turn(arm, pose, others)
        pairs = [(c1, s1), *own, fifth, (c6, s6)]
        return [*(x for pair in pairs for x in pair), *([surd] if surd else [])]


def _roots(omega: fmpq_poly) -> list[acb]:
    found: Any = omega.numer().complex_roots()  # its stub forgets the multiplicities
    return [root for root, _ in found]


def _difference(pair: tuple[acb, acb], angle: tuple[fmpq, fmpq]) -> tuple[acb, acb]:
    """(c, s) of the sum of the two angles."""
    (c, s), (a, b) = pair, angle
    return c * a - s * b, s * a + c * b
