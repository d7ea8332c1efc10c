"""Greatest common divisors over Q(alpha) by residues modulo primes.

alpha is a root of the irreducible m in Z[w]. For a prime l that divides neither the
leading coefficient of m nor a denominator, and modulo which m is square-free,
A = F_l[w] / (m) is a product of fields. Euclid runs in A[z]; a prime for which it meets
a zero divisor is left out, so that the degree is one in all the fields.

**Theorem.** Let p, q be over Q(alpha), p with a leading coefficient that is a unit of
A, and let their gcd in A[z] have degree e. Then the gcd g over Q(alpha) has at most the
degree e; so a polynomial of degree e that divides p and q is the gcd.

*Proof.* O = Z_(l)[w] / (m) is finite and etale over Z_(l), since m is square-free
modulo l and keeps its degree: it is normal. p / lc(p) is monic over O, and the
coefficients of its monic divisor g are integral over O [Bourbaki, *Commutative
Algebra*, V.1.3, proposition 11], hence in O. So g modulo l is a common divisor of the
degree of g in A[z]. QED

Divisibility is tested over Q(alpha), exactly; without Euclid no coefficient grows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice

from flint import fmpq, fmpq_poly, fmpz, nmod_poly

from cuspaudit.runtime.clock import check_time

__all__ = ["Row", "common_degree", "divided", "monic_gcd"]

#: coefficients in Q[w] or F_l[w] of the powers of z, lowest first, the last one not 0
Row = list[fmpq_poly]
_Residue = list[nmod_poly]

_LARGEST = (1 << 62) - 57
#: primes after which a gcd is given up; each adds 62 bits to its coefficients
_MOST = 4000


def common_degree(p: Row, q: Row, m: fmpq_poly) -> int:
    """An upper bound on the degree of the gcd over Q(alpha), nearly always met.

    Args:
        p: reduced modulo m, not 0.
        q: reduced modulo m.
        m: irreducible.
    """
    _, found = next(_images(p, q, m))
    return len(found) - 1


def monic_gcd(p: Row, q: Row, m: fmpq_poly) -> Row:
    """The monic gcd over Q(alpha) of p and q, proved by the theorem of the module.

    Args:
        p: reduced modulo m, not 0.
        q: reduced modulo m.
        m: irreducible.

    Raises:
        ArithmeticError: the coefficients are longer than 4000 primes tell.
    """
    size, modulus, lifted = len(p) + 1, fmpz(1), list[list[fmpz]]()
    for count, (prime, image) in enumerate(islice(_images(p, q, m), _MOST), 1):
        if len(image) > size:
            continue
        if len(image) < size:
            size, modulus, lifted = len(image), fmpz(1), []
        if size == 1:
            return [fmpq_poly([1])]
        lifted = _combined(lifted, modulus, image, prime, int(m.degree()))
        modulus *= prime
        if count & (count - 1):  # tried after 1, 2, 4, 8 .. primes
            continue
        found = _rational(lifted, modulus)
        if found is not None and not any(divided(r, found, m)[1] for r in (p, q)):
            return found
    raise ArithmeticError("a gcd over a number field with too long coefficients")


def divided(p: Row, q: Row, m: fmpq_poly) -> tuple[Row, Row]:
    """Quotient and remainder by a monic polynomial, over Q(alpha)."""
    rest, quotient = list(p), [fmpq_poly([0])] * max(len(p) - len(q) + 1, 0)
    for shift in range(len(p) - len(q), -1, -1):
        top = rest[shift + len(q) - 1] % m
        quotient[shift] = top
        if top != 0:
            for k, c in enumerate(q):
                rest[shift + k] -= top * c
    rest = [c % m for c in rest]
    while rest and rest[-1] == 0:
        rest.pop()
    return quotient, rest


def _images(p: Row, q: Row, m: fmpq_poly) -> Iterator[tuple[int, _Residue]]:
    """(l, monic gcd in A[z]) for primes from the largest of 62 bits down."""
    for prime in _primes():
        check_time("residue_gcd")
        modulus = _residue(m, prime)
        if modulus is None or modulus.degree() < m.degree():
            continue
        if modulus.gcd(modulus.derivative()).degree() > 0:
            continue
        rows = [[_residue(c, prime) for c in row] for row in (p, q)]
        if any(c is None for row in rows for c in row):
            continue
        first, second = ([c for c in row if c is not None] for row in rows)
        found = _euclid(first, second, modulus)
        if found is not None:
            yield prime, found


def _euclid(p: _Residue, q: _Residue, m: nmod_poly) -> _Residue | None:
    """The monic gcd, None when a leading coefficient is no unit; p keeps its degree."""
    monic = _monic(p, m)
    if monic is None:
        return None
    p = monic
    while q and q[-1] == 0:
        q = q[:-1]
    while q:
        monic = _monic(q, m)
        if monic is None:
            return None
        p, q = monic, _remainder(p, monic, m)
    return p


def _monic(row: _Residue, m: nmod_poly) -> _Residue | None:
    common, inverse, _ = row[-1].xgcd(m)
    if common.degree() != 0:
        return None
    return [c * inverse % m for c in row[:-1]] + [common]


def _remainder(p: _Residue, q: _Residue, m: nmod_poly) -> _Residue:
    rest = list(p)
    for shift in range(len(p) - len(q), -1, -1):
        top = rest.pop() % m
        if top != 0:
            for k, c in enumerate(q[:-1]):
                rest[shift + k] -= top * c
    rest = [c % m for c in rest]
    while rest and rest[-1] == 0:
        rest.pop()
    return rest


def _residue(c: fmpq_poly, prime: int) -> nmod_poly | None:
    denominator = int(c.denom()) % prime
    if denominator == 0:
        return None
    image = nmod_poly([int(a) % prime for a in c.numer().coeffs()], prime)
    return image * pow(denominator, -1, prime)


def _combined(
    lifted: list[list[fmpz]],
    modulus: fmpz,
    image: _Residue,
    prime: int,
    degree: int,
) -> list[list[fmpz]]:
    """The coefficients modulo the product of the primes (Chinese remainders)."""
    rows = [[int(c) for c in e.coeffs()] for e in image[:-1]]
    rows = [row + [0] * (degree - len(row)) for row in rows]
    if not lifted:
        return [[fmpz(c) for c in row] for row in rows]
    inverse = pow(int(modulus % prime), -1, prime)
    return [
        [
            a + modulus * ((c - int(a % prime)) * inverse % prime)
            for a, c in zip(old, new, strict=True)
        ]
        for old, new in zip(lifted, rows, strict=True)
    ]


def _rational(lifted: Sequence[Sequence[fmpz]], modulus: fmpz) -> Row | None:
    """Small fractions with these residues, one denominator for all; None if none."""
    bound, common = int((modulus // 2).isqrt()), fmpz(1)
    rows = []
    for row in lifted:
        entries = []
        for residue in row:
            found = _fraction(residue * common % modulus, modulus, bound)
            if found is None:
                return None
            entries.append(found / common)
            common *= found.q
            if common > bound:
                return None
        rows.append(fmpq_poly(entries))
    return [*rows, fmpq_poly([1])]


def _fraction(residue: fmpz, modulus: fmpz, bound: int) -> fmpq | None:
    """The a / b congruent to the residue with |a|, b <= ``bound`` (Wang 1981)."""
    a, b, u, v = int(modulus), int(residue), 0, 1
    while b > bound:
        quotient = a // b
        a, b, u, v = b, a - quotient * b, v, u - quotient * v
    if v == 0 or abs(v) > bound:
        return None
    return fmpq(b) / v


def _primes() -> Iterator[int]:
    candidate = fmpz(_LARGEST)
    while True:
        if candidate.is_prime():
            yield int(candidate)
        candidate -= 2
