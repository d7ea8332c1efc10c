"""Components of {w g != 0} where w = a c + b s vanishes at two points of a circle.

On the closed half circle {w >= 0} let t be the tangent of half the angle from its
middle, -1 <= t <= 1. With t = sin(phi) the circle of phi is folded onto it, smoothly,
and G = (1 + sin(phi)^2)^d g, d the degree of g in c and s, is a function on the torus
with phi for that circle.

Lemma. If {G > 0} is connected, so is the part of {g > 0} with w > 0.
Proof. {g > 0, w >= 0} is the image of {G > 0}, so it is connected. It is open in the
half circle times the rest, so that a path in it can be pushed off the ends.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from flint import arb, fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import (
    Circle,
    factor_on_circles,
    reduce_on_circles,
)
from cuspaudit.errors import UnableError
from cuspaudit.geometry.torus.arcs import Arcs, arcs

__all__ = ["Halves", "halves"]


@dataclass(frozen=True, eq=False)
class Halves:
    """{w g != 0}, with one component or none for each sign of w and of g.

    Attributes:
        ring: K[x_1..x_n].
        wall: w.
        rest: g.
        sides: {G != 0} for w > 0 and for w < 0.
    """

    ring: Ring
    wall: Polynomial
    rest: Polynomial
    sides: tuple[Arcs, Arcs]

    @property
    def number_of_components(self) -> int:
        """Those of both half circles."""
        return sum(side.number_of_components for side in self.sides)

    @property
    def grounds(self) -> tuple[str, ...]:
        """What the number rests on."""
        return self.sides[0].grounds

    def component(self, point: Mapping[str, arb]) -> tuple[int, ...] | None:
        """The signs of w and g at a point, or None when a ball meets 0."""
        values = [self.ring.evaluate(f, point) for f in (self.wall, self.rest)]
        if not all(value > 0 or value < 0 for value in values):
            return None
        return tuple(1 if value > 0 else -1 for value in values)


def halves(
    ring: Ring, circles: Sequence[Circle], function: Polynomial, timeout: float
) -> Halves | None:
    """Count the components of {w g != 0} by covers of the two halves.

    Args:
        ring: K[x_1..x_n].
        circles: of the torus; the function depends on each.
        function: w g, or any other.
        timeout: of each of the four covers, in seconds of processor time.

    Returns:
        None when no factor w = a c + b s has a rational sqrt(a^2 + b^2).

    Raises:
        UnableError: a cover is not settled, or {G > 0} or {G < 0} has several
            components: two of one sign in a half circle, or one that meets no wall.
    """
    factors = [f for f, _ in factor_on_circles(ring, circles, function)]
    for wall in factors:
        found = _middle(ring, circles, wall)
        if found is None:
            continue
        circle, (a, b) = found
        rest = ring.constant(1)
        for factor in factors:
            rest *= 1 if factor is wall else factor
        sides = [
            arcs(ring, circles, _folded(ring, circles, circle, rest, middle), timeout)
            for middle in ((a, b), (-a, -b))
        ]
        if any(cover.components > 1 for side in sides for cover in side.covers):
            why = "a sign of a factor may have several components in a half circle"
            raise UnableError("torus_components", why)
        return Halves(ring, wall, rest, (sides[0], sides[1]))
    return None


def _middle(
    ring: Ring, circles: Sequence[Circle], wall: Polynomial
) -> tuple[Circle, tuple[fmpq, fmpq]] | None:
    """The circle of w = a c + b s, and (a, b) of length 1; None for another w."""
    used = [c for c in circles if any(wall.derivative(name) != 0 for name in c)]
    if len(used) != 1 or ring.radicand is not None:
        return None
    parts = ring.coefficients(wall, used[0])
    if not set(parts) <= {(1, 0), (0, 1)}:
        return None
    a, b = (
        parts[key].leading_coefficient() if key in parts else fmpq(0)
        for key in ((1, 0), (0, 1))
    )
    square = a * a + b * b
    if not (square.numer().is_square() and square.denom().is_square()):
        return None
    return used[0], (a / square.sqrt(), b / square.sqrt())


def _folded(
    ring: Ring,
    circles: Sequence[Circle],
    circle: Circle,
    rest: Polynomial,
    middle: tuple[fmpq, fmpq],
) -> Polynomial:
    """G, with (cos phi, sin phi) in the place of (c, s)."""
    a, b = middle
    c, s = (ring.gen(name) for name in circle)
    cosine, sine = a * c**2 - 2 * b * s, b * c**2 + 2 * a * s
    parts = ring.coefficients(rest, circle)
    degree = max(i + j for i, j in parts)
    folded = ring.total(
        part * cosine**i * sine**j * (1 + s**2) ** (degree - i - j)
        for (i, j), part in parts.items()
    )
    return reduce_on_circles(ring, circles, folded)
