"""Two axes in a row, as balls: what of them is geometry and what is a link frame.

The fixed transform between two joints says more than the arm does: where the frames sit
on their axes, and how they are turned about them, changes no motion. What counts is how
the second axis lies to the first, and that is seen in the frame of the first joint
alone: no ball is carried over more than one link, so that errors do not pile up.

Everything is taken at joint value 0. A ball's radius holds the rounding of the file's
numbers (`printed`) and that of the computation (`BITS` bits).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from flint import arb, arb_mat

from cuspaudit.algebra.ring import rational
from cuspaudit.robot.canonical_arm.printed import Printed
from cuspaudit.robot.chain import Joint, Motion, Rotation, Translation, Vector
from cuspaudit.robot.lines import Ball
from cuspaudit.robot.printed_angles import printed_multiple

__all__ = ["BITS", "FixedStep", "axis_ball", "matrix_times", "placed", "scaled", "unit"]

BITS = 320


@dataclass(frozen=True, slots=True)
class FixedStep:
    """A fixed transform x -> turn x + move, in balls."""

    turn: arb_mat
    move: Ball

    def apply(self, point: Ball) -> Ball:
        """The image of a point."""
        return _plus(matrix_times(self.turn, point), self.move)

    def back(self, direction: Ball) -> Ball:
        """The direction whose image is ``direction``."""
        return matrix_times(self.turn.transpose(), direction)


def placed(motions: tuple[Motion, ...], printed: Printed, reads_pi: bool) -> FixedStep:
    """The product of ``motions``, each number with its printed error.

    Args:
        motions: a fixed transform.
        printed: the errors.
        reads_pi: whether a printed angle such as 1.5708 is taken for a multiple of pi;
            it has no error then.
    """
    turn = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1])
    move: Ball = (arb(0), arb(0), arb(0))
    for motion in motions:
        if isinstance(motion, Translation):
            errors = printed.of_lengths(motion)
            x, y, z = map(_ball, motion.vector, errors)
            move = _plus(move, matrix_times(turn, (x, y, z)))
        else:
            turn = turn * _rotation(motion, printed, reads_pi)
    return FixedStep(turn, move)


def axis_ball(joint: Joint, printed: Printed) -> Ball:
    """The unit vector of the joint's axis, in the joint's frame."""
    if joint.printed_axis is None:
        return unit(_exact(joint.axis))
    vector, decimals = joint.printed_axis
    x, y, z = map(_ball, vector, printed.of_axis(vector, decimals))
    return unit((x, y, z))


def matrix_times(matrix: arb_mat, vector: Ball) -> Ball:
    """The product of a (3, 3) matrix and a vector."""
    column = matrix * arb_mat(3, 1, list(vector))
    return column[0, 0], column[1, 0], column[2, 0]


def scaled(vector: Ball, factor: arb) -> Ball:
    """The multiple of a vector."""
    return vector[0] * factor, vector[1] * factor, vector[2] * factor


def unit(vector: Ball) -> Ball:
    """The vector over its length."""
    length = sum((x * x for x in vector), arb(0)).sqrt()
    x, y, z = (x / length for x in vector)
    return x, y, z


def _rotation(motion: Rotation, printed: Printed, reads_pi: bool) -> arb_mat:
    """1 + s K + (1 - c) K^2 (Rodrigues), K the vector product with the unit axis."""
    half_turns, radians = motion.angle.half_turns, motion.angle.radians
    error = printed.of_angle(motion)
    if reads_pi and radians and not half_turns:
        meant = printed_multiple(radians)
        if meant is not None:
            half_turns, radians, error = meant, Fraction(0), Fraction(0)
    angle = arb(rational(half_turns)) * arb.pi() + _ball(radians, error)
    s, c = angle.sin_cos()
    x, y, z = unit(_exact(motion.axis))
    K = arb_mat(3, 3, [0, -z, y, z, 0, -x, -y, x, 0])
    one = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1])
    return one + K * s + K * K * (1 - c)


def _ball(value: Fraction, error: Fraction) -> arb:
    middle = arb(rational(value))
    return middle + arb(0, arb(rational(error))) if error else middle


def _exact(vector: Vector) -> Ball:
    x, y, z = (arb(rational(entry)) for entry in vector)
    return x, y, z


def _plus(a: Ball, b: Ball) -> Ball:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]
