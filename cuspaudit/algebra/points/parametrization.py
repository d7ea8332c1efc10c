"""Finite sets of algebraic points (the paper's zero-dimensional parametrizations).

A finite subset of C^n that is defined over Q and separated by a linear form lambda is
the set of points rho(theta) / omega'(theta), theta running over the roots of omega.
What is asked of a point is answered exactly, by arithmetic modulo omega.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from flint import arb, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.numerators import PRIME, modulo_prime, numerators
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import (
    PRECISIONS,
    RealRoot,
    Univariate,
    real_roots,
)
from cuspaudit.errors import InvalidSystemError, PrecisionError

__all__ = ["RealPoint", "ZeroDimensionalParametrization", "compose", "empty_set"]

_MOST_BITS = 1 << 17


@dataclass(frozen=True, eq=False)
class ZeroDimensionalParametrization:
    """Z = {(rho_1, ..., rho_n)(t) / omega'(t) : omega(t) = 0}, a finite set in C^n.

    [Paper, section 2.1]. The empty set has omega = 1.

    Attributes:
        variables: x_1..x_n.
        omega: monic and square-free, of degree the number of points.
        rho: n polynomials of degree less than that of omega.
        form: lambda, with lambda(x) = t at the point of the root t.
        grounds: what the claim of its maker that no point is missing rests on.

    Raises:
        InvalidSystemError: the data do not satisfy the definition.
    """

    variables: tuple[str, ...]
    omega: fmpq_poly
    rho: tuple[fmpq_poly, ...]
    form: tuple[fmpq, ...]
    grounds: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        n, slope = len(self.variables), self.slope
        if len(self.rho) != n or len(self.form) != n:
            _refuse(f"{len(self.rho)} coordinates and {len(self.form)} weights for {n}")
        if self.omega == 0 or self.omega[self.degree] != 1:
            _refuse("omega is not monic")
        if self.omega.gcd(slope).degree() > 0:
            _refuse("omega is not square-free")
        if any(r.degree() >= self.degree for r in self.rho):
            _refuse("a coordinate of the degree of omega")
        weighted = _sum(w * r for w, r in zip(self.form, self.rho, strict=True))
        if (weighted - fmpq_poly([0, 1]) * slope) % self.omega != 0:
            _refuse("the linear form is not the parameter")

    @property
    def degree(self) -> int:
        """The number of points."""
        return int(self.omega.degree())

    @property
    def slope(self) -> fmpq_poly:
        """omega', the common denominator of the coordinates."""
        return self.omega.derivative()

    @cached_property
    def inverse_slope(self) -> fmpq_poly:
        """1 / omega' modulo omega."""
        return self.slope.xgcd(self.omega)[1] % self.omega

    @cached_property
    def coordinates(self) -> tuple[fmpq_poly, ...]:
        """x_1..x_n as polynomials in the parameter, of degree less than omega's."""
        return tuple(r * self.inverse_slope % self.omega for r in self.rho)

    def numerators(
        self, ring: Ring, polynomials: Sequence[Polynomial]
    ) -> list[tuple[fmpq_poly, int]]:
        """For each p the pair (N, e) with p = N / omega'^e at the points of Z.

        Args:
            ring: over Q, with no other variables than Z has.
            polynomials: elements of the ring.

        Returns:
            N of degree less than omega's, e the total degree of p.
        """
        bases = (*self._of_ring(ring), self.slope)
        return numerators(bases, self.omega, polynomials)

    def _of_ring(self, ring: Ring) -> list[fmpq_poly]:
        own = dict(zip(self.variables, self.rho, strict=True))
        return [own[name] for name in ring.variables]

    def vanishes_nowhere(self, ring: Ring, polynomial: Polynomial) -> bool:
        """Whether a proof modulo a prime that p is not 0 at any point succeeded.

        omega is monic, so that its resultant with a numerator of p, modulo a prime
        that divides no denominator, is the resultant of the two modulo that prime: one
        that is not 0 there is not 0. False proves nothing.
        """
        bases = [modulo_prime(b) for b in (*self._of_ring(ring), self.slope)]
        omega = modulo_prime(self.omega)
        coefficients = polynomial.to_dict().values()
        if None in (*bases, omega) or any(int(c.q) % PRIME == 0 for c in coefficients):
            return False
        ((value, _),) = numerators(tuple(bases), omega, [polynomial])
        return int(value.gcd(omega).degree()) == 0

    def vanishes(self, ring: Ring, polynomial: Polynomial) -> bool:
        """Whether ``polynomial`` is 0 at every point of Z."""
        ((numerator, _),) = self.numerators(ring, [polynomial])
        return bool(numerator == 0)

    def contains(self, point: Sequence[fmpq | int]) -> bool:
        """Whether a rational ``point`` belongs to Z."""
        t = fmpq(0)
        for weight, x in zip(self.form, point, strict=True):
            t += weight * x
        slope = self.slope(t)
        return bool(self.omega(t) == 0) and all(
            r(t) == x * slope for r, x in zip(self.rho, point, strict=True)
        )

    def is_subset(self, other: ZeroDimensionalParametrization) -> bool:
        """Whether every point of this set belongs to ``other``, exactly.

        The form of ``other``, read on this set, is composed with the equations
        omega(t) = 0 and rho_i(t) = x_i omega'(t) of ``other``, modulo this omega.
        """
        if self.variables != other.variables:
            return False
        t = _sum(w * x for w, x in zip(other.form, self.coordinates, strict=True))
        slope = compose(other.slope, t, self.omega)
        return compose(other.omega, t, self.omega) == 0 and all(
            (compose(r, t, self.omega) - x * slope) % self.omega == 0
            for r, x in zip(other.rho, self.coordinates, strict=True)
        )

    def same_points(self, other: ZeroDimensionalParametrization) -> bool:
        """Whether the two sets are equal, whatever their forms."""
        return self.degree == other.degree and self.is_subset(other)

    def where_nonzero(
        self, ring: Ring, polynomial: Polynomial
    ) -> ZeroDimensionalParametrization:
        """The points of Z at which ``polynomial`` is not 0."""
        if self.vanishes_nowhere(ring, polynomial):
            return self
        ((above, _),) = self.numerators(ring, [polynomial])
        omega = self.omega // self.omega.gcd(above)
        rho = tuple(x * omega.derivative() % omega for x in self.coordinates)
        return replace(self, omega=omega, rho=rho)

    @cached_property
    def _real_points(self) -> tuple[RealPoint, ...]:
        roots = real_roots(Univariate(self.omega, fmpq_poly([0]), None))
        return tuple(RealPoint(self, root) for root in roots)

    def real_points(self) -> tuple[RealPoint, ...]:
        """The points of Z in R^n, by increasing value of the form; complete.

        The form has rational weights and separates, so that a point is real exactly
        when its parameter is.
        """
        return self._real_points


@dataclass(frozen=True)
class RealPoint:
    """The real point of a parametrization over one real root of omega.

    Attributes:
        parametrization: the set it belongs to.
        root: its parameter.
    """

    parametrization: ZeroDimensionalParametrization
    root: RealRoot

    @cached_property
    def _fractions(self) -> tuple[tuple[Univariate, ...], Univariate]:
        """The rho_i and omega' modulo the irreducible factor of the root."""
        factor = fmpq_poly(self.root.polynomial)
        reduced = [
            Univariate(p % factor, fmpq_poly([0]), None)
            for p in (*self.parametrization.rho, self.parametrization.slope)
        ]
        return tuple(reduced[:-1]), reduced[-1]

    def ball(self, bits: int) -> dict[str, arb]:
        """Balls of radius at most 2^-bits round the coordinates, by variable.

        Raises:
            PrecisionError: more than 2^17 bits would be needed.
        """
        rho, slope = self._fractions
        saved, radius = ctx.prec, arb(2) ** -bits
        precision = bits + 32
        try:
            while precision <= _MOST_BITS:
                ctx.prec = precision
                t = self.root.enclosure(precision)
                below = slope(t)
                if not below.contains(0):
                    balls = [r(t) / below for r in rho]
                    if all(ball.rad() <= radius for ball in balls):
                        names = self.parametrization.variables
                        return dict(zip(names, balls, strict=True))
                precision *= 2
        finally:
            ctx.prec = saved
        raise PrecisionError("coordinates of an algebraic point", _MOST_BITS)

    def sign(self, polynomial: Polynomial, ring: Ring) -> int:
        """The exact sign of ``polynomial`` here; 0 is recognised by divisibility.

        Args:
            polynomial: an element of ``ring``.
            ring: over Q, with no other variables than the point has.
        """
        for bits in PRECISIONS:
            value = self._value(polynomial, ring, bits)
            if not value.contains(0):
                return 1 if value > 0 else -1
            if bits == PRECISIONS[1] and self._is_zero(polynomial, ring):
                return 0
        raise PrecisionError("sign at an algebraic point", PRECISIONS[-1])

    def _value(self, polynomial: Polynomial, ring: Ring, bits: int) -> arb:
        saved, ctx.prec = ctx.prec, 2 * bits
        try:
            return ring.evaluate(polynomial, self.ball(bits))
        finally:
            ctx.prec = saved

    def _is_zero(self, polynomial: Polynomial, ring: Ring) -> bool:
        """Whether the irreducible factor of the root divides the numerator."""
        factor = fmpq_poly(self.root.polynomial)
        whole = self.parametrization
        bases = tuple(b % factor for b in (*whole._of_ring(ring), whole.slope))
        ((numerator, _),) = numerators(bases, factor, [polynomial])
        return bool(numerator == 0)


def empty_set(
    variables: Sequence[str], grounds: tuple[str, ...] = ()
) -> ZeroDimensionalParametrization:
    """The parametrization of the empty set in C^n."""
    n = len(variables)
    zeros = (fmpq_poly([0]),) * n
    return ZeroDimensionalParametrization(
        tuple(variables), fmpq_poly([1]), zeros, (fmpq(0),) * n, grounds
    )


def compose(outer: fmpq_poly, inner: fmpq_poly, omega: fmpq_poly) -> fmpq_poly:
    """``outer`` at ``inner`` modulo ``omega``, by Horner's scheme."""
    value = fmpq_poly([0])
    for coefficient in reversed(outer.coeffs()):
        value = (value * inner + coefficient) % omega
    return value


def _sum(polynomials: Iterable[fmpq_poly]) -> fmpq_poly:
    return sum(polynomials, fmpq_poly([0]))


def _refuse(found: str) -> None:
    raise InvalidSystemError(
        file="zero-dimensional parametrization",
        found=found,
        expected="see section 2.1 of the paper for what it must satisfy",
    )
