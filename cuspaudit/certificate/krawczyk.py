"""One true posture next to the second posture of a certificate.

The first posture is exact, and its pose is the target. Near the second posture, m, we
look for a zero of

    position task   F(q) = p(q) - p*                                 (3 equations)
    pose task       F(q) = (p(q) - p*, vee E(q)),  E = R*^T R(q)     (6 equations)

where vee E = (E32 - E23, E13 - E31, E21 - E12) / 2 is the skew part of the rotation E.
A rotation with vee E = 0 is symmetric: the identity (trace 3) or a half turn
(trace -1). So where also trace E > 1, F(q) = 0 says that the pose of q is the target.
(At a half turn about n the angular rows below are -n n^T R*^T w_i, of rank 1, so that
Krawczyk's test fails there anyway; the trace is checked all the same.)

**Derivative.** It is differentiated exactly, by geometry. The tip's velocity for unit
speed of joint i is v_i, the hand's angular velocity w_i: dp/dq_i = v_i and
dE/dq_i = [R*^T w_i]x E. With [x]x E + E^T [x]x = [(tr E - E) x]x this gives

    d vee E / dq_i = (tr E - E) R*^T w_i / 2,

evaluated in balls over a whole box of joint values.

**Theorem** (Krawczyk 1969; Neumaier 1990, Theorem 5.1.8). Let X be a box with centre
m, A an enclosure of F'(X), Y any matrix. If

    K = m - Y F(m) + (1 - Y A)(X - m)

lies in the interior of X, then F has exactly one zero in X, it lies in K, and F' is
regular on X. The target itself is known as a tiny ball only; K is computed with that
ball, so the conclusion holds for the exact target within it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from flint import arb, arb_mat, ctx

from cuspaudit.certificate.arm import Arm
from cuspaudit.certificate.balls import Frame, Matrix, Row, transposed, turned

__all__ = ["LARGEST_RADIUS_EXPONENT", "PostureBox", "true_posture"]

LARGEST_RADIUS_EXPONENT = -30
"""Boxes reach at most 2^-30 (about 1e-9) to each side of the second posture."""


@dataclass(frozen=True, slots=True)
class PostureBox:
    """A box that holds exactly one posture of the target pose.

    Attributes:
        values: one ball a joint; the second posture of the certificate is inside.
        radius: the half side of the box, a power of two; rad, or the unit of length.
    """

    values: tuple[arb, ...]
    radius: float


def true_posture(
    arm: Arm[arb], first: Sequence[arb], second: Sequence[arb]
) -> PostureBox | None:
    """Prove that one true posture of the pose of ``first`` lies next to ``second``.

    Boxes are tried from twice the Newton defect upwards.

    Args:
        arm: the arm at the working precision.
        first: the exact first posture, as balls.
        second: the approximate second posture, as balls.

    Returns:
        A box round ``second`` with exactly one posture of the target pose; None if
        there is no proof of one within 2^`LARGEST_RADIUS_EXPONENT`.
    """
    _, target = arm.outward(0, first)
    defect, jacobian, _ = _system(arm, second, target)
    size = len(second)
    try:
        Y = jacobian.mid().inv().mid()
    except ZeroDivisionError:
        return None
    newton = Y * defect
    for exponent in _exponents(newton):
        radius = arb(2) ** exponent
        side = arb(0, radius)
        box = tuple(value + side for value in second)
        _, over, trace = _system(arm, box, target)
        left = arb_mat(size, size, _unit_entries(size)) - Y * over
        moved = left * arb_mat(size, 1, [side] * size) - newton  # K - m
        inside = all(entry.abs_upper() < radius for entry in moved.entries())
        if inside and (trace is None or trace > 1):
            return PostureBox(box, float(radius))
    return None


def _exponents(newton: arb_mat) -> range:
    """Exponents of the radii to try: from twice the Newton defect upwards."""
    reach = max(float(entry.abs_upper()) for entry in newton.entries())
    start = max(math.frexp(reach)[1] + 1, -ctx.prec // 2)
    return range(start, LARGEST_RADIUS_EXPONENT + 1)


def _system(
    arm: Arm[arb], q: Sequence[arb], target: Frame[arb]
) -> tuple[arb_mat, arb_mat, arb | None]:
    """F and F' over the balls ``q``, and the trace of E for the pose task."""
    screws, tip = arm.outward(0, q)
    columns = [_entries(screw.velocity(tip.p)) for screw in screws]
    values = [a - b for a, b in zip(*map(_entries, (tip.p, target.p)), strict=True)]
    trace = None
    if len(screws) == 6:
        back = transposed(target.R)
        E = _dense(back) * _dense(tip.R)
        trace = E.trace()
        turning = (arb_mat(3, 3, _unit_entries(3)) * trace - E) / 2
        values += [
            (E[2, 1] - E[1, 2]) / 2,
            (E[0, 2] - E[2, 0]) / 2,
            (E[1, 0] - E[0, 1]) / 2,
        ]
        for column, screw in zip(columns, screws, strict=True):
            w = arb_mat(3, 1, _entries(turned(back, screw.w)))
            column += (turning * w).entries()
    size = len(screws)
    F = arb_mat(size, 1, values)
    return F, arb_mat([list(row) for row in zip(*columns, strict=True)]), trace


def _entries(row: Row[arb]) -> list[arb]:
    return [arb(0) if entry is None else entry for entry in row]


def _dense(matrix: Matrix[arb]) -> arb_mat:
    return arb_mat([_entries(row) for row in matrix])


def _unit_entries(size: int) -> list[int]:
    return [int(i == j) for i in range(size) for j in range(size)]
