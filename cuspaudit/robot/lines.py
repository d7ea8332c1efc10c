"""The axes of a chain at posture 0 as lines, in ball arithmetic.

A number of a file may be wrong in its sixteenth digit, and then axes that ought to be
parallel are not; balls of a thousand bits see that where floating point cannot.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from flint import arb, arb_mat

from cuspaudit.algebra.ring import rational
from cuspaudit.robot.axes import scaled_axis
from cuspaudit.robot.chain import Angle, Chain, Motion, Translation, Vector

__all__ = [
    "BITS",
    "Ball",
    "Line",
    "axis_lines",
    "common_normal",
    "cross",
    "dot",
    "minus",
    "vanishes",
]

BITS = 1024

Ball = tuple[arb, arb, arb]


@dataclass(frozen=True, slots=True)
class Line:
    """The line through ``point`` with the unit vector ``direction``."""

    direction: Ball
    point: Ball


def axis_lines(chain: Chain) -> tuple[list[Line], Ball]:
    """The joint axes in base coordinates, base to tip, and the tip's origin.

    Assumed is that ``ctx.prec`` is `BITS`, here and in all that is done with them.
    """
    lines = []
    turn, point = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1]), arb_mat(3, 1)
    for joint in chain.joints:
        step, shift = _placed(joint.before)
        turn, point = turn * step, point + turn * shift
        lines.append(Line(_ball(turn * _unit(joint.axis)), _ball(point)))
    return lines, _ball(point + turn * _placed(chain.tool)[1])


def common_normal(first: Line, second: Line) -> tuple[Ball, Ball]:
    """Where the common normal meets each of two lines that are not parallel."""
    u, v, between = first.direction, second.direction, minus(second.point, first.point)
    normal = cross(u, v)
    square = dot(normal, normal)
    s, t = (dot(cross(between, w), normal) / square for w in (v, u))
    return _along(first, s), _along(second, t)


def dot(a: Ball, b: Ball) -> arb:
    """The inner product of two vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Ball, b: Ball) -> Ball:
    """The vector product."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def minus(a: Ball, b: Ball) -> Ball:
    """The difference of two vectors."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def vanishes(*balls: arb) -> bool:
    """Whether every ball holds 0: true of what is 0, and of what is 1e-300."""
    return all(ball.contains(0) for ball in balls)


@lru_cache(maxsize=512)
def _placed(motions: tuple[Motion, ...]) -> tuple[arb_mat, arb_mat]:
    """Rotation matrix and translation of the product of ``motions``."""
    turn, point = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1]), arb_mat(3, 1)
    for motion in motions:
        if isinstance(motion, Translation):
            point = point + turn * _column(motion.vector)
        else:
            turn = turn * _rotation(motion.axis, motion.angle)
    return turn, point


def _rotation(axis: Vector, angle: Angle) -> arb_mat:
    """1 + s K + (1 - c) K^2 (Rodrigues), K the vector product with the unit axis."""
    x, y, z = _ball(_unit(axis))
    K = arb_mat(3, 3, [0, -z, y, z, 0, -x, -y, x, 0])
    radians = arb(rational(angle.radians))
    s, c = (arb(rational(angle.half_turns)) * arb.pi() + radians).sin_cos()
    one = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1])
    return one + K * s + K * K * (1 - c)


def _along(line: Line, s: arb) -> Ball:
    (x, y, z), (u, v, w) = line.point, line.direction
    return x + s * u, y + s * v, z + s * w


def _unit(axis: Vector) -> arb_mat:
    scaled = scaled_axis(axis)
    square = sum((x * x for x in scaled), Fraction(0))
    return _column(scaled) / arb(rational(square)).sqrt()


def _column(vector: Vector) -> arb_mat:
    return arb_mat(3, 1, [arb(rational(x)) for x in vector])


def _ball(column: arb_mat) -> Ball:
    return column[0, 0], column[1, 0], column[2, 0]
