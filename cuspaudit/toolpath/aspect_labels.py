"""Which aspect a posture lies in, proved.

Three joints: the strips of `surface.roadmap`, by the chart coordinate of the base and
the sign of Delta. Four and six: `geometry.torus.components` on balls of the angles. The
first joint, and a last joint that det J is free of, are circles or lines and do not
matter.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from flint import arb, ctx

from cuspaudit.auditing.aspects import aspect_components
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.errors import AssumptionError, RetryableError, UnableError
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.runtime.clock import check_time
from cuspaudit.surface.graph_isotop import graph_isotop
from cuspaudit.surface.roadmap import SurfaceRoadmap, roadmap
from cuspaudit.surface.surface import Factor
from cuspaudit.toolpath.traced_arm import TracedArm

__all__ = ["AspectLabels", "aspect_labels"]

_BITS = 64


@dataclass(frozen=True, eq=False)
class AspectLabels:
    """The aspects of an arm's exact model.

    Attributes:
        arm: the arm.
        count: how many aspects it has, proved.
        source: the roadmap with the number of each (strip, sign), or the components.
    """

    arm: TracedArm
    count: int
    source: Any

    def label(self, values: Sequence[arb]) -> Hashable | None:
        """The aspect of a posture, the same for equal aspects only; None near a wall.

        Args:
            values: joint values of the chain, rad or its unit.
        """
        point = self._point(values)
        if not isinstance(self.source, tuple):
            found: Hashable | None = self.source.component(point)
            return found
        road, aspects = self.source
        vertex = _vertex(road, point)
        return None if vertex is None else ("aspect", aspects[vertex])

    def _point(self, values: Sequence[arb]) -> dict[str, arb]:
        """The variables of the exact model."""
        point = {}
        for joint, zero, value in zip(
            self.arm.model.joints, self.arm.zeros, values, strict=True
        ):
            if joint.kind == "prismatic":
                point[joint.variables[0]] = value
            else:
                sine, cosine = (value + zero).sin_cos()
                point |= zip(joint.variables, (cosine, sine), strict=True)
        return point


def aspect_labels(arm: TracedArm) -> AspectLabels | None:
    """The aspects of the arm; None where they are not told apart exactly."""
    model = arm.model
    if not model.is_exact:
        return None
    try:
        check_time("aspects")
        if len(model.joints) == 3:
            variety, mapping = reduced_map(model)
            surface, delta = oriented(variety, mapping)
            road = roadmap(surface, delta)
            graph = graph_isotop(road, delta, ())
            return AspectLabels(
                arm, graph.number_of_aspects, (road, dict(graph.aspects))
            )
        components = aspect_components(model)
        return AspectLabels(arm, components.number_of_components, components)
    except (AssumptionError, RetryableError, UnableError):
        return None


def _vertex(road: SurfaceRoadmap, point: Mapping[str, arb]) -> tuple[int, int] | None:
    """The strip and the sign of Delta; None where balls do not tell."""
    with ctx.workprec(_BITS):
        x = _charted(road.surface.base, point)
        if x is None:
            return None
        strip = road.strip_of(x, _BITS)
        fiber = [*(point[name] for name in road.surface.fiber.names), arb(1)]
        value = arb(0)
        for part, factor in zip(road.parts, fiber, strict=True):
            value += part(x) * factor
        if strip is None or value.contains(0):
            return None
        return strip, 1 if value > 0 else -1


def _charted(factor: Factor, point: Mapping[str, arb]) -> arb | None:
    """The chart coordinate of a point of the base; None near the point without one."""
    if factor.kind == "line":
        return point[factor.names[0]]
    c, s = (point[name] for name in factor.names)
    a, b = (arb(x) for x in factor.rotation)
    cosine, sine = c * a + s * b, s * a - c * b
    below = 1 + cosine
    return None if below.contains(0) else sine / below
