"""Greatest common divisors over Q(sqrt m), by sympy: FLINT has no such field here."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy
from flint import fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import Univariate

__all__ = ["field_gcd"]


def field_gcd(ring: Ring, polynomials: Sequence[Polynomial], name: str) -> Polynomial:
    """The monic gcd in K[name] of polynomials in ``name`` alone."""
    field = sympy.QQ.algebraic_field(sympy.sqrt(ring.radicand))
    t = sympy.Symbol("t")
    result = sympy.Poly(0, t, domain=field)
    for p in polynomials:
        pair = Univariate.from_polynomial(ring, p, name)
        dense = [
            field([_sympy(pair.surd[i]), _sympy(pair.rational[i])])
            for i in reversed(range(pair.degree + 1))
        ]
        result = sympy.gcd(result, sympy.Poly.from_list(dense, t, domain=field))
    total = ring.constant(0)
    for power, number in enumerate(reversed(result.rep.to_list())):
        surd, plain = [0, 0, *number.to_list()][-2:]
        value = ring.constant(_rational(plain)) + ring.surd * _rational(surd)
        total += value * ring.gen(name) ** power
    return total


def _sympy(number: fmpq) -> Any:
    return sympy.QQ(int(number.p), int(number.q))


def _rational(number: Any) -> fmpq:
    return fmpq(int(number.numerator), int(number.denominator))
