"""Fibers of a map from a surface to the plane, as roots of one polynomial.

For R = (r_1, r_2) on V = fiber x base, the postures over the value (u, v) are the
common zeros of E_1 = u - r_1 and E_2 = v - r_2. Eliminating one chart coordinate
leaves a polynomial F in the other, the *separating* one, whose simple real roots are
the postures: at a simple root of the resultant of E_1 and E_2 their gcd has degree 1,
so the other coordinate is a rational function of the root.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from cuspaudit.algebra.elimination import (
    discriminant,
    leading_coefficient,
    primitive_part,
    resultant,
)
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap
from cuspaudit.algebra.univariate import Univariate, real_roots
from cuspaudit.errors import DegenerateMapError, UnableError
from cuspaudit.surface.surface import Surface

__all__ = ["FiberPolynomials", "fiber_polynomials"]


@dataclass(frozen=True)
class FiberPolynomials:
    """The fibers of R over K[u, v], in chart coordinates.

    Attributes:
        surface: V with its charts.
        equations: numerators of E_1 and E_2 in K[y, x, u, v].
        separating: "x" or "y", the coordinate that tells generic postures apart.
        polynomial: F in K[separating, u, v], without zeros that are the same for all
            values.
        discriminant: the discriminant of F, a nonzero polynomial of K[u, v].
    """

    surface: Surface
    equations: tuple[Polynomial, Polynomial]
    separating: str
    polynomial: Polynomial
    discriminant: Polynomial

    @cached_property
    def ring(self) -> Ring:
        """K[y, x, u, v]."""
        return self.surface.chart_ring

    @property
    def other(self) -> str:
        """The chart coordinate that is not separating."""
        return "x" if self.separating == "y" else "y"

    def eliminant(self, name: str) -> Polynomial:
        """A polynomial of K[name, u, v] that vanishes on every posture."""
        return _eliminant(self.ring, self.equations, name)

    @cached_property
    def linear_factor(self) -> tuple[Polynomial, Polynomial]:
        """(s_1, s_0) with s_1 t + s_0 = 0 for the other coordinate t of a posture.

        The first subresultant of E_1 and E_2, which have degree at most 2 in t.
        """
        e1, e2 = (self._dense(equation) for equation in self.equations)
        s1 = self.ring.reduce(e1[2] * e2[1] - e2[2] * e1[1])
        s0 = self.ring.reduce(e1[2] * e2[0] - e2[2] * e1[0])
        if s1 != 0:
            return s1, s0
        linear = e2 if e2[1] != 0 and e2[2] == 0 else e1
        if linear[2] != 0:
            raise UnableError("sample_points", "the second coordinate is not rational")
        return linear[1], linear[0]

    def chart_gap(self) -> Polynomial:
        """A polynomial of K[u, v] vanishing where a posture escapes the charts.

        A posture is missed when its separating coordinate is infinite (the leading
        coefficient of F is 0) or its other one is (the leading coefficients of E_1
        and E_2 in it have a common zero). On a line neither is infinite. On a circle
        the leading coefficient of E_i is a power of 1 + t^2, t the separating
        coordinate, times a polynomial without factor in t alone.
        """
        ring, keep = self.ring, self.separating
        gap = leading_coefficient(ring, self.polynomial, keep)
        leading = [self._dense(equation)[2] for equation in self.equations]
        if all(entry != 0 for entry in leading):
            e1, e2 = (primitive_part(ring, e, keep, ("u", "v")) for e in leading)
            common = resultant(ring, e1, e2, keep)
            gap *= primitive_part(ring, common, keep, ("u", "v"))
        return ring.reduce(gap)

    def _dense(self, equation: Polynomial) -> list[Polynomial]:
        parts = self.ring.coefficients(equation, [self.other])
        if max(parts)[0] > 2:
            raise UnableError(
                "sample_points", f"degree {max(parts)[0]} in one coordinate, above 2"
            )
        return [parts.get((i,), self.ring.constant(0)) for i in range(3)]


def fiber_polynomials(surface: Surface, mapping: PolynomialMap) -> FiberPolynomials:
    """Eliminate one chart coordinate, choosing one that separates generic postures.

    Raises:
        UnableError: neither coordinate separates, or a posture could hide a multiple
            root (see ``_check_multiple_roots``).
    """
    ring = surface.chart_ring
    charted = [surface.chart(component) for component in mapping.components]
    e1, e2 = (
        ring.gen(value) * denominator - numerator
        for value, (numerator, denominator) in zip(("u", "v"), charted, strict=True)
    )
    failure = UnableError("sample_points", "neither coordinate separates postures")
    for separating in ("x", "y"):
        polynomial = _eliminant(ring, (e1, e2), separating)
        if polynomial.derivative(separating) == 0:
            raise DegenerateMapError("the map has rank below 2 everywhere")
        simple = discriminant(ring, polynomial, separating)
        if simple == 0:
            continue
        fibers = FiberPolynomials(surface, (e1, e2), separating, polynomial, simple)
        try:
            _check_multiple_roots(fibers, charted)
        except UnableError as limit:
            failure = limit
            continue
        return fibers
    raise failure


def _eliminant(
    ring: Ring, equations: tuple[Polynomial, Polynomial], keep: str
) -> Polynomial:
    other = "x" if keep == "y" else "y"
    return primitive_part(ring, resultant(ring, *equations, other), keep, ("u", "v"))


def _check_multiple_roots(
    fibers: FiberPolynomials, charted: list[tuple[Polynomial, Polynomial]]
) -> None:
    """Prove that F has a multiple root at every critical posture.

    F(x; R(y, x)) = 0 on V. Differentiating along the kernel (a, b) of dR gives
    b dF/dx = 0, so dF/dx = 0 unless b = 0, that is unless dR/dy = 0. This can happen
    only over the real zeros of the resultant of the two components of dR/dy; there
    dF/dx is shown to vanish on the whole line. (x separating; else exchange x and y.)

    Raises:
        UnableError: dF/dx does not vanish there.
    """
    ring, keep, other = fibers.ring, fibers.separating, fibers.other
    moves = [n.derivative(other) * d - n * d.derivative(other) for n, d in charted]
    moving = [move for move in moves if move != 0]
    places_at = moving[0]
    if len(moving) == 2:
        places_at = resultant(ring, moving[0], moving[1], other)
    if places_at == 0 or places_at.derivative(other) != 0:
        raise UnableError("atypical_values", f"the map may stand still along {other}")
    places = real_roots(Univariate.from_polynomial(ring, places_at, keep))
    slope = fibers.polynomial.derivative(keep)
    pulled = _pull_back(ring, slope, charted)
    lines = [
        Univariate.from_polynomial(ring, coefficient, keep)
        for coefficient in ring.coefficients(pulled, [other]).values()
    ]
    for root in places:
        if any(line.sign_at(root) != 0 for line in lines):
            raise UnableError(
                "atypical_values",
                f"a critical posture may hide over {keep} = {float(root):.6g}",
            )


def _pull_back(
    ring: Ring, polynomial: Polynomial, charted: list[tuple[Polynomial, Polynomial]]
) -> Polynomial:
    """The numerator of ``polynomial`` with u, v replaced by the map."""
    (n1, d1), (n2, d2) = charted
    parts = ring.coefficients(polynomial, ("u", "v"))
    high = [max(key[i] for key in parts) for i in (0, 1)]
    return ring.reduce(
        ring.total(
            part * n1**i * d1 ** (high[0] - i) * n2**j * d2 ** (high[1] - j)
            for (i, j), part in parts.items()
        )
    )
