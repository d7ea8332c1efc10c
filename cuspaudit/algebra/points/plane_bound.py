"""A bound on the common points of two plane curves where a third polynomial is not 0.

Every common point of a(x, y) = b(x, y) = 0 lies over a root alpha of the resultant r in
y, if that is not 0 and one of the two depends on y; the points over alpha are the roots
of gcd(a, b) in Q(alpha)[y].
For each irreducible factor m of r the degree of this gcd is bounded modulo a prime
(``algebra.residue_gcd``); where it is more than 1, or h may vanish at a root, the exact
gcd is made square-free and what h has in common with it is taken off. The bounds, times
the degrees of the m, add up to one for all points of C^2 with h != 0.
"""

from __future__ import annotations

from flint import fmpq_poly

from cuspaudit.algebra.elimination import resultant
from cuspaudit.algebra.residue_gcd import Row, common_degree, divided, monic_gcd
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import Univariate
from cuspaudit.runtime.clock import check_time

__all__ = ["plane_bound"]


def plane_bound(
    ring: Ring, first: Polynomial, second: Polynomial, nonzero: Polynomial
) -> int | None:
    """How many points of C^2 have a = b = 0 and h != 0, at most.

    Args:
        ring: Q[x, y].
        first: a.
        second: b.
        nonzero: h.

    Returns:
        None when a and b have a common factor, or neither depends on y.

    >>> ring = Ring(["x", "y"])
    >>> x, y = ring.gens
    >>> plane_bound(ring, x * y, x + y * y - 1, y)
    2
    """
    x, y = ring.variables
    eliminant = resultant(ring, first, second, y)
    if eliminant == 0 or first.derivative(y) == second.derivative(y) == 0:
        return None
    r = Univariate.from_polynomial(ring, eliminant, x).rational
    rows = [_row(ring, p, x, y) for p in (first, second, nonzero)]
    total = 0
    for factor, _ in r.numer().factor()[1]:
        check_time("plane_bound")
        if factor.degree() > 0:
            points = _over(rows, fmpq_poly(factor))
            if points is None:
                return None
            total += int(factor.degree()) * points
    return total


def _over(rows: list[Row], m: fmpq_poly) -> int | None:
    """The bound over one root of m, None when a = b = 0 on the line over it."""
    a, b, h = (_reduced(row, m) for row in rows)
    if not a:
        a, b = b, a
    if not a:
        return None
    degree = common_degree(a, b, m)
    if degree == 0 or not h:
        return 0
    apart = common_degree(h, a, m) == 0 or common_degree(h, b or a, m) == 0
    if degree == 1 and apart:
        return 1
    common = monic_gcd(a, b, m)
    slope = _reduced([k * c for k, c in enumerate(common)][1:], m)
    if slope:
        common = divided(common, monic_gcd(common, slope, m), m)[0]
    return len(common) - len(monic_gcd(common, h, m))


def _reduced(row: Row, m: fmpq_poly) -> Row:
    found = [c % m for c in row]
    while found and found[-1] == 0:
        found.pop()
    return found


def _row(ring: Ring, p: Polynomial, x: str, y: str) -> Row:
    """The coefficients of the powers of y, polynomials in x."""
    parts = ring.coefficients(p, [y])
    powers = range(max((int(k) for (k,) in parts), default=-1) + 1)
    zero = ring.constant(0)
    return [
        Univariate.from_polynomial(ring, parts.get((k,), zero), x).rational
        for k in powers
    ]
