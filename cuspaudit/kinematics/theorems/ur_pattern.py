"""The UR pattern: three signs tell the postures of a pose apart.

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

from __future__ import annotations

from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.neighbors import coincide, coplanar, orthogonal, parallel
from cuspaudit.kinematics.theorems.theorem import Reduction, Theorem

__all__ = ["UR_PATTERN", "ur_pattern"]


def ur_pattern(model: ExactModel) -> Reduction | None:
    """Noncuspidal: three signs tell the postures of a pose apart."""
    level = parallel(model, 2) and parallel(model, 3)
    square = all(orthogonal(model, i) and coplanar(model, i) for i in (1, 4, 5))
    if not (level and square) or coincide(model, 2) or coincide(model, 3):
        return None
    return Reduction(
        "UR pattern",
        "axes 2, 3, 4 are parallel and axes 1-2, 4-5, 5-6 meet at right angles: the "
        "signs of the three factors of det J tell all postures of a pose apart",
        aspects=8,
        by_relations=True,
    )


UR_PATTERN = Theorem(
    "UR pattern",
    "pose",
    6,
    (1, 2, 3, 4, 5, 6),
    "the UR pattern (axes 2, 3, 4 parallel, a1 = a4 = a5 = 0, right-angle twists)",
    ur_pattern,
)
