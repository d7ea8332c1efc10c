"""Postures to look at when there is no path: those of one pose, one aspect a colour."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cuspaudit.audit.answer import Answer
from cuspaudit.audit.lift import lift_position, lift_wrist
from cuspaudit.audit.report import Audit
from cuspaudit.cuspidality.witness import SurfacePath, posture_angles
from cuspaudit.errors import RetryableError
from cuspaudit.kinematics.chain import reverse

__all__ = ["shown_postures"]

Array = NDArray[np.float64]


def shown_postures(audit: Audit) -> tuple[list[list[float]], list[int]]:
    """Postures of one pose and the number of the aspect of each.

    For a three-joint arm, or one reduced to it, all the postures of the sample value
    with the most of them (with a wrist, one of the two it has each time). Otherwise
    one posture, with every joint at 0.2 rad or a fifth of a unit.
    """
    answer = audit.answer
    if answer.decision is None:
        return [[0.2] * len(audit.chain.joints)], [0]
    fiber = max(answer.decision.samples, key=lambda fiber: len(fiber.postures))
    ends = [posture_angles(answer.decision, p) for p in fiber.postures]
    postures, groups = [], []
    for end, posture in zip(ends, fiber.postures, strict=True):
        path = SurfacePath(np.array([ends[0], end]), 1, 1.0, 1.0, 1.0)
        try:
            postures.append([float(v) for v in _last(answer, path)])
        except RetryableError:
            continue
        groups.append(answer.decision.graph.aspect(posture))
    return postures, groups


def _last(answer: Answer, path: SurfacePath) -> Array:
    """The posture of all joints at the end of a two-point path of joints 2 and 3."""
    reduction, chain = answer.reduction, answer.model.chain
    if reduction is None or reduction.regional is None:
        return np.asarray(lift_position(answer.model, path)[-1])
    regional = lift_position(reduction.regional, path)
    if reduction.is_reversed:
        return np.asarray(lift_wrist(reverse(chain), regional, (0.0,))[-1, ::-1])
    return np.asarray(lift_wrist(chain, regional, (0.0,))[-1])
