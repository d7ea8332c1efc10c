"""Components of {h != 0} on a torus, when h is linear along one circle.

Let h = P c + Q s on T^k = circle x B, with P and Q functions on B = T^(k-1). Over a
point of B the set {h > 0} is empty where P = Q = 0, and otherwise an open half circle.

Theorem. {h > 0} has as many components as {(P, Q) != 0} in B, and so has {h < 0}.
Proof. The projection of {h > 0} to {(P, Q) != 0} is open and onto, and its fibers are
connected. If the part over a component C were the union of two disjoint open sets,
their images would be open and cover C, hence meet; a fiber over a common point would
be cut in two. For {h < 0} turn the circle by pi.

Let G be the greatest common form of P = G P' and Q = G Q' in half-angle tangents. Then
{(P, Q) != 0} is {G != 0} without {P' = Q' = 0}, a closed semi-algebraic set of
codimension at least two, which disconnects no open set. So the components of {h != 0}
are told by the sign of h and by a component of {G != 0}. When every irreducible factor
of G depends on one circle only, these are products of arcs.

Functions of separate circles are treated apart: {g h != 0} = {g != 0} x {h != 0}.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING

from flint import arb

from cuspaudit.algebra.common_form import CommonForm, common_forms
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import (
    Circle,
    factor_on_circles,
    reduce_on_circles,
)
from cuspaudit.errors import DegenerateMapError, UnableError
from cuspaudit.geometry.torus.walls import Walls

if TYPE_CHECKING:
    from cuspaudit.geometry.torus.arcs import Arcs
    from cuspaudit.geometry.torus.halves import Halves

__all__ = ["HalfCircles", "TorusComponents", "torus_components"]

Label = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class HalfCircles:
    """{h != 0} for h = P c + Q s, or for h of one circle.

    Attributes:
        ring: K[x_1..x_n].
        function: h.
        fiber: (c, s); None when h is a function of one circle and all is in ``walls``.
        along: (P, Q); empty then.
        walls: the arcs of {G != 0}, one entry for each circle that G depends on.
    """

    ring: Ring
    function: Polynomial
    fiber: Circle | None
    along: tuple[Polynomial, ...]
    walls: tuple[Walls, ...]

    @property
    def number_of_components(self) -> int:
        """Twice as many, for the two signs of h, as the products of arcs."""
        arcs = prod(wall.number_of_arcs for wall in self.walls)
        return arcs if self.fiber is None else 2 * arcs

    @property
    def grounds(self) -> tuple[str, ...]:
        """What the number rests on."""
        kind = "linear along a circle" if self.fiber else "of one circle"
        return (f"a function {kind}", "FLINT root isolation")

    def component(self, point: Mapping[str, arb]) -> Label | None:
        """The component of a point given by balls for its variables.

        None when the balls do not exclude h = 0 or a zero of G.
        """
        value = self.ring.evaluate(self.function, point)
        if not (value > 0 or value < 0):
            return None
        label: Label = () if self.fiber is None else (1 if value > 0 else -1,)
        for wall in self.walls:
            c, s = wall.circle
            arc = wall.arc(point[c], point[s])
            if arc is None:
                return None
            label += (arc,)
        return label


@dataclass(frozen=True, eq=False)
class TorusComponents:
    """The components of {h != 0} on a torus.

    Attributes:
        ring: K[x_1..x_n].
        function: h.
        parts: {g != 0} for the factors g of h that share no circle.
    """

    ring: Ring
    function: Polynomial
    parts: tuple[HalfCircles | Halves | Arcs, ...]

    @cached_property
    def number_of_components(self) -> int:
        """How many components {h != 0} has."""
        return prod(part.number_of_components for part in self.parts)

    @property
    def grounds(self) -> tuple[str, ...]:
        """What the number rests on."""
        every = [ground for part in self.parts for ground in part.grounds]
        return tuple(dict.fromkeys(every))

    def component(self, point: Mapping[str, arb]) -> Label | None:
        """A label of the component of a point, equal exactly within a component.

        Args:
            point: balls for the variables that h depends on, on the circles.

        Returns:
            None when the balls do not tell, at or near h = 0.
        """
        label: Label = ()
        for part in self.parts:
            own = part.component(point)
            if own is None:
                return None
            label += own
        return label

    def component_at(self, angles: Mapping[Circle, float]) -> Label | None:
        """The same for a point given by its angle on every circle, in rad."""
        point: dict[str, arb] = {}
        for (c, s), angle in angles.items():
            point |= {c: arb(angle).cos(), s: arb(angle).sin()}
        return self.component(point)

    def connected(self, p: Mapping[str, arb], q: Mapping[str, arb]) -> bool | None:
        """Whether two points lie in one component; None when a label is missing."""
        first, second = self.component(p), self.component(q)
        return None if first is None or second is None else first == second


def torus_components(
    ring: Ring,
    circles: Sequence[Circle],
    function: Polynomial,
    timeout: float | None = None,
) -> TorusComponents:
    """The components of {h != 0}, each factor by the theorem above or by covers.

    Args:
        ring: K[x_1..x_n].
        circles: (c_i, s_i), pairs of variables of ``ring``; the torus.
        function: h, a polynomial in these variables.
        timeout: in seconds of processor time, for each cover of a factor that is not
            linear along a circle, or for each two halves of one; without it no cover
            is tried.

    Guarantee: the number is proved, on the result's ``grounds``.

    Raises:
        DegenerateMapError: h vanishes identically.
        UnableError: a factor is linear along no circle and no cover settles it, or
            its G has a factor of two or more circles.

    >>> ring = Ring(["c1", "s1", "c2", "s2"])
    >>> c1, s1, c2, s2 = ring.gens
    >>> circles = [("c1", "s1"), ("c2", "s2")]
    >>> torus_components(ring, circles, c1 * (c2 + 2) + s1 * s2).number_of_components
    2
    >>> torus_components(ring, circles, c1 * c2 + s1 * s2 * c2).number_of_components
    4
    """
    factors = [g for g, _ in factor_on_circles(ring, circles, function)]
    if factors == [0]:
        raise DegenerateMapError("h vanishes everywhere on the torus")
    parts = tuple(
        _part(ring, used, product, timeout)
        for used, product in _separate(ring, circles, factors)
    )
    return TorusComponents(ring, function, parts)


def _separate(
    ring: Ring, circles: Sequence[Circle], factors: Sequence[Polynomial]
) -> list[tuple[list[Circle], Polynomial]]:
    """Products of the factors that are linked by shared circles, with their circles."""
    groups: list[tuple[list[Circle], Polynomial]] = []
    for factor in factors:
        used = [c for c in circles if any(factor.derivative(name) != 0 for name in c)]
        linked = [group for group in groups if set(group[0]) & set(used)]
        groups = [group for group in groups if group not in linked]
        for more, product in linked:
            factor *= product
            used += [c for c in more if c not in used]
        groups.append(([c for c in circles if c in used], factor))
    return groups


def _part(
    ring: Ring,
    circles: Sequence[Circle],
    function: Polynomial,
    timeout: float | None,
) -> HalfCircles | Halves | Arcs:
    function = reduce_on_circles(ring, circles, function)
    if len(circles) == 1:
        forms = common_forms(ring, circles, function, function)
        return HalfCircles(ring, function, None, (), _walls(ring, circles, forms))
    for fiber in circles:
        parts = ring.coefficients(function, fiber)
        if set(parts) <= {(1, 0), (0, 1)}:
            p, q = (parts.get(key, ring.constant(0)) for key in ((1, 0), (0, 1)))
            base = [circle for circle in circles if circle != fiber]
            forms = common_forms(ring, base, p, q)
            return HalfCircles(ring, function, fiber, (p, q), _walls(ring, base, forms))
    if timeout is not None:
        # covers are rare, and load a library of graphs
        from cuspaudit.geometry.torus.arcs import arcs
        from cuspaudit.geometry.torus.halves import halves

        found = halves(ring, circles, function, timeout / 2)
        return found or arcs(ring, circles, function, timeout)
    raise UnableError("torus_components", "a factor is linear along no circle")


def _walls(
    ring: Ring, circles: Sequence[Circle], forms: Sequence[CommonForm]
) -> tuple[Walls, ...]:
    if any(len(form.used) > 1 for form in forms):
        raise UnableError(
            "torus_components", "a common factor depends on several circles"
        )
    own = [
        (circle, tuple(form for form in forms if form.used == (i,)))
        for i, circle in enumerate(circles)
    ]
    return tuple(Walls(ring, circle, mine) for circle, mine in own if mine)
