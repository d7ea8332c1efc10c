"""Polynomials in the values of a map, pulled back to functions on V."""

from __future__ import annotations

from collections.abc import Sequence

from cuspaudit.algebra.points.ideal import groebner_basis
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem

__all__ = ["pull_back", "vanishes_on"]


def pull_back(
    variety: PolynomialSystem,
    ring: Ring,
    polynomial: Polynomial,
    at: Sequence[Polynomial],
) -> Polynomial:
    """A representative modulo <f> of ``polynomial`` at functions on V.

    Horner's rule, with divisions by f between the steps so that nothing expands.

    Args:
        variety: V = {f = 0} in R^n.
        ring: Q[y_1..y_k].
        polynomial: in ``ring``.
        at: k polynomials in the variables of V, put in place of y_1..y_k.
    """
    return _horner(variety, ring, polynomial, ring.variables, at)


def vanishes_on(variety: PolynomialSystem, polynomial: Polynomial) -> bool:
    """Whether a polynomial belongs to <f>: by plain division, else by a basis.

    Raises:
        UnableError: a Groebner basis of f was needed and is too large.
    """
    rest = _reduce(variety, polynomial)
    if rest == 0 or len(variety.equations) < 2:
        return bool(rest == 0)
    return groebner_basis(variety.ring, variety.equations).contains(rest)


def _horner(
    variety: PolynomialSystem,
    ring: Ring,
    polynomial: Polynomial,
    names: Sequence[str],
    at: Sequence[Polynomial],
) -> Polynomial:
    if not names:
        value = polynomial.leading_coefficient() if polynomial else 0
        return variety.ring.constant(value)
    parts = ring.coefficients(polynomial, names[:1])
    total = variety.ring.constant(0)
    for power in range(max(parts, default=(0,))[0], -1, -1):
        total = _reduce(variety, total * at[0])
        if (power,) in parts:
            total += _horner(variety, ring, parts[power,], names[1:], at[1:])
    return _reduce(variety, total)


def _reduce(variety: PolynomialSystem, polynomial: Polynomial) -> Polynomial:
    """Another representative modulo <f>, by division until nothing changes."""
    previous = None
    while previous != polynomial:
        previous = polynomial
        for f in variety.equations:
            polynomial = divmod(polynomial, f)[1]
    return polynomial
