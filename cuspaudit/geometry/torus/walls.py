"""Points that cut a circle into arcs, exactly, and the arc that a point lies in."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from flint import arb

from cuspaudit.algebra.common_form import CommonForm
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.trigonometric import Circle
from cuspaudit.algebra.univariate import RealRoot, Univariate, real_roots

__all__ = ["Walls"]

_BITS = 128


@dataclass(frozen=True)
class Walls:
    """The zeros on one circle of forms in its half-angle tangent t.

    Attributes:
        ring: that of the forms.
        circle: the names (c, s).
        forms: each in this circle alone.
    """

    ring: Ring
    circle: Circle
    forms: tuple[CommonForm, ...]

    @cached_property
    def roots(self) -> tuple[RealRoot, ...]:
        """The finite tangents of the zeros, increasing."""
        ring, name = self.ring, self.circle[1]
        forms = (form.polynomial for form in self.forms)
        return tuple(
            real_roots(*(Univariate.from_polynomial(ring, p, name) for p in forms))
        )

    @property
    def has_infinite(self) -> bool:
        """Whether theta = pi is a zero."""
        return any(form.is_infinite for form in self.forms)

    @property
    def number_of_arcs(self) -> int:
        """The number of components of the circle without the zeros."""
        return max(1, len(self.roots) + self.has_infinite)

    def arc(self, c: arb, s: arb) -> int | None:
        """The arc, 0 to ``number_of_arcs`` - 1, of the point (c, s) of the circle.

        None when the balls do not separate the point from a zero. Without the zero at
        theta = pi the first arc and the last are one, number 0.
        """
        if c > 0 or s > 0 or s < 0:
            left = self._zeros_left_of(s / (1 + c) if c > 0 else (1 - c) / s)
        else:
            left = None if self.has_infinite else self._beyond(s / (1 - c))
        if left is None or self.has_infinite:
            return left
        return left % self.number_of_arcs

    def _zeros_left_of(self, t: arb) -> int | None:
        """How many zeros have a smaller tangent, or None."""
        count = 0
        for root in self.roots:
            ball = root.enclosure(_BITS)
            if not (t > ball or t < ball):
                return None
            count += t > ball
        return count

    def _beyond(self, cotangent: arb) -> int | None:
        """0 for a point that only the arc of theta = pi can hold, else None."""
        return (
            0 if all(r.enclosure(_BITS) * cotangent < 1 for r in self.roots) else None
        )
