"""Which aspect within limits a posture of three joints lies in, proved.

The aspects of the box of joints 2 and 3 are components of an exact graph
(`surface.box_aspects`); joint 1 moves no det J, and within its limits it is a factor. A
posture is labelled by a point a hair beside it, rational in the charts: between the two
det J keeps its sign, in balls. Two boxes stand for the one that the limits give: one
that contains it, in which postures of two labels are apart, and one inside it, in which
postures of one label are joined.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from flint import arb, ctx

from cuspaudit.algebra.ring import rational
from cuspaudit.auditing.limits.joint_limits import has_limits, limit_of, ranges_of
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.errors import AssumptionError, RetryableError, UnableError
from cuspaudit.kinematics.exact_model import ExactJoint
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.robot.chain import Angle
from cuspaudit.runtime.clock import check_time
from cuspaudit.surface.box_aspects import (
    BoxAspects,
    Place,
    box_aspects,
    charted_box,
    of_factors,
)
from cuspaudit.surface.box_edges import ZERO, Edge, Limit, edge_of
from cuspaudit.surface.surface import Factor, Surface
from cuspaudit.toolpath.ball_arm import angle_ball
from cuspaudit.toolpath.joint_pose import JointValue, value_balls
from cuspaudit.toolpath.traced_arm import TracedArm

__all__ = ["BoxLabels", "box_labels"]

_BITS = 256
_STEPS = (Fraction(0), Fraction(1, 30), Fraction(-1, 30))
"""Where the chart of a circle ends within 1/64, a posture is looked at from beside."""


@dataclass(frozen=True, eq=False)
class BoxLabels:
    """The aspects of an arm of three joints within its limits.

    Attributes:
        arm: the arm, its model exact.
        surface: of joints 2 and 3, with the charts of the boxes.
        outer: the aspects of a box that contains the limits.
        inner: those of one inside them; None where there is none.
    """

    arm: TracedArm
    surface: Surface
    outer: BoxAspects
    inner: BoxAspects | None

    def label(self, values: Sequence[JointValue], *, inside: bool) -> int | None:
        """The number of the aspect of joint values in a box; None where not told.

        Args:
            values: exact, within the limits.
            inside: whether of the inner box.
        """
        found = self.inner if inside else self.outer
        if found is None:
            return None
        for steps in product(_STEPS, _STEPS):
            with suppress(RetryableError):
                place = self._place(found, values, steps)
                if place is not None:
                    return found.aspects[place]
        return None

    def _place(
        self,
        found: BoxAspects,
        values: Sequence[JointValue],
        steps: tuple[Fraction, Fraction],
    ) -> Place | None:
        """The vertex of a point beside the posture, by steps on fiber and base."""
        fiber = self._beside(values, self.surface.fiber, steps[0])
        base = self._beside(values, self.surface.base, steps[1])
        if not self._keeps_sign(values, fiber, base):
            return None
        sign = _sign(found, fiber, base)
        return found.place_at(fiber, base, sign) if sign else None

    def _beside(
        self, values: Sequence[JointValue], factor: Factor, step: Fraction
    ) -> Edge:
        """A rational point of a chart a step and a hair above the value of its joint.

        Raises:
            RetryableError: it is where the chart of a circle ends.
        """
        k, joint = self._joint(factor)
        value = values[k]
        if isinstance(value, Angle):
            there = value + joint.zero + Angle(radians=step)
            return edge_of(limit_of(there), factor, up=True)
        return edge_of(Limit(ZERO, rational(value + step)), factor, up=True)

    def _joint(self, factor: Factor) -> tuple[int, ExactJoint]:
        joints = self.arm.model.joints
        return next((k, j) for k, j in enumerate(joints) if factor.names == j.variables)

    def _keeps_sign(
        self, values: Sequence[JointValue], fiber: Edge, base: Edge
    ) -> bool:
        """Whether det J is not 0 between the posture and the point beside it."""
        with ctx.workprec(_BITS):
            box = value_balls(values)
            for edge in (fiber, base):
                k, joint = self._joint(edge.factor)
                zero = angle_ball(joint.zero) if joint.kind == "revolute" else arb(0)
                box[k] = box[k].union(edge.ball(_BITS) - zero)
            scaled = [
                value / arb(scale)
                for value, scale in zip(box, self.arm.balls.scales, strict=True)
            ]
            return not self.arm.determinant(scaled).contains(0)


def box_labels(arm: TracedArm) -> BoxLabels | None:
    """The aspects of an arm within its limits; None where they are not told exactly."""
    model = arm.model
    if arm.task != "position" or not model.is_exact or not has_limits(model.chain):
        return None
    try:
        check_time("aspects")
        _, second, third = ranges_of(model)
        surface, delta = oriented(*reduced_map(model))
        ranges = of_factors(surface, (second, third))
        surface, outer, inner = charted_box(surface, delta, ranges)
        return BoxLabels(
            arm,
            surface,
            box_aspects(surface, delta, outer),
            None if inner is None else box_aspects(surface, delta, inner),
        )
    except (AssumptionError, RetryableError, UnableError):
        return None


def _sign(found: BoxAspects, fiber: Edge, base: Edge) -> int:
    """The sign of Delta at a rational point; 0 where balls do not tell."""
    with ctx.workprec(_BITS):
        factors = [*map(arb, fiber.point), arb(1)]
        pairs = zip(found.pieces.parts, factors, strict=True)
        value = sum((part(base.t) * factor for part, factor in pairs), arb(0))
        return int(value > 0) - int(value < 0)
