"""All postures of a pose of a six-joint arm, exactly.

The pose is that of a posture with rational half-angle tangents, so it is rational, and
so is D (`posture_polynomial`). Joints 2, 3, 4 are first turned by rational angles, so
that no posture has one of them at 180 degrees.

Complete by construction. Every complex posture is over a root t_2 of D, and finite, as
D has its full degree and entry 0 of its null vectors is not 0 at any root. D has simple
roots only (but for 1 + t^2, where c_2, s_2 are infinite), so the null vector, hence t_3
and t_4, are unique there; (c, s) of joints 6 and 1 follow linearly, and joint 5 from
the closed loop. So there is at most one posture over each root; whether there is one is
decided by substitution in the loop's equations modulo D, and by nothing else.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq, fmpq_poly, fmpz_mat
from numpy.typing import NDArray

from cuspaudit.algebra.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.posture_polynomial import (
    DEGREE,
    PosturePolynomial,
    first_and_sixth,
    posture_polynomial,
)
from cuspaudit.kinematics.raghavan_roth import Arm, rigid_inverse, turned
from cuspaudit.kinematics.transform import Transform

__all__ = ["GROUND", "exact_postures"]

Array = NDArray[Any]

GROUND = "Raghavan-Roth resultant, exact, with simple roots"
STEP = "exact postures"
_TRIES = 4


class _UnluckyChartError(RetryableError):
    """A posture may be infinite in these half-angle tangents; another chart may do."""


def exact_postures(
    model: ExactModel, tangents: Sequence[fmpq], seed: int = 0
) -> ZeroDimensionalParametrization:
    """All complex postures that share the pose of a rational one.

    Args:
        model: six revolute joints, over Q; where it is an approximation, so are they.
        tangents: tan(theta_i / 2), theta_i the variables of the model (a joint value
            and its zero), of a posture; its pose is the one solved for.
        seed: of the charts.

    Returns:
        The points (t, c1, s1, ..., c6, s6), t the tangent of half of joint 2 in a
        turned chart and the form of the parametrization; at most 16. The real points
        are the postures of the arm, and the given one is among them.

    Raises:
        UnableError: the field is not Q, or two postures share joint 2, or a posture is
            singular: then D has a double root; or not six revolute joints.
    """
    arm = _exact_arm(model)
    pose = _forward(arm, [_cos_sin(t) for t in tangents])
    rng = np.random.default_rng(seed)
    for _ in range(_TRIES):
        chart = [fmpq(int(x), 17) for x in rng.integers(-40, 40, 3)]
        try:
            return _Chart(arm, pose, chart).parametrization(seed)
        except _UnluckyChartError:
            continue
    raise UnableError(STEP, "a posture stays infinite in every chart that was tried")


@dataclass(frozen=True, eq=False)
class _Chart:
    """The arm with joints 2, 3, 4 turned by the angles with tangents ``turns`` of half.

    Attributes:
        arm: not turned.
        pose: (4, 4), rational.
        turns: three.
    """

    arm: Arm
    pose: Array
    turns: Sequence[fmpq]

    def parametrization(self, seed: int) -> ZeroDimensionalParametrization:
        """The postures that are finite here, if no other can exist."""
        found = posture_polynomial(self._turned(), self.pose, seed)
        if found.determinant.degree() < DEGREE:
            raise _UnluckyChartError("a posture with joint 2 at 180 degrees")
        ring = _Modulo(_simple_part(found.determinant))
        tangents = self._tangents(found, ring)
        middle = [ring.cos_sin(t) for t in tangents]
        postures = self._completed(found, ring, middle)
        values = [fmpq_poly([0, 1]), *(x for pair in postures for x in pair)]
        omega = ring.omega
        for equation in self._equations(ring, postures):
            omega = omega.gcd(equation)
        omega = omega / omega[omega.degree()]
        rho = tuple(x * omega.derivative() % omega for x in values)
        names = ["t", *(f"{x}{k}" for k in range(1, 7) for x in "cs")]
        form = (fmpq(1), *(fmpq(0) for _ in names[1:]))
        return ZeroDimensionalParametrization(tuple(names), omega, rho, form, (GROUND,))

    def _turned(self) -> Arm:
        before = list(self.arm.before)
        for k, turn in zip((1, 2, 3), self.turns, strict=True):
            before[k] = before[k] @ _turn(self.arm, k, *_cos_sin(turn))
        return Arm(before, self.arm.axes, self.arm.tool, self.arm.half)

    def _tangents(self, found: PosturePolynomial, ring: _Modulo) -> list[fmpq_poly]:
        """t_2, t_3, t_4 at the roots: ratios of entries of the null vector.

        A posture with t_3 or t_4 infinite has null vector entry 0 equal to 0; where
        that happens at a root nothing is concluded and another chart is asked for.
        """
        one, third, fourth = (found.null[k] % ring.omega for k in (0, 3, 1))
        if one.gcd(ring.omega).degree() > 0:
            raise _UnluckyChartError("a posture at 180 degrees")
        inverse = ring.inverse(one)
        return [
            fmpq_poly([0, 1]),
            third * inverse % ring.omega,
            fourth * inverse % ring.omega,
        ]

    def _completed(
        self,
        found: PosturePolynomial,
        ring: _Modulo,
        middle: list[tuple[fmpq_poly, fmpq_poly]],
    ) -> list[tuple[fmpq_poly, fmpq_poly]]:
        """(c, s) of all joints, not turned; right where a posture exists."""
        right = found.fifth
        for c, s in reversed(middle):
            basis = np.empty(3, dtype=object)
            basis[:] = fmpq_poly([1]), c, s
            right = ring.reduced(right @ basis)
        c1, s1, c6, s6 = (x % ring.omega for x in first_and_sixth(found, right))
        own = [
            _difference(pair, _cos_sin(turn))
            for pair, turn in zip(middle, self.turns, strict=True)
        ]
        ahead = self._product([(c1, s1), *own], range(4), ring)
        back = self.arm.before[5] @ _turn(self.arm, 5, c6, s6) @ self.arm.tool
        turn = rigid_inverse(ahead @ self.arm.before[4]) @ self.pose
        turn = ring.reduced(turn @ rigid_inverse(back))
        return [(c1, s1), *own, _turn_of(turn, self.arm.axes[4], ring), (c6, s6)]

    def _equations(
        self, ring: _Modulo, postures: list[tuple[fmpq_poly, fmpq_poly]]
    ) -> list[fmpq_poly]:
        """What vanishes at a root exactly when there is a posture."""
        placed = self._product(postures, range(6), ring) @ self.arm.tool
        gap = ring.reduced(placed - self.pose)[:3].ravel()
        circles = [(c * c + s * s - 1) % ring.omega for c, s in postures]
        return [*circles, *gap]

    def _product(
        self,
        postures: list[tuple[fmpq_poly, fmpq_poly]],
        joints: range,
        ring: _Modulo,
    ) -> Array:
        placed = np.eye(4, dtype=object)
        for k, (c, s) in zip(joints, postures, strict=True):
            step = self.arm.before[k] @ _turn(self.arm, k, c, s)
            placed = ring.reduced(placed @ step)
        return placed


@dataclass(frozen=True, eq=False)
class _Modulo:
    """Q[t] / omega."""

    omega: fmpq_poly

    def inverse(self, element: fmpq_poly) -> fmpq_poly:
        """1 / element, which has no root in common with omega.

        Bezout's identity b element + q omega = 1 as linear equations, which FLINT
        solves by p-adic lifting, far faster than by the Euclidean algorithm.
        """
        above, degree = element.numer(), int(self.omega.degree())
        size = degree + int(above.degree())
        columns = [(above, k) for k in range(degree)]
        columns += [(self.omega.numer(), k) for k in range(size - degree)]
        matrix = fmpz_mat(size, size)
        for j, (polynomial, shift) in enumerate(columns):
            for i, coefficient in enumerate(polynomial.coeffs()):
                matrix[i + shift, j] = coefficient
        one = fmpz_mat(size, 1, [1] + [0] * (size - 1))
        try:
            solved = matrix.solve(one).entries()
        except ZeroDivisionError:
            raise _UnluckyChartError("a denominator vanishes at a root") from None
        return fmpq_poly(solved[:degree]) * element.denom()

    def cos_sin(self, tangent: fmpq_poly) -> tuple[fmpq_poly, fmpq_poly]:
        """Cosine and sine of twice the angle with this tangent."""
        square = tangent * tangent % self.omega
        below = self.inverse(1 + square)
        return (1 - square) * below % self.omega, 2 * tangent * below % self.omega

    def reduced(self, array: Array) -> Array:
        """The entries modulo omega."""
        result, one = np.empty(array.size, dtype=object), fmpq_poly([1])
        for k, entry in enumerate(array.ravel()):
            result[k] = entry * one % self.omega
        return result.reshape(array.shape)


def _simple_part(determinant: fmpq_poly) -> fmpq_poly:
    """D without its factors 1 + t^2, monic.

    Raises:
        UnableError: a double root is left.
    """
    circle = fmpq_poly([1, 0, 1])
    while determinant % circle == 0:
        determinant = determinant // circle
    if determinant.gcd(determinant.derivative()).degree() > 0:
        why = "two postures share joint 2 (a wrist?), or one is singular"
        raise UnableError(STEP, why)
    return determinant / determinant[determinant.degree()]


def _exact_arm(model: ExactModel) -> Arm:
    if model.chain.kinds != ("revolute",) * 6:
        raise UnableError(STEP, "only arms of six revolute joints are solved")
    if model.ring.radicand is not None:
        raise UnableError(STEP, f"the numbers are in Q(sqrt {model.ring.radicand})")
    return Arm(
        [_motion(joint.before) for joint in model.joints],
        [np.array([_value(x) for x in joint.axis]) for joint in model.joints],
        _motion(model.tool),
        fmpq(1, 2),
    )


def _motion(transform: Transform) -> Array:
    result = np.eye(4, dtype=object)
    for i in range(3):
        result[i, :3] = [_value(x) for x in transform.rotation[i]]
        result[i, 3] = _value(transform.translation[i])
    return result


def _value(constant: Polynomial) -> fmpq:
    return constant.leading_coefficient() if constant != 0 else fmpq(0)


def _forward(arm: Arm, postures: list[tuple[fmpq, fmpq]]) -> Array:
    placed = np.eye(4, dtype=object)
    for k, (c, s) in enumerate(postures):
        placed = placed @ arm.before[k] @ _turn(arm, k, c, s)
    return placed @ arm.tool


def _turn(arm: Arm, k: int, c: Any, s: Any) -> Array:
    entries = np.empty(2, dtype=object)
    entries[:] = c, s
    return np.asarray(turned(arm.axes[k], entries[:1], entries[1:])[0])


def _turn_of(turn: Array, axis: Array, ring: _Modulo) -> tuple[fmpq_poly, fmpq_poly]:
    """(c, s) of a rotation about ``axis``: trace 1 + 2 c, skew part s [axis]_x."""
    skew = [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
    c = (turn[0, 0] + turn[1, 1] + turn[2, 2] - 1) / 2
    s = sum((x * a for x, a in zip(skew, axis, strict=True)), fmpq_poly([0])) / 2
    return c % ring.omega, s % ring.omega


def _cos_sin(tangent: fmpq) -> tuple[fmpq, fmpq]:
    square = tangent * tangent
    return (1 - square) / (1 + square), 2 * tangent / (1 + square)


def _difference(
    pair: tuple[fmpq_poly, fmpq_poly], turn: tuple[fmpq, fmpq]
) -> tuple[fmpq_poly, fmpq_poly]:
    """(c, s) of the sum of the two angles."""
    (c, s), (a, b) = pair, turn
    return c * a - s * b, s * a + c * b
