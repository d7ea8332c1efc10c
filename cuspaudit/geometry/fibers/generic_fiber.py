"""The generic fiber of a map: all points over a value as roots of one polynomial.

V = {f = 0} in R^n has dimension d and R maps V to R^d. For a linear form t = lambda(x)
that tells the points of a generic fiber apart there are omega, rho_1..rho_n in
Q[y_1..y_d][t] with, on V and for y = R(x),

    omega(lambda(x); y) = 0   and   omega'(lambda(x); y) x_i = rho_i(lambda(x); y),

' being the derivative in t. They are the zero-dimensional parametrization of the paper
over the field Q(y). However they were found, these identities are proved: both sides
are reduced modulo <f>, remainder 0.

**Theorem.** Let lc and disc be the leading coefficient and the discriminant of omega in
t, and q in C^d with lc(q) disc(q) != 0. Then lambda tells the points of the fiber over
q apart and embeds it in the roots of omega(.; q); at each point of it jac(f, R) has
rank n; and R is proper over a neighbourhood of q.

Proof. The points lie at x_i = rho_i / omega' of roots t of omega, whence the first
claim, and t is bounded near q, whence the last. Let v be in the kernel of jac(f, R) at
a point x of the fiber. The identities hold modulo <f>; their derivatives along v are
omega' lambda(v) = 0 and omega' v_i = (a multiple of) lambda(v). So v = 0. QED

Hence over a connected component of {lc disc != 0} in R^d, R is a covering whose sheets
are numbered by the increasing real roots t. Conversely, if over one q all roots of
omega are points of V (checked by exact substitution), they are so over every q with
lc(q) disc(q) != 0: each point moves with q, by the rank, and f(rho / omega') = 0 on an
open set is an identity modulo omega.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from flint import arb, arb_poly, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.elimination import discriminant, leading_coefficient
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.algebra.univariate import PRECISIONS, Univariate, real_balls
from cuspaudit.errors import DegenerateMapError, PrecisionError, UnableError
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.fibers.proposal import FiberProposer, Form
from cuspaudit.geometry.fibers.pullback import pull_back, vanishes_on
from cuspaudit.runtime.clock import time_limit

__all__ = ["GenericFiber", "function_equation", "generic_fiber"]


@dataclass(frozen=True, eq=False)
class GenericFiber:
    """The fibers of R, parametrized over Q(y).

    Attributes:
        variety: V = {f = 0}.
        mapping: R = (r_1, ..., r_d).
        ring: Q[t, y_1..y_d].
        form: the coefficients of lambda.
        omega: in Q[y][t], square-free over Q(y); not always monic.
        rho: rho_1..rho_n in Q[y][t].
    """

    variety: PolynomialSystem
    mapping: PolynomialMap
    ring: Ring
    form: Form
    omega: Polynomial
    rho: tuple[Polynomial, ...]

    @property
    def values(self) -> tuple[str, ...]:
        """The names of y_1..y_d."""
        return self.ring.variables[1:]

    @cached_property
    def leading(self) -> Polynomial:
        """The leading coefficient of omega in t."""
        return leading_coefficient(self.ring, self.omega, self.ring.variables[0])

    @cached_property
    def discriminant(self) -> Polynomial:
        """The discriminant of omega in t."""
        return discriminant(self.ring, self.omega, self.ring.variables[0])

    @property
    def degree(self) -> int:
        """The number of complex points over a generic value."""
        return int(self.omega.degrees()[0])

    def reordered(self, order: Sequence[int]) -> GenericFiber:
        """The same fibers for the map with components r_i, i in ``order``."""
        components = tuple(self.mapping.components[i] for i in order)
        t, *y = self.ring.gens
        moved = [y[order.index(i)] for i in range(len(order))]

        def renamed(p: Polynomial) -> Polynomial:
            return p.compose(t, *moved, ctx=self.ring.context)

        result = GenericFiber(
            self.variety,
            PolynomialMap(self.mapping.ring, components),
            self.ring,
            self.form,
            renamed(self.omega),
            tuple(map(renamed, self.rho)),
        )
        vars(result)["discriminant"] = renamed(self.discriminant)  # dear to compute
        return result

    def is_regular(self, value: Sequence[fmpq]) -> bool:
        """Whether lc disc is not 0 at the value."""
        omega = self._special(self.omega, value)
        return bool(
            omega.degree() == self.degree and omega.gcd(omega.derivative()) == 1
        )

    def over(self, value: Sequence[fmpq]) -> tuple[fmpq_poly, tuple[fmpq_poly, ...]]:
        """(omega, rho) over a regular value, in Q[t]."""
        rho = tuple(self._special(p, value) for p in self.rho)
        return self._special(self.omega, value), rho

    def sheets(self, value: Sequence[fmpq]) -> list[tuple[arb, ...]]:
        """The real points over a regular value, by increasing lambda.

        Returns:
            Disjoint balls of (x_1..x_n) at the working precision or somewhat more;
            complete.
        """
        omega, rho = self.over(value)
        slope, saved = omega.derivative(), ctx.prec
        try:
            for ctx.prec in (saved, *(bits for bits in PRECISIONS if bits > saved)):
                roots = real_balls(omega.numer())
                slopes = [arb_poly(slope)(t) for t in roots]
                if not any(s.contains(0) for s in slopes):
                    pairs = list(zip(roots, slopes, strict=True))
                    return [tuple(arb_poly(p)(t) / s for p in rho) for t, s in pairs]
        finally:
            ctx.prec = saved
        raise PrecisionError("points of a fiber", PRECISIONS[-1])

    def _special(self, polynomial: Polynomial, value: Sequence[fmpq]) -> fmpq_poly:
        at = dict(zip(self.values, value, strict=True))
        special = self.ring.substitute(polynomial, at)
        name = self.ring.variables[0]
        return Univariate.from_polynomial(self.ring, special, name).rational


def function_equation(
    fiber: GenericFiber, function: Polynomial, timeout: float = 60.0, seed: int = 1
) -> Polynomial:
    """An equation mu(h(x); R(x)) = 0 on V, mu in Q[y][t], proved; h the ``function``.

    Every value of h on a generic fiber is a root, and conversely unless msolve was
    unlucky, which makes mu larger than needed.

    Raises:
        UnableError: no equation was found, or it could not be proved.
    """
    variety, mapping = fiber.variety, fiber.mapping
    with time_limit(timeout):
        mu = FiberProposer(variety, mapping, fiber.ring, seed).equation(function)
    pulled = pull_back(variety, fiber.ring, mu, (function, *mapping.components))
    if not vanishes_on(variety, pulled):
        raise UnableError("atypical_values", "an equation of a function is not proved")
    return mu


def generic_fiber(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    timeout: float = 60.0,
    seed: int = 1,
    forms: Iterable[Form] = (),
) -> GenericFiber:
    """The fibers of R: V -> R^d as roots of one polynomial, proved.

    The polynomials are proposed by elimination (``geometry.fibers.proposal``), and
    proved here.

    Args:
        variety: V = {f = 0} over Q; assumption (A) of the paper is assumed.
        mapping: R, dominant on a component of V at least.
        timeout: in s, for all eliminations together.
        seed: of msolve's random choices.
        forms: the linear forms to try; some that do are looked for when none is given.

    Raises:
        DegenerateMapError: every minor of jac(f, R) vanishes on V.
        UnableError: no linear form among those tried could be proved to do.
    """
    if variety.ring.radicand is not None:
        raise UnableError("atypical_values", "coefficients outside Q")
    if all(vanishes_on(variety, minor) for minor in crit(variety, mapping)):
        raise DegenerateMapError("the map has full rank nowhere on V")
    ring = Ring(_fresh(variety.ring, len(mapping.components)))
    proposer = FiberProposer(variety, mapping, ring, seed)
    with time_limit(timeout):
        return _proved(proposer, forms)


def _proved(proposer: FiberProposer, forms: Iterable[Form]) -> GenericFiber:
    variety, mapping, ring = proposer.variety, proposer.mapping, proposer.ring
    reason = "no linear form tells the points of a generic fiber apart"
    for form in forms or proposer.forms():
        found = proposer.parametrized(form)
        if found is None:
            continue
        fiber = GenericFiber(variety, mapping, ring, form, *found)
        if not _is_complete(fiber):
            reason = "the proposed fiber is not one modulo the equations of V"
            continue
        if not _is_sound(fiber):
            reason = "the proposed fiber has points outside V"
            continue
        return fiber
    raise UnableError("atypical_values", reason)


def _fresh(ring: Ring, dimension: int) -> list[str]:
    """Names t, y1..yd, underlined until they are no variables of ``ring``."""
    names = ["t", *(f"y{i + 1}" for i in range(dimension))]
    while set(names) & set(ring.variables):
        names = [f"{name}_" for name in names]
    return names


def _is_complete(fiber: GenericFiber) -> bool:
    """Prove the two identities of the module on V, and that lambda is the form."""
    ring, x = fiber.variety.ring, fiber.variety.ring.gens
    line = ring.total(c * g for c, g in zip(fiber.form, x, strict=True))
    at = (line, *fiber.mapping.components)
    slope = fiber.omega.derivative(fiber.ring.variables[0])

    def pulled(polynomial: Polynomial) -> Polynomial:
        return pull_back(fiber.variety, fiber.ring, polynomial, at)

    slope_at = pulled(slope)
    return vanishes_on(fiber.variety, pulled(fiber.omega)) and all(
        vanishes_on(fiber.variety, slope_at * g - pulled(p))
        for g, p in zip(x, fiber.rho, strict=True)
    )


def _is_sound(fiber: GenericFiber) -> bool:
    """Whether all roots of omega over some regular value are points of V over it."""
    for value in _values(len(fiber.values)):
        if fiber.is_regular(value):
            break
    omega, rho = fiber.over(value)
    inverse = omega.derivative().xgcd(omega)[1]
    x = [p * inverse % omega for p in rho]
    targets = zip(fiber.mapping.components, value, strict=True)
    system = [*fiber.variety.equations, *(r - q for r, q in targets)]
    line = sum((c * p for c, p in zip(fiber.form, x, strict=True)), fmpq_poly([0]))
    return (line - fmpq_poly([0, 1])) % omega == 0 and all(
        _at_residues(p, x, omega) == 0 for p in system
    )


def _at_residues(p: Polynomial, x: Sequence[fmpq_poly], omega: fmpq_poly) -> fmpq_poly:
    """p(x) in Q[t] / omega."""
    total = fmpq_poly([0])
    for exponents, coefficient in p.to_dict().items():
        term = fmpq_poly([coefficient])
        for base, exponent in zip(x, exponents, strict=True):
            for _ in range(int(exponent)):
                term = term * base % omega
        total += term
    return total % omega


def _values(dimension: int) -> Iterator[tuple[fmpq, ...]]:
    """Rational points of R^d on a curve that no hypersurface holds for ever."""
    for k in itertools.count(1):
        yield tuple(fmpq(k**j + 1, 2 * j + 1) for j in range(1, dimension + 1))
