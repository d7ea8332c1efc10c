"""Components of {h != 0} where h is affine along a circle: counted by covers.

h = P c + Q s + S with S != 0. Over a point of the base {h > 0} is one arc, the whole
circle, or empty, and so is {h < 0}; ``geometry.torus.cover`` counts each sign.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from flint import arb

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import Circle
from cuspaudit.errors import UnableError
from cuspaudit.geometry.torus.box_waves import BoxWaves
from cuspaudit.geometry.torus.cover import TorusCover, cover_count
from cuspaudit.geometry.torus.function import TorusFunction

__all__ = ["Arcs", "arcs"]


@dataclass(frozen=True, eq=False)
class Arcs:
    """{h != 0} for h affine along a circle.

    Attributes:
        ring: K[x_1..x_n].
        function: h.
        fiber: the circle (c, s).
        covers: of {h > 0} and of {h < 0}.
    """

    ring: Ring
    function: Polynomial
    fiber: Circle
    covers: tuple[TorusCover, TorusCover]

    @property
    def number_of_components(self) -> int:
        """Those of {h > 0} and of {h < 0}."""
        return sum(cover.components for cover in self.covers)

    @property
    def grounds(self) -> tuple[str, ...]:
        """What the number rests on."""
        return ("a cover of the torus by boxes, in doubles with bounded rounding",)

    def component(self, point: Mapping[str, arb]) -> tuple[int, ...] | None:
        """The sign of h at a point, or None when the ball of its value meets 0.

        None as well when h has several components of that sign: the covers count them
        and do not tell them apart.
        """
        value = self.ring.evaluate(self.function, point)
        if not (value > 0 or value < 0):
            return None
        sign = 1 if value > 0 else -1
        return (sign,) if self.covers[sign < 0].components == 1 else None


def arcs(
    ring: Ring, circles: Sequence[Circle], function: Polynomial, timeout: float
) -> Arcs:
    """Count the components of {h != 0} by covers.

    Args:
        ring: K[x_1..x_n].
        circles: of the torus; h depends on each.
        function: h, reduced on the circles.
        timeout: of each of the two covers, in seconds of processor time.

    Raises:
        UnableError: h is affine along no circle, or a cover is not settled.
    """
    keys = ((1, 0), (0, 1), (0, 0))
    for fiber in circles:
        parts = ring.coefficients(function, fiber)
        if set(parts) <= set(keys):
            base = [circle for circle in circles if circle != fiber]
            p, q, s = (
                TorusFunction.from_polynomial(
                    ring, base, parts.get(key, ring.constant(0))
                )
                for key in keys
            )
            positive = cover_count(BoxWaves([p, q, s]), timeout)
            negative = cover_count(BoxWaves([p, q, -s]), timeout)
            return Arcs(ring, function, fiber, (positive, negative))
    raise UnableError("torus_components", "a factor is affine along no circle")
