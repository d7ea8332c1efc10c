"""How the joint axes of a certificate stand to each other, tested exactly.

Two axes in a row, i and i + 1, are compared in the frame of joint i: the first one is
the line through 0 along u, the second the line through p along v, where x -> R x + p is
the fixed transform between the joints and v = R (axis i + 1). Neither the values of
joints i and i + 1 nor what stands elsewhere in the arm matters, so a relation holds in
every posture. Rotations about axis i that begin the transform, and about axis i + 1
that end it, turn one of the two lines about itself and are left out: their angles may
be any.

parallel    u x v = 0
square      u . v = 0
in a plane  p . (u x v) = 0: the lines meet or are parallel

Three axes i, i + 1, i + 2 are level when both pairs are square and the outer two lie
in one plane across axis i + 1: with n along it, the way from a point of axis i to one
of axis i + 2 has no part along n. (Joint i + 1 turns, and moves nothing along n.)

Three axes i, i + 1, i + 2 meet in one point when both pairs do, and both in the same
point of axis i + 1: with a its direction, b that of another and q a point of the other,
x a = q + mu b gives x = (q x b) . N / N . N with N = a x b, and the two quotients are
compared without dividing. That lines are *not* parallel is seen in balls.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import arb

from cuspaudit.certificate import balls
from cuspaudit.certificate.cover import Refusal
from cuspaudit.certificate.model import (
    Certificate,
    CertifiedJoint,
    Loose,
    Motion,
    Rotate,
    Translate,
    Vector,
)
from cuspaudit.certificate.motions import frame_from_motions
from cuspaudit.certificate.structure.exponential_sums import (
    ExponentialSum,
    cosine_and_sine,
    root,
)

__all__ = ["are_level", "are_parallel", "are_square", "meet_in_one_point"]

Column = tuple[ExponentialSum, ExponentialSum, ExponentialSum]


def are_parallel(certificate: Certificate, first: int, last: int) -> bool:
    """Whether axes ``first`` and ``last`` are parallel, all joints between them slides.

    Args:
        certificate: well formed.
        first: number of an axis, from 1.
        last: of a later one.

    Returns:
        True only with a proof.

    Raises:
        Refusal: the numbers have no exact form here.
    """
    motions = [m for joint in certificate.joints[first:last] for m in joint.before]
    pair = _Pair(certificate.joints[first - 1], certificate.joints[last - 1], motions)
    return _vanishes(*_cross(pair.u, pair.v))


def are_square(certificate: Certificate, first: int) -> bool:
    """Whether axes ``first`` and ``first`` + 1 are at right angles."""
    pair = _neighbours(certificate, first)
    return _vanishes(_dot(pair.u, pair.v))


def _are_in_one_plane(certificate: Certificate, first: int) -> bool:
    """Whether axes ``first`` and ``first`` + 1 meet or are parallel."""
    pair = _neighbours(certificate, first)
    return _vanishes(_dot(pair.p, _cross(pair.u, pair.v)))


def meet_in_one_point(certificate: Certificate, first: int, last: int) -> bool:
    """Whether two or three axes in a row meet in one point, neighbours not parallel."""
    for number in range(first, last):
        if not _are_in_one_plane(certificate, number):
            return False
        if not _neighbours(certificate, number).is_not_parallel:
            return False
    if last == first + 1:
        return True
    before, after = _neighbours(certificate, first), _neighbours(certificate, first + 1)
    # the axis in the middle: v of the pair before it, u of the pair after it
    above, below = _crossing(before.v, before.u, _minus(before.p))
    top, bottom = _crossing(after.u, after.v, after.p)
    return _vanishes(above * bottom - top * below)


def are_level(certificate: Certificate, first: int) -> bool:
    """Whether axes ``first`` and ``first`` + 2 lie in a plane across the middle one."""
    if not are_square(certificate, first) or not are_square(certificate, first + 1):
        return False
    before, after = _neighbours(certificate, first), _neighbours(certificate, first + 1)
    # each in the frame of the pair's first axis: v and u both run along the middle one
    here, there = _dot(before.p, before.v), _dot(after.p, after.u)
    return _vanishes(here + there)


@dataclass(frozen=True)
class _Pair:
    """Two axes, and the fixed transform from the frame of the first to the second's."""

    first: CertifiedJoint
    second: CertifiedJoint
    motions: Sequence[Motion]

    @property
    def u(self) -> Column:
        return _column(self.first.axis)

    @property
    def v(self) -> Column:
        direction = _column(self.second.axis)
        for motion in reversed(self._essential):
            direction = _turned(motion, direction)
        return direction

    @property
    def p(self) -> Column:
        """A point of the second axis."""
        point = _column((Fraction(0),) * 3)
        for motion in reversed(self._essential):
            if isinstance(motion, Translate):
                point = _plus(point, _column(motion.vector))
            else:
                point = _turned(motion, point)
        return point

    @property
    def _essential(self) -> Sequence[Motion]:
        """The motions without turns about one of the two axes themselves."""
        first, last = 0, len(self.motions)
        while first < last and _is_about(self.motions[first], self.first.axis):
            first += 1
        while first < last and _is_about(self.motions[last - 1], self.second.axis):
            last -= 1
        return self.motions[first:last]

    @property
    def is_not_parallel(self) -> bool:
        """True only with a proof, in balls of the working precision."""
        frame = frame_from_motions(self._essential)
        u, v = (balls.lifted(_balls(j.axis), arb) for j in (self.first, self.second))
        normal = balls.cross(u, balls.turned(frame.R, v))
        return any(x is not None and not x.contains(0) for x in normal)


def _neighbours(certificate: Certificate, first: int) -> _Pair:
    one, other = certificate.joints[first - 1 : first + 1]
    return _Pair(one, other, other.before)


def _is_about(motion: Motion, axis: Vector) -> bool:
    if not isinstance(motion, Rotate):
        return False
    (a, b, c), (x, y, z) = motion.axis, axis
    return b * z == c * y and c * x == a * z and a * y == b * x


def _balls(vector: Vector) -> balls.Row[arb]:
    x, y, z = map(balls.ball_from_fraction, vector)
    return x, y, z


def _turned(motion: Motion, w: Column) -> Column:
    """The image of a direction: n n^T w + cos (1 - n n^T) w + sin n x w."""
    if isinstance(motion, Translate):
        return w
    if isinstance(motion, Loose):
        raise Refusal("a loose number is not exact")
    v, square = motion.axis, sum((x * x for x in motion.axis), Fraction(0))
    cosine, sine = cosine_and_sine(motion.half_turns, motion.radians)
    share = _dot(_column(v), w).times(1 / square)
    along = (share.times(v[0]), share.times(v[1]), share.times(v[2]))
    across = _plus(w, _minus(along))
    turned = _plus(along, _scaled(across, cosine))
    beside = _cross(_column(v), w)
    if sine.is_zero or all(x.is_zero for x in beside):
        return turned
    length = root(square)
    if length is None:
        raise Refusal(
            "a rotation axis has a length that is no rational number times the root "
            "of 1, 2, 3 or 6: no relation is proved exactly"
        )
    # 1 / length = length / square
    return _plus(turned, _scaled(beside, (sine * length).times(1 / square)))


def _crossing(a: Column, b: Column, q: Column) -> tuple[ExponentialSum, ExponentialSum]:
    """Numerator and denominator of x, where the line x a meets the line q + mu b."""
    normal = _cross(a, b)
    return _dot(_cross(q, b), normal), _dot(normal, normal)


def _column(vector: Vector) -> Column:
    x, y, z = map(ExponentialSum.of, vector)
    return x, y, z


def _plus(a: Column, b: Column) -> Column:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _minus(a: Column) -> Column:
    return -a[0], -a[1], -a[2]


def _scaled(a: Column, factor: ExponentialSum) -> Column:
    return a[0] * factor, a[1] * factor, a[2] * factor


def _dot(a: Column, b: Column) -> ExponentialSum:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Column, b: Column) -> Column:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _vanishes(*sums: ExponentialSum) -> bool:
    return all(each.is_zero for each in sums)
