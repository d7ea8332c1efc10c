"""The aspects of an arm of four or six joints, counted exactly and told apart.

det J depends on joints 2 to 5 only, so the aspects of the arm are the components of
{det J != 0} on their torus, times the circles of the first and the last joint. For
almost every industrial arm det J, or each factor of it, is linear along the circle of
joint 2 or 5, and ``geometry.torus.components`` counts them by a theorem, in
milliseconds. Otherwise covers with boxes count them, in seconds to minutes.
"""

from __future__ import annotations

from cuspaudit.count import Count
from cuspaudit.errors import UnableError
from cuspaudit.geometry.torus.components import TorusComponents, torus_components
from cuspaudit.kinematics.exact_model import ExactModel, circle_names
from cuspaudit.kinematics.polynomial_map import jacobian_determinant

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
    determinant = jacobian_determinant(model)
    degrees, index = determinant.degrees(), model.ring.context.variable_to_index
    for joint in model.joints:
        if joint.kind == "prismatic" and degrees[index(joint.variables[0])]:
            raise UnableError("aspects", f"det J depends on {joint.name}, which slides")
    circles = circle_names(model)
    return torus_components(model.ring, circles, determinant, timeout)


def count_aspects(model: ExactModel, timeout: float | None = None) -> Count | None:
    """The number of aspects, proved; None where ``aspect_components`` is unable."""
    try:
        return Count(aspect_components(model, timeout).number_of_components, True)
    except UnableError:
        return None
