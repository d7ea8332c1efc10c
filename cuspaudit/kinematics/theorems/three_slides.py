"""Three joints that slide and three that turn, in any order.

Theorem. Six joints, three of which slide and three turn, the pose of the tip, det J not
identically 0: the arm is noncuspidal, and a regular pose has at most two postures.

Proof. A slide turns nothing, so the orientation of the tip depends on the three turns
alone, whose axes have directions a, b, c in the order of the joints. a is fixed in the
base, c in the tip, and the angles between a and b, and b and c, are constants alpha and
beta. So the angle of a and c is known from the pose, and its cosine is
cos alpha cos beta - sin alpha sin beta cos t, with t the middle turn counted from where
the three lie in one plane. det J has the columns of the slides with no angular part, so
it is, up to sign, the determinant of the slides' directions times (a x b).c, which is
sin alpha sin beta sin t. At a nonsingular posture sin t is not 0, so t is known up to
its sign; it is the sign of sin t, which a nonsingular path keeps. With t the direction
b is known up to the first turn, which carries c to its place (a and c are not parallel,
or a, b, c lay in one plane), and the last turn is what is left. Then all directions of
the slides are known, and the tip's place is affine in the slides, with a determinant
that is not 0. So a nonsingular posture is known from its pose and the sign of sin t.

Two is reached: t and -t belong to one orientation, and for almost all of them the
determinant of the slides is not 0 on either side, as it is not identically 0.
"""

from __future__ import annotations

from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.regular import is_regular_somewhere
from cuspaudit.kinematics.theorems.theorem import Reduction, Theorem

__all__ = ["THREE_SLIDES"]


def _apply(model: ExactModel) -> Reduction | None:
    slides = [
        number
        for number, kind in enumerate(model.chain.kinds, 1)
        if kind == "prismatic"
    ]
    if len(slides) != 3 or not is_regular_somewhere(model):
        return None
    names = ", ".join(map(str, slides))
    return Reduction(
        "three slides",
        f"joints {names} slide, so the three others alone turn the tip: at most two "
        "postures have one pose, and det J has opposite signs of one factor in them",
        postures=2,
    )


THREE_SLIDES = Theorem(
    "three slides",
    "pose",
    6,
    (),
    "three joints that slide and three that turn",
    _apply,
)
