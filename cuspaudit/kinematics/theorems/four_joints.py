"""Four joints that place a point and turn the tip about one direction: noncuspidal.

The two theorems and their proofs stand in `kinematics.common_direction`, beside the
direction that they are about. That det J is not identically 0 is assumed.
"""

from __future__ import annotations

from cuspaudit.kinematics.common_direction import common_direction
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.theorems.theorem import Reduction, Theorem

__all__ = ["PARALLEL_AXES", "YAW_AND_PITCH"]


def _parallel_axes(model: ExactModel) -> Reduction | None:
    found = common_direction(model)
    if found.kind != "parallel axes":
        return None
    why = (
        "all axes that turn are parallel: one position and angle has at most two "
        "postures, with opposite signs of det J"
    )
    turning = sum(map(abs, found.signs))
    postures = {1: 1, 3: 2}.get(turning)
    return Reduction(found.kind, why, postures=postures, by_relations=True)


def _yaw_and_pitch(model: ExactModel) -> Reduction | None:
    found = common_direction(model)
    if found.kind != "yaw and pitch":
        return None
    why = (
        "axes 2, 3, 4 are parallel and at right angles to axis 1: the signs of the "
        "two factors of det J tell all postures of one position and angle apart"
    )
    return Reduction(found.kind, why, by_relations=True)


PARALLEL_AXES = Theorem(
    "parallel axes",
    "position-and-angle",
    4,
    (),
    "parallel axes (of all joints that turn)",
    _parallel_axes,
)

YAW_AND_PITCH = Theorem(
    "yaw and pitch",
    "position-and-angle",
    4,
    (1, 2, 3, 4),
    "yaw and pitch (axes 2, 3, 4 parallel, at right angles to axis 1)",
    _yaw_and_pitch,
)
