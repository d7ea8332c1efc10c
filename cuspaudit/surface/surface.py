"""Surfaces that are a product of two circles or lines, with rational charts.

The joint space of two joints is one: a revolute joint is a circle c^2 + s^2 = 1, a
prismatic joint a line. Each factor gets one rational coordinate, ``y`` on the first
chosen factor (the *fiber*) and ``x`` on the second (the *base*): on a circle the
half-angle tangent measured from a rational direction, chosen by the caller so that the
one point the chart misses is not one that matters; on a line the coordinate itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from flint import arb, fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import UnableError

__all__ = ["ROTATIONS", "Factor", "Surface", "product_factors"]

#: Rational points of the circle from which a chart may be measured.
ROTATIONS: tuple[tuple[fmpq, fmpq], ...] = tuple(
    ((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t))
    for t in (fmpq(0), fmpq(1, 3), fmpq(3, 4), fmpq(-2, 5), fmpq(5, 7), fmpq(-7, 11))
)


@dataclass(frozen=True)
class Factor:
    """A circle (c, s) or a line (q) in the coordinates of R^n, with its chart.

    Attributes:
        kind: "circle" or "line".
        names: its variables, (c, s) or (q,).
        rotation: on a circle, the point (c, s) of chart coordinate 0.
    """

    kind: Literal["circle", "line"]
    names: tuple[str, ...]
    rotation: tuple[fmpq, fmpq] = ROTATIONS[0]

    def numerators(self, t: Polynomial) -> tuple[Polynomial, ...]:
        """Numerators of the variables as functions of the chart coordinate ``t``."""
        if self.kind == "line":
            return (t,)
        c, s = self.rotation
        return (c * (1 - t * t) - s * 2 * t, s * (1 - t * t) + c * 2 * t)

    def denominator(self, t: Polynomial) -> Polynomial:
        """Their common denominator: 1 + t^2 on a circle, positive on the real line."""
        return t * 0 + 1 if self.kind == "line" else 1 + t * t

    def coordinates(self, t: arb) -> dict[str, arb]:
        """Enclosures of the variables at chart coordinate ``t``."""
        if self.kind == "line":
            return {self.names[0]: t}
        c, s = arb(self.rotation[0]), arb(self.rotation[1])
        cos, sin = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        return {self.names[0]: c * cos - s * sin, self.names[1]: s * cos + c * sin}


@dataclass(frozen=True)
class Surface:
    """V = fiber x base inside R^n, with K[y, x, u, v] to work in.

    Attributes:
        ring: the ring of V.
        fiber: the factor with chart coordinate y.
        base: the factor with chart coordinate x.
    """

    ring: Ring
    fiber: Factor
    base: Factor

    @cached_property
    def chart_ring(self) -> Ring:
        """K[y, x, u, v]: chart coordinates, then the coordinates of the values."""
        return Ring(("y", "x", "u", "v"), self.ring.radicand)

    def reduce(self, polynomial: Polynomial) -> Polynomial:
        """The same function on V, of the least degree in each circle's cosine."""
        for factor in (self.fiber, self.base):
            if factor.kind == "circle":
                c, s = (self.ring.gen(name) for name in factor.names)
                polynomial = divmod(polynomial, c * c + s * s - 1)[1]
        return self.ring.reduce(polynomial)

    def affine_parts(self, function: Polynomial) -> tuple[Polynomial, ...] | None:
        """(P, Q, S) with ``function`` = P c + Q s + S on V, or (P, S) on a line.

        Returns:
            Polynomials in the variables of the base, or None when the function is not
            affine in the variables of the fiber.
        """
        parts = self.ring.coefficients(self.reduce(function), self.fiber.names)
        size = len(self.fiber.names)
        units = [tuple(int(i == j) for j in range(size)) for i in range(size)]
        keys = [*units, (0,) * size]
        if set(parts) - set(keys):
            return None
        return tuple(parts.get(key, self.ring.constant(0)) for key in keys)

    def chart(self, function: Polynomial) -> tuple[Polynomial, Polynomial]:
        """(numerator, denominator) of ``function`` in K[y, x]; denominator > 0."""
        ring, function = self.chart_ring, self.reduce(function)
        terms = function.to_dict()
        numerator, denominator = ring.constant(0), ring.constant(1)
        places = []
        for factor, name in ((self.fiber, "y"), (self.base, "x")):
            where = [self.ring.variables.index(n) for n in factor.names]
            degree = max((sum(e[i] for i in where) for e in terms), default=0)
            t = ring.gen(name)
            below = factor.denominator(t)
            places.append((where, degree, factor.numerators(t), below))
            denominator *= below**degree
        for exponents, coefficient in terms.items():
            term = ring.constant(coefficient)
            if ring.radicand:
                term *= ring.surd ** exponents[-1]
            for where, degree, numerators, below in places:
                for i, above in zip(where, numerators, strict=True):
                    term *= above ** exponents[i]
                term *= below ** (degree - sum(exponents[i] for i in where))
            numerator += term
        return ring.reduce(numerator), denominator

    def on_base(
        self, functions: Sequence[Polynomial]
    ) -> tuple[list[Polynomial], Polynomial]:
        """Functions on the base as (numerators, common denominator > 0) in K[x]."""
        charted = [self.chart(function) for function in functions]
        common = max((d for _, d in charted), key=lambda d: int(d.total_degree()))
        return [n * divmod(common, d)[0] for n, d in charted], common

    def coordinates(self, y: arb, x: arb) -> dict[str, arb]:
        """Enclosures of the variables of R^n at chart coordinates (y, x)."""
        return self.fiber.coordinates(y) | self.base.coordinates(x)


def product_factors(variety: PolynomialSystem) -> tuple[Factor, Factor]:
    """The two factors of a variety that is a product of circles and lines.

    Raises:
        UnableError: the equations are not circles c^2 + s^2 - 1 in separate
            variables, or V does not have dimension 2.
    """
    ring = variety.ring
    free = list(ring.variables)
    factors = []
    for equation in variety.equations:
        used = [name for name in ring.variables if equation.derivative(name) != 0]
        circle = sum((ring.gen(name) ** 2 for name in used), ring.constant(-1))
        if len(used) != 2 or equation != circle or not set(used) <= set(free):
            raise UnableError(
                "crit", f"{equation} = 0 is not a circle in variables of its own"
            )
        free = [name for name in free if name not in used]
        factors.append(Factor("circle", tuple(used)))
    factors += [Factor("line", (name,)) for name in free]
    factors.sort(key=lambda factor: ring.variables.index(factor.names[0]))
    if len(factors) != 2:
        raise UnableError(
            "decide", f"V has dimension {len(factors)}; this engine needs 2"
        )
    return factors[0], factors[1]
