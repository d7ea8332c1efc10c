"""A spherical wrist: the arm is as cuspidal as its first three joints.

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

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from cuspaudit.algebra.rationals import exact_rational
from cuspaudit.algebra.ring import Ring
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.neighbors import (
    concurrent,
    crossing,
    direction,
    orthogonal,
)
from cuspaudit.kinematics.theorems.theorem import Reduction, Theorem
from cuspaudit.kinematics.transform import Column, Transform, cross, dot
from cuspaudit.robot.chain import Translation, Vector

__all__ = ["SPHERICAL_WRIST", "spherical_wrist"]


def spherical_wrist(model: ExactModel) -> Reduction | None:
    """Cuspidal only if the regional 3R arm is; if and only if, for most twists."""
    if not concurrent(model, 4):
        return None
    free = _meets_at_right_angles(model)
    # however it is wrapped, no line of it may read as a verdict
    weight = "decide the arm" if free else "may prove it noncuspidal"
    return Reduction(
        "spherical wrist",
        f"axes 4, 5, 6 meet in one point, and the first three joints, which move that "
        f"point, {weight}",
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


def _regional(model: ExactModel) -> ExactModel:
    """The first three joints, moving the wrist center.

    The tool of its chain, which only a search in floating point reads, holds the wrist
    center to the working precision. What was approximated in the wrist itself does not
    move that center where the frame of axis 5 lies on axis 4.
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
    approximations = model.approximations
    if not any(cross(ring, fifth, fourth.axis)):
        approximations = tuple(a for a in approximations if a.joint <= 4)
    return replace(
        model,
        chain=chain,
        joints=model.joints[:3],
        tool=tool,
        approximations=approximations,
    )


def _near(ring: Ring, point: Column) -> Vector:
    values = (exact_rational(ring.evaluate(entry, {})) for entry in point)
    x, y, z = (Fraction(int(v.p), int(v.q)) for v in values)
    return (x, y, z)


SPHERICAL_WRIST = Theorem(
    "spherical wrist",
    "pose",
    6,
    (4, 5, 6),
    "a spherical wrist (axes 4, 5, 6 concurrent)",
    spherical_wrist,
)
