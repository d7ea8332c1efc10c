"""Four joints that place a point and turn the tip about one direction.

The angle of the tip is its turn about the direction n that the axes share: those of all
joints that turn (a SCARA), or of all but the first, which is at right angles to them
(yaw and three pitches: a palletizing or desktop arm; n moves with the first joint). It
is the sum of the values of the joints that turn about n, with the signs of their axes,
up to a constant. Where no such n exists the task means nothing.

Theorem 1. Parallel axes: where all joints that turn have parallel axes, the arm is
noncuspidal.
Proof. Seen along n, with m joints that turn and 4 - m that slide. Assume det J is not
identically 0; then m is at least 1, and some slide has a part along n. The angle and
the height (the coordinate along n) depend on the joints affinely: the angle on those
that turn, the height on those that slide. Let the place be given.
m = 1: the angle fixes the turn, and the place is affine in the slides: one posture.
m = 3: the height fixes the slide. The rest is a planar arm of three links whose last
one is known, so two links reach a known point in two postures, mirrored in the line to
it, and det J is a constant times their vector product, of opposite signs in the two.
m = 2: let t be the first turn and s a coordinate on the line of slides that keep the
height. A slide moves the tip in the plane across n in a direction that is fixed, turns
with t, or turns with the whole angle, which is known. So the place says
A(s) + R(t) B(s) = P with A, B affine, R(t) a rotation. Nonsingular postures have
B(s) != 0, so s fixes t, and g(s) = |P - A|^2 - |B|^2 = 0, of degree at most 2. The
determinant of (s, t) -> A + R B is +-(A' + R B').(R B) = +-(A'.(P - A) + B'.B), which
is +-g'(s)/2, and det J is a constant times it. So a nonsingular posture is a simple
root of g, and two simple roots of a quadratic g have derivatives of opposite signs.
In each case two postures of one place have opposite signs of det J.

Theorem 2. Yaw and pitch: all joints turn, axes 2, 3, 4 are parallel and axis 1 is at
right angles to them: then det J = +- r a2 a3 sin(theta3), and the arm is noncuspidal.
Here a2, a3 are the distances of axes 2-3 and 3-4, theta3 is counted from where axes 2,
3, 4 lie in one plane, and r is the coordinate of the tip across axis 1 in the plane
that joints 2, 3, 4 move it in (signed: it changes sign when the arm reaches overhead).
Proof. In cylinder coordinates of axis 1 the tip is at R(theta1) (r, d, z), d constant,
and the angle is free of theta1. The velocity along n is r for joint 1 and 0 for the
others, so det J is r times the determinant of (r, z, angle) in joints 2, 3, 4: a planar
arm, +- a2 a3 sin(theta3). Let the place be given. Then z and |r| are known, the sign
of r gives r, and (r, d) != 0 gives theta1. The angle gives the point of axis 4 in the
plane, hence its distance from axis 2 and cos(theta3); the sign of sin(theta3) gives
theta3, then theta2, and the angle gives theta4. So a nonsingular posture is known from
its place and two signs, which a nonsingular path keeps.

Where the whole pose of the tip is meant instead, with r = 0 allowed on the way, the
verdict is the same: the pose holds n, which gives theta1, and the rest is as above.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.errors import NoAngleError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.neighbors import orthogonal
from cuspaudit.kinematics.transform import Column, cross, dot

__all__ = ["CommonDirection", "common_direction", "cos_sin_angle"]


@dataclass(frozen=True)
class CommonDirection:
    """The direction about which the tip has an angle.

    Attributes:
        kind: which of the two theorems holds.
        signs: 1 or -1 for a joint that turns as the last of them does, or against it;
            0 for one that slides, and for a first joint that yaws.
    """

    kind: Literal["parallel axes", "yaw and pitch"]
    signs: tuple[int, ...]


def common_direction(model: ExactModel) -> CommonDirection:
    """The direction that the axes of ``model`` share, tested exactly.

    Args:
        model: four joints, task "position-and-angle".

    Raises:
        NoAngleError: the axes share none.
    """
    signs = _signs(model, 0)
    if signs is not None and any(signs):
        return CommonDirection("parallel axes", signs)
    turning = "prismatic" not in model.chain.kinds
    signs = _signs(model, 1)
    if signs is not None and turning and orthogonal(model, 1):
        return CommonDirection("yaw and pitch", signs)
    raise NoAngleError(tuple(joint.name for joint in model.joints))


def cos_sin_angle(model: ExactModel) -> tuple[Polynomial, Polynomial]:
    """Cosine and sine of the tip's angle, up to a constant turn.

    Raises:
        NoAngleError: the axes share no direction.
    """
    ring = model.ring
    cosine, sine = ring.constant(1), ring.constant(0)
    for joint, sign in zip(model.joints, common_direction(model).signs, strict=True):
        if sign:
            c, s = (ring.gen(name) for name in joint.variables)
            cosine, sine = cosine * c - sine * s * sign, sine * c + cosine * s * sign
    return cosine, sine


def _signs(model: ExactModel, start: int) -> tuple[int, ...] | None:
    """The signs of the joints from ``start`` on, if all their axes are parallel.

    The direction is carried from joint to joint: a slide and a turn about it keep it.
    """
    ring, signs = model.ring, [0] * start
    along: Column | None = None
    for joint in model.joints[start:]:
        along = along and joint.before.inverse().turn(along)
        if joint.kind == "prismatic":
            signs.append(0)
            continue
        along = along or joint.axis
        if any(entry != 0 for entry in cross(ring, along, joint.axis)):
            return None
        signs.append(1 if dot(ring, along, joint.axis) == 1 else -1)
    last = next((sign for sign in reversed(signs) if sign), 0)
    return tuple(sign * last for sign in signs)
