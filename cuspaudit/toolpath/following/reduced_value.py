"""The value of a place of the tip under the plane map of three joints."""

from __future__ import annotations

from collections.abc import Sequence

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import across_axis
from cuspaudit.kinematics.transform import dot

__all__ = ["reduced_value"]


def reduced_value(
    model: ExactModel, ring: Ring, place: Sequence[Polynomial]
) -> tuple[Polynomial, Polynomial]:
    """The value of `kinematics.polynomial_map.reduced_map` at the postures of a place.

    Args:
        model: three joints, task "position".
        ring: any ring over the field of the model.
        place: the tip's position in the base frame, three elements of the ring.
    """
    full, [first, second, _] = model.ring, model.joints
    back = first.before.inverse()
    rows = [[ring.from_other(x, full) for x in row] for row in back.rotation]
    origin = [ring.from_other(x, full) for x in back.translation]
    point = tuple(
        dot(ring, tuple(row), tuple(place)) + t
        for row, t in zip(rows, origin, strict=True)
    )
    if first.kind == "revolute":
        axis = tuple(ring.from_other(x, full) for x in first.axis)
        # from the foot of joint 2 on axis 1, as in the map
        along = dot(full, first.axis, second.before.translation)
        foot = ring.from_other(along, full)
        point = tuple(p - foot * a for p, a in zip(point, axis, strict=True))
        return dot(ring, point, point), dot(ring, axis, point)
    e, f = (
        tuple(ring.from_other(x, full) for x in unit)
        for unit in across_axis(full, first.axis)
    )
    return dot(ring, e, point), dot(ring, f, point)
