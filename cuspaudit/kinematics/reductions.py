"""Exact reductions of a six-joint arm [DESIGN 6.1].

Each is a theorem; its hypotheses are tested exactly on the model, and its proof is in
the docstring of the function that applies it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal

from cuspaudit.algebra.rationals import exact_rational
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.kinematics.chain import Translation, Vector, reverse
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.transform import Column, Transform, cross, dot

__all__ = ["LOOKED_FOR", "Reduction", "reduce_six_joints"]

LOOKED_FOR = (
    "a spherical wrist with right-angle twists (axes 4, 5, 6 concurrent)",
    "a spherical shoulder with right-angle twists (axes 1, 2, 3 concurrent)",
    "the UR pattern (axes 2, 3, 4 parallel, a1 = a4 = a5 = 0, right-angle twists)",
    "axes 2, 3, 4 parallel and axes 5, 6 concurrent",
    "axes 3, 4, 5 parallel and axes 1, 2 concurrent",
)


@dataclass(frozen=True)
class Reduction:
    """A theorem that applies to a six-joint arm.

    Attributes:
        kind: its name.
        why: what it says of this arm, one sentence.
        regional: the three-joint arm that decides, or None when the theorem says
            noncuspidal by itself.
        aspects: the number of aspects, where the theorem gives it.
        is_reversed: whether ``regional`` belongs to the arm taken from tip to base.
    """

    kind: Literal[
        "spherical wrist",
        "spherical shoulder",
        "UR pattern",
        "parallel and meeting axes",
    ]
    why: str
    regional: ExactModel | None = None
    is_reversed: bool = False
    aspects: int | None = None


def reduce_six_joints(model: ExactModel) -> Reduction | None:
    """The first theorem whose hypotheses hold exactly for ``model``, or None."""
    if model.chain.kinds != ("revolute",) * 6:
        return None
    for attempt in (
        _spherical_wrist,
        _spherical_shoulder,
        _ur_pattern,
        _parallel_and_meeting,
        _meeting_and_parallel,
    ):
        reduction = attempt(model)
        if reduction is not None:
            return reduction
    return None


def _spherical_wrist(model: ExactModel) -> Reduction | None:
    """Cuspidal if and only if the regional 3R arm is.

    Hypotheses: axes 4, 5, 6 meet in one point W; axes 4 and 5, and 5 and 6, are
    orthogonal. Then det J = +-det J3(theta1..3) sin(theta5 + const), where J3 belongs
    to the first three joints moving W, so a posture is nonsingular when both are.

    Regional couple => couple. Let a path of theta1..3 join two postures of one W with
    det J3 != 0. Start with the wrist at sin > 0. At the end the wanted orientation is
    reached by a wrist posture with sin >= 0 (Euler angles reach every rotation, and
    (theta4 + pi, -theta5, theta6 + pi) is the other one); for all but one circle of
    orientations sin > 0, and the start is free to choose. {sin > 0} is connected, so
    the two wrist postures are joined in it.

    Couple => regional couple. The projection of the path to theta1..3 keeps
    det J3 != 0, and both ends hold W in one place. If they agree in theta1..3, the
    wrists differ, hence have opposite signs of sin (two wrist postures of one
    orientation do), which the path cannot: so the ends differ in theta1..3.
    """
    if not (_orthogonal(model, 4) and _meet(model, 4)):
        return None
    if not (_orthogonal(model, 5) and _meet(model, 5)):
        return None
    fifth, sixth = model.joints[4], model.joints[5]
    here = -dot(model.ring, fifth.before.translation, _direction(model, 4))
    there = dot(model.ring, sixth.before.translation, fifth.axis)
    if model.ring.reduce(here - there) != 0:
        return None
    return Reduction(
        "spherical wrist",
        "axes 4, 5, 6 meet in one point at right angles, so the arm is cuspidal "
        "exactly when its first three joints, moving that point, are",
        _regional(model),
    )


def _spherical_shoulder(model: ExactModel) -> Reduction | None:
    """The arm taken from tip to base has a spherical wrist.

    The pose of base seen from tip is the inverse motion, a diffeomorphism of SE(3):
    postures of one pose, singular postures and paths are the same for both.
    """
    back = exact_model(reverse(model.chain))
    wrist = _spherical_wrist(back)
    if wrist is None:
        return None
    return Reduction(
        "spherical shoulder",
        "axes 1, 2, 3 meet in one point at right angles, so the arm is cuspidal "
        "exactly when its last three joints, taken from tip to base, are",
        wrist.regional,
        is_reversed=True,
    )


def _ur_pattern(model: ExactModel) -> Reduction | None:
    """Noncuspidal: three signs tell the postures of a pose apart.

    Hypotheses: axes 2, 3, 4 parallel; axes 1 and 2, 4 and 5, 5 and 6 meet at right
    angles; axes 2 and 3, and 3 and 4, do not coincide. Then
    det J = -a2 a3 s3 s5 E with E = a2 c2 + a3 c23 + d5 sin(theta2 + theta3 + theta4)
    (up to signs and joint zeros), E the coordinate of the point Q where axes 5 and 6
    meet, across axis 1 in the plane orthogonal to axis 2. Given the pose, Q is known.
    Its distance from axis 1 is sqrt(E^2 + d^2), d constant, so |E| is known and the
    sign of E fixes theta1. Then the angle between axis 6 and axis 2 gives cos theta5,
    the sign of s5 fixes theta5, and with s5 != 0 theta6 and theta2 + theta3 + theta4
    follow. Last, joints 2, 3 are a planar arm with known end, whose elbow the sign of
    s3 fixes. So a nonsingular posture is known from its pose and three signs, which
    are constant along a nonsingular path: two postures of one pose in one aspect are
    equal [Capco, Safey El Din, Schicho, ISSAC 2020].

    The eight sign triples are the aspects: each is connected. s5 depends on theta5
    alone. With rho = |a2 + a3 e^(i theta3)|, x = theta2 shifted by the argument of
    that number, and y = theta2 + theta3 + theta4, E = rho cos x + d5 sin y, and rho is
    not 0 where s3 is not. Over each theta3 with s3 > 0 the set E > 0 is connected (for
    every y, or for every x if |d5| is the larger, one arc, never empty for all), and
    it contains the point where both terms are largest, which moves continuously.
    (d5 = 0 does not occur here: axes 4, 5, 6 would meet, a spherical wrist.)
    """
    parallel = _parallel(model, 2) and _parallel(model, 3)
    square = all(_orthogonal(model, i) and _meet(model, i) for i in (1, 4, 5))
    if not (parallel and square) or _coincide(model, 2) or _coincide(model, 3):
        return None
    return Reduction(
        "UR pattern",
        "axes 2, 3, 4 are parallel and axes 1-2, 4-5, 5-6 meet at right angles: the "
        "signs of the three factors of det J tell all postures of a pose apart",
        aspects=8,
    )


def _parallel_and_meeting(model: ExactModel) -> Reduction | None:
    """Noncuspidal: as for the UR pattern, three signs tell the postures apart.

    Hypotheses: axes 2, 3, 4 parallel, neighbours distinct; axes 5 and 6 meet in a
    point Q; axes 1 and 2, 4 and 5, 5 and 6 not parallel. Nothing is asked of a1, a4
    or the twists 1, 4, 5.

    Let u be the direction of axes 2, 3, 4 and w that of axis 1, x the coordinate along
    u x w / |u x w| of Q from a point of axis 1, alpha_i the angle from axis i to i + 1.
    Q, on axes 5 and 6, is at rest in link 4 and in the tip.

    det J = +- sin alpha1 sin alpha4 sin alpha5 a2 a3 s3 s5 x. Take velocities at Q:
    joints 5 and 6 give none. Subtract column 4 from 2 and 3: they become translations
    v2, v3 across u, whose product with u is a2 a3 s3. Of the Laplace products one is
    left, det(v1, v2, v3) det(u, z5, z6), as v2, v3 and that of joint 4 lie in a plane;
    u . v1 = u . (w x Q) = sin alpha1 x, and det(u, z5, z6) = sin alpha4 sin alpha5 s5.

    The signs fix the posture. The pose gives Q, hence w . Q and its distance from axis
    1. In link 1, Q = x e + y e' + D u with e = u x w / |u x w|, e' = u x e; D is
    constant, w . Q = D cos alpha1 + y sin alpha1 gives y, the distance then x^2, so
    with its sign Q in link 1, hence theta1. Then u . z6 = cos alpha4 cos alpha5 -
    sin alpha4 sin alpha5 cos theta5 and the sign of s5 give theta5. As s5 is not 0, z6
    and u are not parallel; so the direction of z6 gives theta2 + theta3 + theta4, and
    theta6 is left. Now axis 4 is placed, and joints 2 and 3 are a planar arm whose
    elbow the sign of s3 fixes. On a nonsingular path the three signs are constant.
    """
    if not (_parallel(model, 2) and _parallel(model, 3) and _meet(model, 5)):
        return None
    if any(_coincide(model, i) for i in (2, 3)):
        return None
    if any(_parallel(model, i) for i in (1, 4, 5)):
        return None
    return Reduction(
        "parallel and meeting axes",
        "axes 2, 3, 4 are parallel and axes 5, 6 meet: the signs of the three factors "
        "of det J tell all postures of a pose apart",
    )


def _meeting_and_parallel(model: ExactModel) -> Reduction | None:
    """The arm taken from tip to base has parallel and meeting axes."""
    reduction = _parallel_and_meeting(exact_model(reverse(model.chain)))
    if reduction is None:
        return None
    why = reduction.why.replace("2, 3, 4", "3, 4, 5").replace("5, 6", "1, 2")
    return replace(reduction, why=why, is_reversed=True)


def _regional(model: ExactModel) -> ExactModel:
    """The first three joints, moving the wrist center.

    Its model is exact; the tool of its chain, which only a search in floating point
    reads, holds the wrist center to the working precision.
    """
    ring, fourth = model.ring, model.joints[3]
    along = dot(ring, model.joints[4].before.translation, fourth.axis)
    center = fourth.before.apply(tuple(along * x for x in fourth.axis))
    tool = Transform(ring, fourth.before.rotation, center)
    step = Translation(_near(ring, tuple(along * x for x in fourth.axis)))
    chain = replace(
        model.chain.with_joints(model.chain.joints[:3]),
        task="position",
        tool=(*model.chain.joints[3].before, step),
    )
    return replace(model, chain=chain, joints=model.joints[:3], tool=tool)


def _near(ring: Ring, point: Column) -> Vector:
    values = (exact_rational(ring.evaluate(entry, {})) for entry in point)
    x, y, z = (Fraction(int(v.p), int(v.q)) for v in values)
    return (x, y, z)


def _direction(model: ExactModel, number: int) -> Column:
    """The axis after joint ``number``, in the frame of that joint."""
    following = model.joints[number]
    return following.before.turn(following.axis)


def _pair(
    model: ExactModel,
    number: int,
    test: Callable[[Column, Column], Polynomial | Column],
) -> bool:
    value = test(model.joints[number - 1].axis, _direction(model, number))
    entries = value if isinstance(value, tuple) else (value,)
    return all(model.ring.reduce(entry) == 0 for entry in entries)


def _orthogonal(model: ExactModel, number: int) -> bool:
    """Whether axes ``number`` and ``number`` + 1 are at right angles."""
    return _pair(model, number, lambda a, b: dot(model.ring, a, b))


def _parallel(model: ExactModel, number: int) -> bool:
    """Whether axes ``number`` and ``number`` + 1 are parallel."""
    return _pair(model, number, lambda a, b: cross(model.ring, a, b))


def _meet(model: ExactModel, number: int) -> bool:
    """Whether axes ``number`` and ``number`` + 1 lie in one plane."""
    ring, step = model.ring, model.joints[number].before.translation
    return _pair(model, number, lambda a, b: dot(ring, step, cross(ring, a, b)))


def _coincide(model: ExactModel, number: int) -> bool:
    """Whether two parallel axes are one line."""
    ring, step = model.ring, model.joints[number].before.translation
    return _pair(model, number, lambda a, b: cross(ring, step, a))
