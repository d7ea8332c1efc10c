"""How many postures a pose of a six-joint arm has, of an arm known in balls.

Some arms have no exact model: their twists are 55 degrees, say, and their numbers are
known as balls only. The resultant D = det M(t_2) of `polynomial` is then a polynomial
with balls for coefficients, as narrow as one likes.

**Count.** Let D have degree 24 (its leading coefficient is not 0) and let every real
root of it be simple. Then the real postures of the pose are as many as these roots.
*Proof.* Every posture has a finite t_2, or the degree would be smaller, and D vanishes
there. At a simple root the null space of M is a line, as the multiplicity of a root is
at least the dimension of the null space; so t_3 and t_4, as points of the projective
line, are those of its vector, joints 6 and 1 follow from linear equations of full rank,
and joint 5 from the closed loop: a root belongs to one posture at most. It belongs to
one, and a real one: the 24 roots are those of (1 + t_2^2)^4 and those of the complex
postures, 16 with multiplicity [Raghavan and Roth 1993], and a posture and its conjugate
have conjugate t_2, which at a real simple root are one. QED.

What is used of the count is that there are not more postures than roots.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from flint import arb, arb_mat, arb_poly, ctx, fmpq, fmpq_mat
from numpy.typing import NDArray

from cuspaudit.algebra.ring import rational
from cuspaudit.kinematics.postures.arm import (
    ArmArrays,
    reversed_arm,
    rigid_inverse,
    turned,
)
from cuspaudit.kinematics.postures.raghavan_roth import closed, fifth_axis, first_side
from cuspaudit.robot.chain import Chain, Motion, Translation, Vector

__all__ = ["posture_bound"]

Array = NDArray[Any]

_BITS = 640
_SIZE = 12
_MOST = 1500
_TO_TANGENT = np.array([[1, 1, 0], [0, 0, 2], [1, -1, 0]], dtype=object)


def posture_bound(chain: Chain, pose: Array) -> int | None:
    """A bound for the number of real postures of a pose, proved; None without one.

    Args:
        chain: six revolute joints, every number as it stands.
        pose: (4, 4), rational, in the chain's unit of length.
    """
    if chain.kinds != ("revolute",) * 6:
        return None
    with ctx.workprec(_BITS):
        arm = _ball_arm(chain)
        found = _bound(arm, pose)
        if found is None:
            # from tip to base the roots are those of joint 5
            found = _bound(reversed_arm(arm), rigid_inverse(pose))
    return found


def _bound(arm: ArmArrays, pose: Array) -> int | None:
    resultant = _resultant(arm, pose)
    if resultant is None:
        return None
    coefficients = resultant.coeffs()
    if len(coefficients) < 2 * _SIZE + 1 or coefficients[-1].contains(0):
        return None
    # |t| > 1 by 1 / t, 0 left out as the degree is full
    turned_round = arb_poly(coefficients[::-1])
    counts = [_roots(polynomial) for polynomial in (resultant, turned_round)]
    if counts[0] is None or counts[1] is None:
        return None
    return counts[0] + counts[1]


def _ball_arm(chain: Chain) -> ArmArrays:
    """The arm in balls."""
    before = [_placed(joint.before) for joint in chain.joints]
    axes = [_unit(joint.axis) for joint in chain.joints]
    return ArmArrays(before, axes, _placed(chain.tool), arb(1) / 2)


def _placed(motions: Sequence[Motion]) -> Array:
    result = _identity()
    for motion in motions:
        if isinstance(motion, Translation):
            step = _identity()
            step[:3, 3] = [arb(rational(x)) for x in motion.vector]
        else:
            angle = motion.angle
            ball = arb.pi() * arb(rational(angle.half_turns))
            sine, cosine = (ball + arb(rational(angle.radians))).sin_cos()
            step = turned(_unit(motion.axis), np.array(cosine), np.array(sine))
        result = result @ step
    return result


def _identity() -> Array:
    result = np.empty((4, 4), dtype=object)
    for i in range(4):
        result[i] = [arb(int(i == j)) for j in range(4)]
    return result


def _unit(axis: Vector) -> Array:
    size = arb(rational(sum(x * x for x in axis))).sqrt()
    result = np.empty(3, dtype=object)
    result[:] = [arb(rational(x)) / size for x in axis]
    return result


def _resultant(arm: ArmArrays, pose: Array) -> arb_poly | None:
    """D in t_2, from its values; None where joints 6 and 1 do not drop out."""
    fifth = fifth_axis(arm)
    side = first_side(arm, closed(arm, pose)).reshape(14, 9)
    rows = _independent_rows(side)
    try:
        inverse = _array(_matrix(side[rows][:, 1:]).inv())
    except ZeroDivisionError:
        return None
    low, middle, high = map(_matrix, _pencil(fifth, side, rows, inverse))
    count = 2 * _SIZE + 1
    points = [fmpq(k // 2 + 1) * (-1 if k % 2 else 1) / 4 for k in range(count)]
    values = [(low + middle * arb(t) + high * arb(t * t)).det() for t in points]
    powers = fmpq_mat(count, count, [t**k for t in points for k in range(count)]).inv()
    return arb_poly(
        [
            sum((arb(powers[k, j]) * v for j, v in enumerate(values)), arb(0))
            for k in range(count)
        ]
    )


def _independent_rows(side: Array) -> list[int]:
    """Eight rows on which the products of joints 6 and 1 are likely independent."""
    rest = np.array([[float(x) for x in row] for row in side[:, 1:]])
    rows: list[int] = []
    for _ in range(8):
        best = int(np.argmax(np.linalg.norm(rest, axis=1)))
        rows.append(best)
        along = rest[best] / np.linalg.norm(rest[best])
        rest = rest - np.outer(rest @ along, along)
    return sorted(rows)


def _pencil(
    fifth: Array, side: Array, rows: list[int], inverse: Array
) -> tuple[Array, Array, Array]:
    """The (12, 12) coefficients of 1, t_2, t_2^2 in M."""
    others = [k for k in range(14) if k not in rows]
    share = side[others][:, 1:] @ inverse
    equations = fifth[others] - np.tensordot(share, fifth[rows], (1, 0))
    equations[:, 0, 0, 0] -= side[others][:, 0] - share @ side[rows][:, 0]
    for axis in (1, 2, 3):
        equations = np.moveaxis(
            np.tensordot(equations, _TO_TANGENT, (axis, 1)), -1, axis
        )
    matrix = np.full((12, 3, 4, 3), arb(0), dtype=object)
    matrix[:6, :, :3], matrix[6:, :, 1:] = equations, equations
    low, middle, high = np.moveaxis(matrix.reshape(12, 3, 12), 1, 0)
    return low, middle, high


def _matrix(entries: Array) -> arb_mat:
    return arb_mat([[arb(x) for x in row] for row in entries])


def _array(matrix: arb_mat) -> Array:
    rows = matrix.tolist()
    result = np.empty((len(rows), len(rows[0])), dtype=object)
    for i, row in enumerate(rows):
        result[i] = row
    return result


def _roots(polynomial: arb_poly) -> int | None:
    """The roots in (-1, 1), all simple, none at an end; None where that is not told."""
    slope = polynomial.derivative()
    waiting, count = [(fmpq(-1), fmpq(1))], 0
    for _ in range(_MOST):
        if not waiting:
            return count
        low, high = waiting.pop()
        box = arb((low + high) / 2) + arb(0, 1) * arb((high - low) / 2)
        if not polynomial(box).contains(0):
            continue
        ends = [polynomial(arb(x)) for x in (low, high)]
        if any(end.contains(0) for end in ends):
            return None
        if not slope(box).contains(0):
            count += int((ends[0] > 0) != (ends[1] > 0))
            continue
        # not halved in the middle, where symmetric arms have a root
        middle = low + (high - low) * fmpq(29, 64)
        waiting += [(low, middle), (middle, high)]
    return None
