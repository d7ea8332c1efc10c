"""Real roots of polynomials whose coefficients lie in Q(alpha), alpha a real root.

An element of Q(alpha) is a polynomial of Q[w] modulo the irreducible polynomial m of
alpha; it is 0 exactly when m divides it. A polynomial over Q(alpha) is the list of its
coefficients, lowest first, the last one not 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, pairwise, product

from flint import acb_poly, arb, arb_poly, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.univariate import PRECISIONS, RealRoot
from cuspaudit.errors import PrecisionError

__all__ = ["real_roots_over"]

_Row = list[fmpq_poly]

#: FLINT's iteration stands still on 4 z^2 + 73 z + 333, but not from elsewhere
_SHIFTS = (fmpq(0), fmpq(1, 3), fmpq(-5, 7))


def real_roots_over(
    polynomials: Sequence[Sequence[fmpq_poly]], root: RealRoot
) -> list[arb]:
    """Disjoint balls of the distinct real zeros of p_1 ... p_k over Q(alpha).

    Args:
        polynomials: p_1..p_k, coefficients in Q[w], lowest first; none is zero at
            w = alpha.
        root: alpha.

    Returns:
        A ball for each zero, increasing; complete.

    Raises:
        PrecisionError: two zeros were not separated.
    """
    m = fmpq_poly(root.polynomial)
    rows = [row for row in (_reduced(p, m) for p in polynomials) if len(row) > 1]
    rows = _coprime([_square_free(row, m) for row in rows], m)
    for bits, shift in product(PRECISIONS[1:], _SHIFTS):
        found = _isolated(rows, root, bits, shift)
        if found is not None:
            return found
    raise PrecisionError("real roots over a real root", PRECISIONS[-1])


def _isolated(
    rows: list[_Row], root: RealRoot, bits: int, shift: fmpq
) -> list[arb] | None:
    """The real zeros, if balls prove that all complex zeros are distinct.

    A zero is real when the smallest box symmetric in the real axis round its ball
    meets no other ball: its conjugate is a zero in the box.
    """
    if not rows:
        return []
    saved, ctx.prec = ctx.prec, bits
    try:
        alpha = root.enclosure(bits)
        total = arb_poly([1])
        for row in rows:
            total *= arb_poly([arb_poly(c)(alpha) for c in row])
        moved = acb_poly(total(arb_poly([shift, 1])))
        zeros = [z + shift for z in moved.roots(arb(2) ** -(bits // 4))]
    except ValueError:
        return None
    finally:
        ctx.prec = saved
    touching = [z for z in zeros if z.imag.contains(0)]
    for z in touching:
        tall = arb(0, abs(z.imag).upper())
        near = [a for a in zeros if a.real.overlaps(z.real) and a.imag.overlaps(tall)]
        if len(near) > 1:
            return None
    balls = sorted((z.real for z in touching), key=lambda ball: ball.mid())
    if any(not a < b for a, b in pairwise(balls)):
        return None
    return balls


def _reduced(polynomial: Sequence[fmpq_poly], m: fmpq_poly) -> _Row:
    row = [c % m for c in polynomial]
    while row and row[-1] == 0:
        row.pop()
    return row


def _coprime(rows: list[_Row], m: fmpq_poly) -> list[_Row]:
    """Square-free polynomials with the same zeros, without common ones."""
    rows = list(rows)
    for i, j in combinations(range(len(rows)), 2):
        rows[j] = _quotient(rows[j], _gcd(rows[i], rows[j], m), m)
    return rows


def _square_free(row: _Row, m: fmpq_poly) -> _Row:
    slope = _reduced([k * c for k, c in enumerate(row)][1:], m)
    return _quotient(row, _gcd(row, slope, m), m)


def _gcd(p: _Row, q: _Row, m: fmpq_poly) -> _Row:
    """The monic greatest common divisor, by Euclid."""
    while q:
        q = _monic(q, m)
        p, q = q, _divide(p, q, m)[1]
    return _monic(p, m)


def _quotient(p: _Row, q: _Row, m: fmpq_poly) -> _Row:
    return _divide(p, q, m)[0] if len(q) > 1 else p


def _monic(row: _Row, m: fmpq_poly) -> _Row:
    inverse = row[-1].xgcd(m)[1]
    return [c * inverse % m for c in row]


def _divide(p: _Row, q: _Row, m: fmpq_poly) -> tuple[_Row, _Row]:
    """Quotient and remainder by a monic polynomial."""
    rest, quotient = list(p), [fmpq_poly([0])] * max(len(p) - len(q) + 1, 0)
    for shift in range(len(p) - len(q), -1, -1):
        top = rest[shift + len(q) - 1]
        quotient[shift] = top
        if top != 0:
            for k, c in enumerate(q):
                rest[shift + k] = (rest[shift + k] - top * c) % m
    return quotient, _reduced(rest, m)
