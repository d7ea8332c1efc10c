"""One-dimensional parametrizations of curves {f = 0}, proved.

The fibers of v = mu(x) on the curve are parametrized by u = lambda(x) over Q(v)
(`geometry.fibers.generic_fiber`, with proof). For forms in general position the curve
is finite over the line of v, which the leading monomials of a Groebner basis show: with
v for one coordinate, least in the degree reverse order, a power of each other
coordinate is among them. Then every x_i is integral over Q[v], so is u, and omega is
monic in u.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

from flint import fmpq

from cuspaudit.algebra.points.ideal import ideal_elements
from cuspaudit.algebra.points.one_dimensional import OneDimensionalParametrization
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import DegenerateMapError, InvalidSystemError, UnableError
from cuspaudit.geometry.fibers.generic_fiber import GenericFiber, generic_fiber
from cuspaudit.geometry.fibers.proposal import Form
from cuspaudit.runtime.clock import time_left, time_limit

__all__ = ["Curve", "one_dimensional_parametrization", "parametrized_curve"]

_TRIES = 6


@dataclass(frozen=True, eq=False)
class Curve:
    """{f = 0} of dimension 1 with its parametrization.

    Attributes:
        system: f in Q[x_1..x_n].
        parametrization: with Z equal to the zero set of f.
        fiber: the generic fiber of mu.

    Every real or complex point of the curve with omega_u != 0 is rho / omega_u; over
    every point of {omega = 0} there is a point of the curve; over a bounded set of
    values of mu the curve is bounded.
    """

    system: PolynomialSystem
    parametrization: OneDimensionalParametrization
    fiber: GenericFiber

    def line(self, form: tuple[fmpq, ...] | Form) -> Polynomial:
        """The linear form with these weights, in the ring of f."""
        ring = self.system.ring
        weights = (fmpq(w) for w in form)
        return ring.total(w * x for w, x in zip(weights, ring.gens, strict=True))


def one_dimensional_parametrization(
    system: PolynomialSystem, seed: int = 1, timeout: float = 60.0
) -> OneDimensionalParametrization:
    """A parametrization R with Z(R) = {f = 0}, a curve in C^n.

    [Paper, section 2.2]. See `parametrized_curve`.
    """
    return parametrized_curve(system, seed, timeout).parametrization


def parametrized_curve(
    system: PolynomialSystem, seed: int = 1, timeout: float = 60.0
) -> Curve:
    """The curve {f = 0} with a parametrization for forms chosen at random, proved.

    That the identities omega = 0, omega_u x_i = rho_i hold modulo <f> is proved, so the
    zero set has no points beside the curve where omega_u != 0, and <f> is reduced
    there; that each component of {omega = 0} comes from one of {f = 0}, by a fiber.

    Args:
        system: f in Q[x_1..x_n], n >= 2.
        seed: of the forms.
        timeout: in s.

    Raises:
        UnableError: not proved for any form tried: {f = 0} has not dimension 1, f
            holds with multiplicity, there are isolated complex points, or the bases
            are too large.
    """
    if system.ring.radicand is not None:
        raise UnableError("one_dimensional_parametrization", "coefficients outside Q")
    if len(system.ring.variables) < 2:
        raise UnableError("one_dimensional_parametrization", "a curve in a line")
    with time_limit(timeout):
        return _of_some_forms(system, seed)


def _of_some_forms(system: PolynomialSystem, seed: int) -> Curve:
    reason = "no projection is finite"
    for first, second in islice(_pairs(len(system.ring.variables), seed), _TRIES):
        if not _is_finite(system, second):
            continue
        mapping = PolynomialMap(system.ring, (_line(system.ring, second),))
        try:
            left = time_left("one_dimensional_parametrization")
            fiber = generic_fiber(system, mapping, left, seed, [first])
            return Curve(system, _parametrization(fiber, first, second), fiber)
        except (DegenerateMapError, InvalidSystemError, UnableError) as error:
            reason = str(error)
    raise UnableError("one_dimensional_parametrization", reason)


def _parametrization(
    fiber: GenericFiber, first: Form, second: Form
) -> OneDimensionalParametrization:
    """The same polynomials with omega monic and the rho_i reduced.

    Raises:
        UnableError: the identities are proved only with a factor in Q[v], which
            isolated points of {f = 0} cause.
    """
    if not fiber.leading.is_constant():
        raise UnableError("one_dimensional_parametrization", "omega is not monic in u")
    omega = fiber.omega / fiber.leading
    rho = (divmod(p / fiber.leading, omega)[1] for p in fiber.rho)
    forms = (tuple(map(fmpq, first)), tuple(map(fmpq, second)))
    names = fiber.variety.ring.variables
    return OneDimensionalParametrization(names, fiber.ring, omega, tuple(rho), forms)


def _is_finite(system: PolynomialSystem, form: Form) -> bool:
    """Whether the leading monomials prove that {f = 0} is finite over the line of v.

    Elements of the ideal suffice: by division Q[x]/<f> is generated over Q[v] by the
    finitely many monomials in the other coordinates under the powers found.
    """
    *others, last = system.ring.variables
    ring = Ring([*others, "v"]) if "v" not in others else Ring([*others, f"v_{last}"])
    *kept, v = ring.gens
    solved = v - ring.total(w * x for w, x in zip(form, kept, strict=False))
    images = [*kept, solved / form[-1]]
    moved = [f.compose(*images, ctx=ring.context) for f in system.equations]
    elements, _ = ideal_elements(ring, moved)
    leading = [tuple(map(int, g.monomial(0))) for g in elements]
    return all(
        any(m[i] > 0 and sum(m) == m[i] for m in leading) for i in range(len(kept))
    )


def _line(ring: Ring, form: Form) -> Polynomial:
    return ring.total(w * x for w, x in zip(form, ring.gens, strict=True))


def _pairs(n: int, seed: int) -> Iterator[tuple[Form, Form]]:
    """Pairs of forms with small weights, none 0."""
    chance = random.Random(seed)
    weights = [w for w in range(-5, 6) if w]
    while True:
        first, second = (tuple(chance.choices(weights, k=n)) for _ in range(2))
        if any(
            a * second[0] != b * first[0] for a, b in zip(first, second, strict=True)
        ):
            yield first, second
