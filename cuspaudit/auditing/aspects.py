"""The aspects of an arm of four or six joints, counted exactly and told apart.

det J depends on joints 2 to 5 only, so the aspects of the arm are the components of
{det J != 0} on their torus, times the circles of the first and the last joint. For
almost every industrial arm det J, or each factor of it, is linear along the circle of
joint 2 or 5, and ``geometry.torus.components`` counts them by a theorem, in
milliseconds. Otherwise covers with boxes count them, in seconds to minutes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from cuspaudit.count import Count
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.fact import fact

if TYPE_CHECKING:
    from cuspaudit.geometry.torus.components import TorusComponents

__all__ = ["aspect_components", "count_aspects"]


def aspect_components(
    model: ExactModel, timeout: float | None = None
) -> TorusComponents:
    """The aspects of an arm with a square task.

    A joint that slides adds a line, which changes nothing while det J is free of it.

    Args:
        model: the arm.
        timeout: of each cover, in seconds of processor time; None for no covers.

    Raises:
        DegenerateMapError: det J vanishes identically.
        UnableError: det J is linear along no circle and no cover settles it, or it
            depends on a joint that slides.
    """
    found = _without_covers(model)
    if not isinstance(found, UnableError):
        return found
    if timeout is None or _slide(model) is not None:
        raise found
    return _counted(model, timeout)


@fact
def _without_covers(model: ExactModel) -> TorusComponents | UnableError:
    """The aspects as a theorem counts them, or why none does."""
    slide = _slide(model)
    if slide is not None:
        return UnableError("aspects", f"det J depends on {slide}, which slides")
    try:
        return _counted(model, None)
    except UnableError as limit:
        return limit


def _counted(model: ExactModel, timeout: float | None) -> TorusComponents:
    from cuspaudit.geometry.torus.components import torus_components  # heavy

    determinant = jacobian_determinant(model)
    return torus_components(model.ring, model.circles, determinant, timeout)


def _slide(model: ExactModel) -> str | None:
    """The name of a joint that slides and that det J depends on."""
    determinant = jacobian_determinant(model)
    degrees, index = determinant.degrees(), model.ring.context.variable_to_index
    for joint in model.joints:
        if joint.kind == "prismatic" and degrees[index(joint.variables[0])]:
            return joint.name
    return None


def count_aspects(model: ExactModel, timeout: float | None = None) -> Count | None:
    """The number of aspects, proved; None where ``aspect_components`` is unable."""
    try:
        return Count(aspect_components(model, timeout).number_of_components, True)
    except UnableError:
        return None
