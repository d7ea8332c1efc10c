"""Polynomials evaluated at rational functions modulo a univariate polynomial.

Over Q the result is exact; modulo a prime it is a hundred times faster and proves what
a number that is not 0 modulo a prime proves.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import fmpq_poly, nmod_poly

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.runtime.clock import check_time

__all__ = ["PRIME", "modulo_prime", "numerators"]

PRIME = (1 << 61) - 1

#: fmpq_poly or nmod_poly, whose stubs share no type
Residue = Any


def numerators(
    bases: Sequence[Residue], omega: Residue, polynomials: Sequence[Polynomial]
) -> list[tuple[Residue, int]]:
    """Numerators modulo ``omega`` of the values at bases[:-1] / bases[-1].

    Args:
        bases: numerators of x_1..x_n and their common denominator.
        omega: the modulus.
        polynomials: p in Q[x_1..x_n]; modulo a prime, without it in a denominator.

    Returns:
        For each p the pair (N, e), e its total degree, with
        N = bases[-1]^e p(bases[:-1] / bases[-1]) modulo omega.

    >>> t = fmpq_poly([0, 1])
    >>> from cuspaudit.algebra.ring import Ring
    >>> (x,) = Ring(["x"]).gens
    >>> numerators([t, t + 1], t**3, [x**2 + 1])
    [(2*x^2 + 2*x + 1, 2)]
    """
    monomials, found = _Monomials(tuple(bases), omega), []
    for polynomial in polynomials:
        degree = max(int(polynomial.total_degree()), 0)
        total = omega * 0
        for exponents, coefficient in polynomial.to_dict().items():
            powers = tuple(int(e) for e in exponents[: len(bases) - 1])
            total += coefficient * monomials((*powers, degree - sum(powers)))
        found.append((total, degree))
    return found


def modulo_prime(polynomial: fmpq_poly) -> nmod_poly | None:
    """The polynomial modulo ``PRIME``, None when that divides a denominator."""
    below = int(polynomial.denom()) % PRIME
    if below == 0:
        return None
    inverse = pow(below, -1, PRIME)
    above = [int(c) * inverse % PRIME for c in polynomial.numer().coeffs()]
    return nmod_poly(above, PRIME)


class _Monomials:
    """Products of powers of given polynomials modulo omega, each computed once."""

    def __init__(self, bases: tuple[Residue, ...], omega: Residue) -> None:
        self.bases, self.omega = bases, omega
        one = (omega * 0 + 1) % omega
        self.known: dict[tuple[int, ...], Residue] = {(0,) * len(bases): one}

    def __call__(self, exponents: tuple[int, ...]) -> Residue:
        if exponents not in self.known:
            check_time("numerators")
            at = next(i for i, e in enumerate(exponents) if e)
            lower = (*exponents[:at], exponents[at] - 1, *exponents[at + 1 :])
            self.known[exponents] = self(lower) * self.bases[at] % self.omega
        return self.known[exponents]
