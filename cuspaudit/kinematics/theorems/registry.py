"""Exact reductions of a six-joint arm [DESIGN 6.1], and the theorems on four joints.

Each is a theorem; its hypotheses are tested exactly on the model, and its proof is in
the docstring of the function that applies it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal

from cuspaudit.algebra.rationals import exact_rational
from cuspaudit.algebra.ring import Ring
from cuspaudit.kinematics.common_direction import common_direction
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.neighbors import (
    coincide,
    concurrent,
    coplanar,
    crossing,
    direction,
    orthogonal,
    parallel,
)
from cuspaudit.kinematics.theorems.triple_and_pair import triple_and_pair
from cuspaudit.kinematics.transform import Column, Transform, dot
from cuspaudit.robot.chain import Translation, Vector, reverse

__all__ = ["LOOKED_FOR", "Reduction", "reduce_four_joints", "reduce_six_joints"]

LOOKED_FOR = (
    "a spherical wrist (axes 4, 5, 6 concurrent)",
    "a spherical shoulder (axes 1, 2, 3 concurrent)",
    "the UR pattern (axes 2, 3, 4 parallel, a1 = a4 = a5 = 0, right-angle twists)",
    "three axes in a row parallel or concurrent, and two others in a row as well",
)


@dataclass(frozen=True)
class Reduction:
    """A theorem that applies to an arm of four or six joints.

    Attributes:
        kind: its name.
        why: what it says of this arm, one sentence.
        regional: the three-joint arm that decides, or None when the theorem says
            noncuspidal by itself.
        is_equivalent: whether a cuspidal ``regional`` makes the arm cuspidal; a
            noncuspidal one always makes it noncuspidal.
        is_full: whether every regular posture of ``regional`` stands for two of the arm
            in every pose but singular ones.
        aspects: the number of aspects, where the theorem gives it.
        postures: the largest number of postures of a regular pose, likewise.
        is_reversed: whether ``regional`` belongs to the arm taken from tip to base.
    """

    kind: Literal[
        "spherical wrist",
        "spherical shoulder",
        "UR pattern",
        "triple and pair",
        "parallel axes",
        "yaw and pitch",
    ]
    why: str
    regional: ExactModel | None = None
    is_equivalent: bool = True
    is_full: bool = True
    is_reversed: bool = False
    aspects: int | None = None
    postures: int | None = None


def reduce_four_joints(model: ExactModel) -> Reduction:
    """The theorem of `four_joints` that holds for ``model``: it is noncuspidal.

    Args:
        model: four joints, task "position-and-angle"; that det J is not identically 0
            is assumed, and checked by `auditing.answer`.

    Raises:
        NoAngleError: the axes share no direction.
    """
    found = common_direction(model)
    turning = sum(map(abs, found.signs))
    if found.kind == "yaw and pitch":
        why = (
            "axes 2, 3, 4 are parallel and at right angles to axis 1: the signs of the "
            "two factors of det J tell all postures of one position and angle apart"
        )
        return Reduction(found.kind, why)
    why = (
        "all axes that turn are parallel: one position and angle has at most two "
        "postures, with opposite signs of det J"
    )
    return Reduction(found.kind, why, postures={1: 1, 3: 2}.get(turning))


def reduce_six_joints(model: ExactModel) -> Reduction | None:
    """The first theorem whose hypotheses hold exactly for ``model``, or None."""
    kinds = model.chain.kinds
    if len(kinds) != 6:
        return None
    for attempt, turning in (
        (_spherical_wrist, kinds[3:]),
        (_spherical_shoulder, kinds[:3]),
        (_ur_pattern, kinds),
        (_triple_and_pair, kinds),
    ):
        if "prismatic" in turning:
            continue
        reduction = attempt(model)
        if reduction is not None:
            return reduction
    return None


def _spherical_wrist(model: ExactModel) -> Reduction | None:
    """Cuspidal only if the regional 3R arm is; if and only if, for most twists.

    Hypotheses: joints 4, 5, 6 turn; their axes meet in one point W, neighbours not
    parallel. Joints 1, 2, 3 may slide as well (the Stanford arm). Then
    det J = det J3(theta1..3) sin(alpha4) sin(alpha5) sin(theta5), up to the zero of
    theta5, where J3 belongs to the first three joints moving W, so a posture is
    nonsingular when both are. The angle of axes 4 and 6 is known from theta1..3 and the
    orientation, and is cos(alpha4) cos(alpha5) - sin(alpha4) sin(alpha5) cos(theta5):
    the sign of sin(theta5) fixes theta5, then theta4 and theta6 follow.

    Couple => regional couple. The projection of the path to theta1..3 keeps
    det J3 != 0, and both ends hold W in one place. If they agreed in theta1..3, the
    wrists would differ, hence have opposite signs of sin(theta5), which the path cannot
    have: so the ends differ in theta1..3.

    Regional couple => couple, if axis 6 can stand at a right angle to axis 4 with
    sin(theta5) != 0: cos(alpha4)^2 + cos(alpha5)^2 < 1 (the cosine of such a theta5 is
    cot(alpha4) cot(alpha5), in absolute value below 1). Let a path of theta1..3 join
    two postures of one W with det J3 != 0. Some direction z is at a right angle to
    axis 4 in both; choose an orientation with axis 6 along z. Both ends reach it with
    sin(theta5) > 0, which is an arc, so the two wrist postures are joined in it.
    """
    if not concurrent(model, 4):
        return None
    free = _meets_at_right_angles(model)
    exactly = "exactly when" if free else "only if"
    return Reduction(
        "spherical wrist",
        f"axes 4, 5, 6 meet in one point, so the arm is cuspidal {exactly} its first "
        "three joints, moving that point, are",
        _regional(model),
        free,
        orthogonal(model, 4) and orthogonal(model, 5),
    )


def _meets_at_right_angles(model: ExactModel) -> bool:
    """Whether cos(alpha4)^2 + cos(alpha5)^2 < 1, for certain."""
    ring = model.ring
    squares = [dot(ring, model.joints[k].axis, direction(model, k + 1)) for k in (3, 4)]
    total = ring.reduce(1 - ring.total(x * x for x in squares))
    return bool(ring.evaluate(total, {}) > 0)


def _spherical_shoulder(model: ExactModel) -> Reduction | None:
    """The arm taken from tip to base has a spherical wrist.

    The pose of base seen from tip is the inverse motion, a diffeomorphism of SE(3):
    postures of one pose, singular postures and paths are the same for both.
    """
    back = exact_model(reverse(model.chain))
    wrist = _spherical_wrist(back)
    if wrist is None:
        return None
    why = wrist.why.replace("4, 5, 6", "1, 2, 3").replace(
        "its first three joints", "its last three joints, taken from tip to base"
    )
    return replace(wrist, kind="spherical shoulder", why=why, is_reversed=True)


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
    level = parallel(model, 2) and parallel(model, 3)
    square = all(orthogonal(model, i) and coplanar(model, i) for i in (1, 4, 5))
    if not (level and square) or coincide(model, 2) or coincide(model, 3):
        return None
    return Reduction(
        "UR pattern",
        "axes 2, 3, 4 are parallel and axes 1-2, 4-5, 5-6 meet at right angles: the "
        "signs of the three factors of det J tell all postures of a pose apart",
        aspects=8,
    )


def _triple_and_pair(model: ExactModel) -> Reduction | None:
    """Noncuspidal, by the theorem of ``triple_and_pair``."""
    axes = triple_and_pair(model)
    if axes is None:
        return None
    return Reduction(
        "triple and pair",
        f"{axes}: three signs along a nonsingular path tell all postures of a pose "
        "apart",
    )


def _regional(model: ExactModel) -> ExactModel:
    """The first three joints, moving the wrist center.

    Its model is exact; the tool of its chain, which only a search in floating point
    reads, holds the wrist center to the working precision.
    """
    ring, fourth = model.ring, model.joints[3]
    fifth = model.joints[4].before.translation
    along = crossing(model, fourth.axis, direction(model, 4), fifth)
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
