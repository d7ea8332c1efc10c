"""The theorems that decide an arm, or lead to a smaller one [mathematics 6.1].

To add one: a file beside this one, with its proof, and a line here. Its certificate is
written elsewhere; CONTRIBUTING.md says where.
"""

from __future__ import annotations

from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.theorems.four_joints import PARALLEL_AXES, YAW_AND_PITCH
from cuspaudit.kinematics.theorems.plane_and_pair import PLANE_AND_PAIR
from cuspaudit.kinematics.theorems.spherical_shoulder import SPHERICAL_SHOULDER
from cuspaudit.kinematics.theorems.spherical_wrist import SPHERICAL_WRIST
from cuspaudit.kinematics.theorems.theorem import Reduction, Theorem
from cuspaudit.kinematics.theorems.three_slides import THREE_SLIDES
from cuspaudit.kinematics.theorems.triple_and_pair import TRIPLE_AND_PAIR
from cuspaudit.kinematics.theorems.ur_pattern import UR_PATTERN

__all__ = ["THEOREMS", "looked_for", "reduction_of"]

THEOREMS: tuple[Theorem, ...] = (
    SPHERICAL_WRIST,
    SPHERICAL_SHOULDER,
    UR_PATTERN,
    TRIPLE_AND_PAIR,
    THREE_SLIDES,
    PLANE_AND_PAIR,
    PARALLEL_AXES,
    YAW_AND_PITCH,
)
"""In the order in which they are tried."""


def reduction_of(model: ExactModel) -> Reduction | None:
    """What the first theorem says whose hypotheses hold exactly for ``model``.

    Args:
        model: a virtual joint included; that det J is not identically 0 is assumed of
            four joints, and not checked.

    Raises:
        NoAngleError: four joints with an angle, whose axes share no direction.
    """
    for theorem in THEOREMS:
        if theorem.speaks_of(model.chain):
            reduction = theorem.apply(model)
            if reduction is not None:
                return reduction
    return None


def looked_for(task: str) -> tuple[str, ...]:
    """The structures that theorems on arms with such a task ask for."""
    return tuple(each.looked_for for each in THEOREMS if each.task == task)
