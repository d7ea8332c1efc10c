"""Real roots of polynomials whose coefficients lie in Q(alpha), alpha a real root.

An element of Q(alpha) is a polynomial of Q[w] modulo the irreducible polynomial m of
alpha; it is 0 exactly when m divides it. A polynomial over Q(alpha) is the list of its
coefficients, lowest first, the last one not 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import combinations, pairwise

from flint import acb, acb_poly, arb, arb_poly, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.elimination import discriminant, resultant
from cuspaudit.algebra.residue_gcd import Row, common_degree, divided, monic_gcd
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import PRECISIONS, RealRoot, Univariate
from cuspaudit.errors import PrecisionError

__all__ = ["common_divisor_over", "real_roots_over"]

_Key = tuple[tuple[fmpq, ...], ...]

_RING = Ring(["w", "z"])

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
    rows = [row for row in (_cut(p, m) for p in polynomials) if len(row) > 1]
    found = _with_double_zeros(rows, root)
    if found is not None:
        return found
    rows = _coprime([_square_free(_reduced(row, m), m) for row in rows], m)
    for bits in PRECISIONS[1:]:
        with ctx.workprec(bits):
            total = _product(rows, root.enclosure(bits))
            found = _real(_isolated(total, _SHIFTS))
        if found is not None:
            return found
    raise PrecisionError("real roots over a real root", PRECISIONS[-1])


def common_divisor_over(
    p: Sequence[fmpq_poly], q: Sequence[fmpq_poly], root: RealRoot
) -> list[fmpq_poly]:
    """The monic greatest common divisor over Q(alpha) of p, which is not 0, and q.

    Args:
        p: coefficients in Q[w], lowest first.
        q: likewise.
        root: alpha.
    """
    m = fmpq_poly(root.polynomial)
    return monic_gcd(_reduced(p, m), _reduced(q, m), m)


def _with_double_zeros(rows: list[Row], root: RealRoot) -> list[arb] | None:
    """The real zeros of P = p_1 ... p_k when no zero is worse than double, or None.

    Let e be the number of polynomials with discriminant 0 at alpha and of pairs with
    resultant 0 there. If P' has distinct zeros, every multiple zero of P is double and
    accounts for one of these at most, so there are e at least; if P is perhaps 0 at
    e zeros of P' only, these are all, and P / prod (z - b)^2 has distinct zeros.
    """
    double = _meetings(rows, fmpq_poly(root.polynomial))
    if double is None:
        return None
    for bits in PRECISIONS[1:]:
        with ctx.workprec(bits):
            total = _product(rows, root.enclosure(bits))
            zeros = _isolated(total.derivative()) if double else []
            if zeros is None:
                continue
            known = [z for z in zeros if acb_poly(total)(z).contains(0)]
            rest = acb_poly(total)
            for z in known:
                rest = _divided(_divided(rest, z), z)
            others = _isolated(rest) if len(known) == double else None
            found = None if others is None else _real([*known, *others])
        if found is not None:
            return found
    return None


def _meetings(rows: list[Row], m: fmpq_poly) -> int | None:
    """The number e of ``_with_double_zeros``; None where a zero is worse than double.

    What does not meet modulo a prime does not meet: most discriminants and resultants
    are not computed. None is a guess, and costs time only.
    """
    keys = [tuple(tuple(c.coeffs()) for c in row) for row in rows]
    reduced, double = [_reduced(row, m) for row in rows], 0
    for row, key in zip(reduced, keys, strict=True):
        common = common_degree(row, _slope(row, m), m) if len(row) > 2 else 0
        if common > 1:
            return None
        double += common == 1 and _discriminant(key) % m == 0
    for (p, a), (q, b) in combinations(zip(reduced, keys, strict=True), 2):
        common = common_degree(p, q, m)
        if common > 1:
            return None
        double += common == 1 and _resultant(a, b) % m == 0
    return double


def _product(rows: list[Row], alpha: arb) -> arb_poly:
    total = arb_poly([1])
    for row in rows:
        total *= arb_poly([arb_poly(c)(alpha) for c in row])
    return total


def _divided(polynomial: acb_poly, zero: acb) -> acb_poly:
    """The quotient by z - ``zero``, where the remainder is 0."""
    quotient, carry = [], acb(0)
    for c in reversed(polynomial.coeffs()[1:]):
        carry = c + carry * zero
        quotient.append(carry)
    return acb_poly(quotient[::-1])


def _isolated(
    polynomial: arb_poly | acb_poly, shifts: Sequence[fmpq] = _SHIFTS[:1]
) -> list[acb] | None:
    """Disjoint balls of the complex zeros, if they are proved to be distinct."""
    if polynomial.degree() < 1:
        return []
    for shift in shifts:
        moved = acb_poly(polynomial)(acb_poly([shift, 1]))
        try:
            return [z + shift for z in moved.roots(arb(2) ** -(ctx.prec // 4))]
        except ValueError:
            continue
    return None


def _real(zeros: list[acb] | None) -> list[arb] | None:
    """The real ones of disjoint zeros of a real polynomial, if that is proved.

    A zero is real when the smallest box symmetric in the real axis round its ball
    meets no other ball: its conjugate is a zero in the box.
    """
    if zeros is None:
        return None
    touching = [z for z in zeros if z.imag.contains(0)]
    for z in touching:
        tall = arb(0, abs(z.imag).upper())
        near = [a for a in zeros if a.real.overlaps(z.real) and a.imag.overlaps(tall)]
        if len(near) > 1:
            return None
    balls = sorted((z.real for z in touching), key=lambda ball: ball.mid())
    return balls if all(a < b for a, b in pairwise(balls)) else None


@lru_cache(maxsize=256)
def _discriminant(key: _Key) -> fmpq_poly:
    p = _bivariate(key)
    return Univariate.from_polynomial(_RING, discriminant(_RING, p, "z"), "w").rational


@lru_cache(maxsize=256)
def _resultant(first: _Key, second: _Key) -> fmpq_poly:
    p, q = _bivariate(first), _bivariate(second)
    return Univariate.from_polynomial(_RING, resultant(_RING, p, q, "z"), "w").rational


def _bivariate(key: _Key) -> Polynomial:
    terms: dict[tuple[int, ...], fmpq]
    terms = {(i, j): c for j, row in enumerate(key) for i, c in enumerate(row) if c}
    return _RING.context.from_dict(terms)


def _cut(polynomial: Sequence[fmpq_poly], m: fmpq_poly) -> Row:
    """The polynomial without the leading coefficients that are 0 at the root."""
    row = list(polynomial)
    while row and row[-1] % m == 0:
        row.pop()
    return row


def _reduced(polynomial: Sequence[fmpq_poly], m: fmpq_poly) -> Row:
    row = [c % m for c in polynomial]
    while row and row[-1] == 0:
        row.pop()
    return row


def _coprime(rows: list[Row], m: fmpq_poly) -> list[Row]:
    """Square-free polynomials with the same zeros, without common ones."""
    rows = list(rows)
    for i, j in combinations(range(len(rows)), 2):
        rows[j] = _quotient(rows[j], monic_gcd(rows[i], rows[j], m), m)
    return rows


def _square_free(row: Row, m: fmpq_poly) -> Row:
    return _quotient(row, monic_gcd(row, _slope(row, m), m), m)


def _slope(row: Row, m: fmpq_poly) -> Row:
    return _reduced([k * c for k, c in enumerate(row)][1:], m)


def _quotient(p: Row, q: Row, m: fmpq_poly) -> Row:
    return divided(p, q, m)[0] if len(q) > 1 else p
