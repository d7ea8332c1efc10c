"""The postures of one pose by aspect: cuspidality without a path.

Two postures of one pose in one aspect make an arm cuspidal; so do more postures than
there are aspects. Both the postures and their aspects are exact here: no path is
searched, and none is given.
"""

from __future__ import annotations

from collections.abc import Sequence

from cuspaudit.algebra.parametrization import RealPoint
from cuspaudit.algebra.ring import Rational
from cuspaudit.algebra.univariate import PRECISIONS
from cuspaudit.audit.aspects import aspect_components
from cuspaudit.errors import PrecisionError
from cuspaudit.geometry.torus_components import TorusComponents
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.exact_postures import exact_postures

__all__ = ["crowded_aspects", "postures_by_aspect"]

Label = tuple[int, ...]


def postures_by_aspect(
    model: ExactModel, tangents: Sequence[Rational], timeout: float | None = None
) -> dict[Label, list[RealPoint]]:
    """The postures of the pose of a rational posture, by the aspect they lie in.

    Args:
        model: six revolute joints, over Q.
        tangents: tan(theta_i / 2) of the posture, theta_i the variables of the model.
        timeout: of covers, as in ``aspect_components``.

    Returns:
        label of the aspect -> postures. Two postures under one label prove the arm of
        the model cuspidal. Complete: every posture of the pose is there.

    Raises:
        UnableError: the postures or the aspects are out of reach.
        PrecisionError: a posture is too near to a singular one to be placed.
    """
    components = aspect_components(model, timeout)
    found: dict[Label, list[RealPoint]] = {}
    for posture in exact_postures(model, tangents).real_points():
        found.setdefault(_label(components, posture), []).append(posture)
    return found


def crowded_aspects(found: dict[Label, list[RealPoint]]) -> dict[Label, int]:
    """The aspects with more than one posture of the pose, and how many."""
    return {label: len(here) for label, here in found.items() if len(here) > 1}


def _label(components: TorusComponents, posture: RealPoint) -> Label:
    for bits in PRECISIONS:
        label = components.component(posture.ball(bits))
        if label is not None:
            return label
    raise PrecisionError("aspect of a posture", PRECISIONS[-1])
