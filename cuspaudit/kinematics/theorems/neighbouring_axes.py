"""Three joints that place a point, with two axes in a row that are parallel or meet.

Theorem. Three revolute joints, the position of the tip p, det J not identically 0; axes
1 and 2, or axes 2 and 3, are parallel or meet: the arm is noncuspidal [Wenger,
Robotica 2007].

Proof. In each case a nonsingular posture is known from p and two signs that are
constant along a nonsingular path, so two postures of one p in one aspect are equal. A
function A cos + B sin + C of an angle takes a value at two angles at most, with
derivatives of opposite signs if these are not 0: where the derivative does not vanish
at a nonsingular posture, its sign fixes the angle. At a nonsingular posture p is not on
axis 1, or joint 1 would not move it; so theta1 is known when the others are. Let O be
a point of axis 1 and z its direction. Up to constants, det J is the Jacobian of
|p - O|^2 and z.(p - O) in theta2, theta3 (`polynomial_map.reduced_map`).

Axes 1, 2 parallel: z.(p - O) does not depend on theta2, so det J is its derivative by
theta3 times that of |p - O|^2 by theta2. The sign of the first fixes theta3, then that
of the second theta2.

Axes 1, 2 meet in O: the same, with |p - O|^2 and z.(p - O) exchanged.

Axes 2, 3 parallel, and axis 1 not: let O be the foot of the common normal e of axes 1
and 2, of length a, u the direction of axis 2 and f = u x e. The tip is at
O + (a + X) e + Y f + h u with h constant, z has no part along e, so Y is known from
z.(p - O) and (a + X)^2 from |p - O|^2. (X, Y) is the tip of a planar arm with links
l2, l3, so det J is a constant times (a + X) l2 l3 sin(theta3), theta3 counted from
where the links are in line. The sign of a + X fixes X; X^2 + Y^2 gives cos(theta3), the
sign of sin(theta3) gives theta3, and then theta2 follows, as X^2 + Y^2 = 0 would need
sin(theta3) = 0.

Axes 2, 3 meet in M: with r = p - M, the columns of J for joints 2, 3 are u2 x r and
u3 x r, so det J is +-(r.(u2 x u3)) times r.(z x (p - O)). M is known from theta1, and
the second factor is r.(z x (M - O)), up to a constant the derivative by theta1 of
|p - M|^2 for p at rest, which has a constant value: its sign fixes theta1. Then u2.r is
known, and its derivative by theta3 is +-r.(u2 x u3), whose sign fixes theta3. Last, r
is not along axis 2, so theta2 is what carries r to its place.

Aspects, where axes 2, 3 are parallel and axis 1 is not: with rho(theta3) the length of
(X, Y), the part a + X > 0 (take a >= 0) over a theta3 is an arc or a circle of theta2,
with X = rho in it, so over the half circle sin(theta3) > 0 it is connected. The part
a + X < 0 is an arc with X = -rho in it where rho > a, which is an interval of that half
circle, since rho falls there from l2 + l3; it is empty if a >= l2 + l3. The half circle
sin(theta3) < 0 has as many. So there are 4 aspects, or 2 if a > l2 + l3.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from flint import arb

from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.neighbors import coplanar, direction, parallel
from cuspaudit.kinematics.regular import is_regular_somewhere
from cuspaudit.kinematics.theorems.theorem import Reduction, Theorem
from cuspaudit.kinematics.transform import Column, cross, dot

__all__ = ["NEIGHBOURING_AXES", "aspects_of_parallel_axes", "neighbouring_axes"]


def neighbouring_axes(model: ExactModel) -> str | None:
    """Which axes meet the hypotheses of the theorem, or None; tested exactly.

    That det J is not identically 0 is assumed.

    Args:
        model: three joints, task "position".
    """
    if set(model.chain.kinds) != {"revolute"}:
        return None
    for first in (1, 2):
        if coplanar(model, first):
            word = "are parallel" if parallel(model, first) else "meet"
            return f"axes {first}, {first + 1} {word}"
    return None


def aspects_of_parallel_axes(model: ExactModel) -> int | None:
    """The number of aspects where axes 2 and 3 are parallel and axis 1 is not.

    None for other arms, and where balls do not tell a from l2 + l3.

    Args:
        model: three joints that turn, task "position"; det J not identically 0.
    """
    if parallel(model, 1) or not parallel(model, 2):
        return None
    first, second, third = model.joints
    normal = cross(model.ring, first.axis, direction(model, 1))
    between = dot(model.ring, second.before.translation, normal)
    offset = _length(model, (between,)) / _length(model, normal)
    links = (
        _length(model, cross(model.ring, joint.axis, step))
        for joint, step in (
            (second, third.before.translation),
            (third, model.tool.translation),
        )
    )
    left = sum(links, start=-offset)
    if left > 0:
        return 4
    return 2 if left < 0 else None


def _length(model: ExactModel, vector: Column) -> arb:
    """The length of a constant vector."""
    square = model.ring.reduce(dot(model.ring, vector, vector))
    return model.ring.evaluate(square, {}).sqrt()


def _apply(
    test: Callable[[ExactModel, int], bool], first: int, name: str, model: ExactModel
) -> Reduction | None:
    if not test(model, first) or not is_regular_somewhere(model):
        return None
    why = f"{name}: two signs along a nonsingular path tell all postures of a place"
    return Reduction(name, f"{why} apart")


def _theorem(first: int, word: str, test: Callable[[ExactModel, int], bool]) -> Theorem:
    name = f"axes {first} and {first + 1} {word}"
    apply = partial(_apply, test, first, name)
    return Theorem(name, "position", 3, (1, 2, 3), name, apply)


NEIGHBOURING_AXES: dict[tuple[int, str], Theorem] = {
    (first, kind): _theorem(first, word, test)
    for first in (1, 2)
    for kind, word, test in (
        ("parallel", "parallel", parallel),
        ("meet", "meeting", coplanar),
    )
}
"""The theorem, one for each relation, by the number of its first axis and the verb.

They are not in the registry: Algorithm 1 decides three joints, and counts more.
"""
