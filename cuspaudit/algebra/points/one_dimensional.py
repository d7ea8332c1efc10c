"""Algebraic curves in C^n (the paper's one-dimensional parametrizations).

A curve in general position to two linear forms lambda and mu projects birationally to
a plane curve omega(u, v) = 0, u = lambda and v = mu; its points are
rho(u, v) / omega_u(u, v), omega_u the derivative in u, and limits of such points.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import arb, fmpq, fmpq_poly

from cuspaudit.algebra.elimination import leading_coefficient
from cuspaudit.algebra.numerators import numerators
from cuspaudit.algebra.points.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import Univariate
from cuspaudit.errors import InvalidSystemError, UnableError

__all__ = ["OneDimensionalParametrization"]


@dataclass(frozen=True, eq=False)
class OneDimensionalParametrization:
    """The closure of {(rho_1..rho_n)(u, v) / omega_u(u, v) : omega = 0, omega_u != 0}.

    [Paper, section 2.2]. The degree of rho_i that is less than omega's is the one in u:
    that is what a remainder modulo omega has.

    Attributes:
        variables: x_1..x_n.
        ring: Q[u, v].
        omega: square-free, monic in u, and up to a constant in v.
        rho: n polynomials of less degree in u than omega.
        forms: (lambda, mu), with lambda(x) = u and mu(x) = v on the curve.

    Raises:
        InvalidSystemError: the data do not satisfy the definition.
    """

    variables: tuple[str, ...]
    ring: Ring
    omega: Polynomial
    rho: tuple[Polynomial, ...]
    forms: tuple[tuple[fmpq, ...], tuple[fmpq, ...]]

    def __post_init__(self) -> None:
        n, degree = len(self.variables), self.degree
        if len(self.ring.variables) != 2 or self.ring.radicand is not None:
            _refuse(f"coefficients in {self.ring}")
        if any(len(part) != n for part in (self.rho, *self.forms)):
            _refuse(f"{len(self.rho)} coordinates and {self.forms} for {n}")
        if self.omega == 0 or self._leading(0) != 1:
            _refuse("omega is not monic in u")
        if not self._leading(1).is_constant():
            _refuse("omega is not monic in v")
        if self.omega.gcd(self.slope).degrees()[0] > 0:
            _refuse("omega is not square-free")
        if any(r.degrees()[0] >= degree for r in self.rho if degree):
            _refuse("a coordinate of the degree of omega")
        for form, parameter in zip(self.forms, self.ring.gens, strict=True):
            terms = (w * r for w, r in zip(form, self.rho, strict=True))
            if self.remainder(self.ring.total(terms) - parameter * self.slope) != 0:
                _refuse("a linear form is not the parameter")

    @property
    def degree(self) -> int:
        """The number of points on a generic plane mu = v."""
        return int(self.omega.degrees()[0])

    @property
    def slope(self) -> Polynomial:
        """omega_u, the common denominator of the coordinates."""
        return self.omega.derivative(self.ring.variables[0])

    def remainder(self, polynomial: Polynomial) -> Polynomial:
        """``polynomial`` of Q[u, v] modulo omega: omega is monic in u."""
        return divmod(polynomial, self.omega)[1]

    def numerator(self, ring: Ring, polynomial: Polynomial) -> Polynomial:
        """N in Q[u, v] with p omega_u^e = N on the curve, e the total degree of p.

        Args:
            ring: Q[x_1..x_n], the variables of the curve in any order.
            polynomial: p in ``ring``.
        """
        own = dict(zip(self.variables, self.rho, strict=True))
        bases = [own[name] for name in ring.variables]
        degree = max(int(polynomial.total_degree()), 0)
        total = self.ring.constant(0)
        for exponents, coefficient in polynomial.to_dict().items():
            term = self.ring.constant(coefficient)
            powers = (*map(int, exponents), degree - sum(map(int, exponents)))
            for base, power in zip((*bases, self.slope), powers, strict=True):
                for _ in range(power):
                    term = self.remainder(term * base)
            total += term
        return total

    def over(self, v: fmpq) -> ZeroDimensionalParametrization:
        """The points of the curve with mu = v, for a value where omega is square-free.

        Raises:
            InvalidSystemError: omega(., v) has a multiple root.
        """
        rho = tuple(self._special(p, v) for p in self.rho)
        omega = self._special(self.omega, v)
        return ZeroDimensionalParametrization(
            self.variables, omega, rho, self.forms[0], ("one-dimensional",)
        )

    def point(self, u: arb, v: arb) -> tuple[arb, ...]:
        """An enclosure of rho / omega_u; not finite where omega_u may vanish."""
        at = dict(zip(self.ring.variables, (u, v), strict=True))
        slope = self.ring.evaluate(self.slope, at)
        return tuple(self.ring.evaluate(r, at) / slope for r in self.rho)

    def contains(self, points: ZeroDimensionalParametrization) -> bool:
        """Whether every point of a set lies on the curve.

        Where omega_u is not 0 that is omega = 0 and omega_u x_i = rho_i.

        Raises:
            UnableError: these hold, with omega_u = 0 somewhere: a limit of points of
                the curve, or not, which the parametrization does not tell.
        """
        if points.variables != self.variables:
            return False
        at = tuple(_value(form, points) for form in self.forms)
        sides = numerators((*at, fmpq_poly([1])), points.omega, [*self.rho, self.slope])
        ((inside, _),) = numerators((*at, fmpq_poly([1])), points.omega, [self.omega])
        *rho, slope = (side for side, _ in sides)
        pairs = zip(points.coordinates, rho, strict=True)
        if inside != 0 or any((slope * x - r) % points.omega != 0 for x, r in pairs):
            return False
        if slope.gcd(points.omega).degree() > 0:
            raise UnableError("contains", "a point where omega_u is 0")
        return True

    def _leading(self, index: int) -> Polynomial:
        return leading_coefficient(self.ring, self.omega, self.ring.variables[index])

    def _special(self, polynomial: Polynomial, v: fmpq) -> fmpq_poly:
        first, second = self.ring.variables
        special = self.ring.substitute(polynomial, {second: v})
        return Univariate.from_polynomial(self.ring, special, first).rational


def _value(form: Sequence[fmpq], points: ZeroDimensionalParametrization) -> fmpq_poly:
    pairs = zip(form, points.coordinates, strict=True)
    return sum((w * x for w, x in pairs), fmpq_poly([0]))


def _refuse(found: str) -> None:
    raise InvalidSystemError(
        file="one-dimensional parametrization",
        found=found,
        expected="see section 2.2 of the paper for what it must satisfy",
    )
