"""Three joints without offsets, at every value of a locked joint: noncuspidal.

Theorem. Three joints turn and place a point P, det J is not identically 0; axis 2 is
square to axis 1; with F the point of axis 2 that is nearest to axis 1, and G the foot
of P on axis 3, F G has no part along axis 2; and F G has no part along axis 3, or axes
2 and 3 are square as well. Then the arm is noncuspidal.

(In Denavit and Hartenberg's numbers: alpha1 = 90 deg, d2 = 0, and d3 = 0 or alpha2 = 90
deg [Wenger, Robotica 2007].)

Proof. Let e, n, m be the unit vectors along axes 1, 2, 3, a the distance of axes 1 and
2, and k = G - F; if a = 0 the axes meet, which decides [`neighbouring_axes`]. P is at
F + g(t), g(t) = k + r(t), t the value of joint 3, where r(t) turns about m in the plane
across it. n . k = 0, so y(t) = n . g(t) = n . r(t), which is Y sin(t - t0), with t0 the
value at which r lies along w = n x m (if w = 0 then Y = 0, and t0 is where r lies along
k). Next, |g|^2 = |k|^2 + |r|^2 + 2 k . r(t). If k . m = 0, k is across n and m, along
w; if n is square to m, the part of k across m is across n, along w too. So |g|^2 =
A + B u, with u = cos(t - t0), and y^2 = Y^2 (1 - u^2).

Joint 2 turns g about n. Write F + g, seen from the foot of F on axis 1, as
(a + p, y, z) along the common normal, n and e (joint 2 has any value): z and
L = |P|^2 - a^2 = 2 a p + A + B u are known from P, and p^2 + z^2 = S(u) with S(u) =
A + B u - Y^2 (1 - u^2). So p = (L - A - B u) / (2 a) is affine in u, and u is a zero of
q(u) = p^2 + z^2 - S(u), of degree at most 2, whose coefficients are known; q' =
-(B p + a S') / a. Up to constants, det J is the Jacobian of (L, z) in joints 2 and 3.
Joint 2 changes (p, z) by (-z, p), up to sign, and L by -2 a z. With D for the
derivative by joint 3 the determinant is -2 a z Dz - (2 a Dp + B Du) p =
-Du (a S' + B p) = a Du q'(u), and Du = -sin(t - t0).

On a nonsingular path both factors keep their signs. Two postures of one P in one aspect
are zeros of one q with derivatives of one sign: u is one. With the sign of sin(t - t0)
t is one. Then p and z are known, and joint 2 is what carries g there, unless g is along
n: then joint 2 does not move P, and the posture is singular. Last, P is not on axis 1.
So the postures are equal.
"""

from __future__ import annotations

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.kinematics.locked.axes import square
from cuspaudit.kinematics.locked.locked_arm import LockedArm
from cuspaudit.kinematics.neighbors import direction
from cuspaudit.kinematics.transform import Column, dot

__all__ = ["has_no_offset"]


def has_no_offset(held: LockedArm, point: tuple[Column, Polynomial]) -> bool:
    """Whether the first three joints meet the hypotheses at every value of the lock.

    That det J is not identically 0 is assumed.

    Args:
        held: whose first three joints turn.
        point: what they place, in the moved frame of joint 3: (vector, below), the
            point is vector / below.
    """
    if not square(held, 1):
        return False
    ring = held.arm.ring
    second, third = held.arm.joints[1:3]
    vector, below = point
    # in the moved frame of joint 2; F = along n
    n, m = second.axis, direction(held.arm, 2)
    along = dot(ring, n, second.before.inverse().translation)
    share = dot(ring, vector, third.axis)
    k = tuple(
        below * (p - along * a) + share * b
        for p, a, b in zip(third.before.translation, n, m, strict=True)
    )
    if not held.vanishes(dot(ring, n, k)):
        return False
    return held.vanishes(dot(ring, m, k)) or square(held, 2)
