"""A spherical shoulder: the arm taken from tip to base has a spherical wrist.

The pose of base seen from tip is the inverse motion, a diffeomorphism of SE(3):
postures of one pose, singular postures and paths are the same for both.
"""

from __future__ import annotations

from dataclasses import replace

from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.theorems.spherical_wrist import spherical_wrist
from cuspaudit.kinematics.theorems.theorem import Reduction, Theorem
from cuspaudit.robot.chain import reverse

__all__ = ["SPHERICAL_SHOULDER", "spherical_shoulder"]


def spherical_shoulder(model: ExactModel) -> Reduction | None:
    """What the theorem on spherical wrists says of the reversed arm."""
    back = exact_model(reverse(model.chain))
    wrist = spherical_wrist(back)
    if wrist is None:
        return None
    why = wrist.why.replace("4, 5, 6", "1, 2, 3").replace(
        "the first three joints", "the last three joints, taken from tip to base"
    )
    return replace(wrist, kind="spherical shoulder", why=why, is_reversed=True)


SPHERICAL_SHOULDER = Theorem(
    "spherical shoulder",
    "pose",
    6,
    (1, 2, 3),
    "a spherical shoulder (axes 1, 2, 3 concurrent)",
    spherical_shoulder,
)
