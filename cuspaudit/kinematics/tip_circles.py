"""The circles on which the second joint of three moves the tip.

Measured from the foot on axis 1 as in `polynomial_map.reduced_map`: with n the
direction of axis 2 and o a point of it, the tip P keeps <n, P - o> and |P - o|^2 while
joint 2 turns; both depend on joint 3 alone.
"""

from __future__ import annotations

from dataclasses import dataclass

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import (
    across_axis,
    reduce_circles,
    reduced_ring,
    tip_from_first_axis,
)
from cuspaudit.kinematics.transform import Column, dot

__all__ = ["TipCircles", "tip_across", "tip_circles"]

Vector = tuple[Polynomial, Polynomial, Polynomial]


@dataclass(frozen=True, eq=False)
class TipCircles:
    """Axes 1 and 2 and the tip, in the ring of the reduced map.

    Attributes:
        axis: the direction of axis 1, a unit vector.
        second: n, a unit vector.
        origin: o.
        height: <n, P - o>.
        square: |P - o|^2.
        across: two coordinates of P across axis 1, in one unit, if joint 1 turns; its
            coordinate along axis 1 if it slides.
    """

    axis: Vector
    second: Vector
    origin: Vector
    height: Polynomial
    square: Polynomial
    across: tuple[Polynomial, ...]


def tip_circles(model: ExactModel) -> TipCircles:
    """The circles of a three-joint position task whose second joint turns."""
    first, second, third = model.joints
    full, ring = model.ring, reduced_ring(model)
    frame, _ = tip_from_first_axis(model)
    own = third.before.apply(model.motion(third).apply(model.tool.apply(_zero(full))))

    def on_circles(p: Polynomial) -> Polynomial:
        return _on_circles(model, p)

    def constant(column: Column) -> Vector:
        a, b, c = (ring.from_other(full.reduce(p), full) for p in column)
        return a, b, c

    return TipCircles(
        constant(first.axis),
        constant(frame.turn(second.axis)),
        constant(frame.translation),
        on_circles(dot(full, second.axis, own)),
        on_circles(dot(full, own, own)),
        tip_across(model),
    )


def tip_across(model: ExactModel) -> tuple[Polynomial, ...]:
    """`TipCircles.across`; joint 2 may slide."""
    full, first = model.ring, model.joints[0]
    _, point = tip_from_first_axis(model)
    lines = [first.axis]
    if first.kind == "revolute":
        lines = list(across_axis(full, first.axis))
    return tuple(_on_circles(model, dot(full, line, point)) for line in lines)


def _on_circles(model: ExactModel, p: Polynomial) -> Polynomial:
    """A function of joints 2 and 3 in the ring of the reduced map."""
    full, (_, *rest) = model.ring, model.joints
    return reduced_ring(model).from_other(
        reduce_circles(full, tuple(rest), full.reduce(p)), full
    )


def _zero(ring: Ring) -> Column:
    return tuple(ring.constant(0) for _ in range(3))
