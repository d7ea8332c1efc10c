"""The reduced echelon form of an integer matrix, where it has small numbers.

The form is computed modulo Mersenne primes of growing size, its rational numbers are
read off, and what is read is *proved*: a matrix E with 1 at the pivot of its row and 0
at those of the others spans the rows of R, of full rank, if and only if R = R_P E, R_P
the columns of R at the pivots. Determinants of the matrix, which are what elimination
over Z works with, may be twenty times as long as the numbers of the form.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import isqrt

from flint import fmpz, fmpz_mat, fmpz_mod_ctx, fmpz_mod_mat

__all__ = ["rational_echelon"]

_EXPONENTS = (61, 127, 521, 1279, 2281, 4423)
"""2^e - 1 is a prime."""
_SPARE = 24
"""Bits by which a fraction must be smaller than chance would have it."""


def rational_echelon(
    rows: Sequence[Sequence[fmpz]], pivots: Sequence[int], start: int = 0
) -> tuple[fmpz_mat, fmpz, int] | None:
    """E times its common denominator, the denominator, and the number of the prime.

    Args:
        rows: R, integers, at least one row.
        pivots: a column for each row, in the order of the rows of E.
        start: the number of the prime to begin with.

    Returns:
        None when R has no such form with numbers that the largest prime can tell.
    """
    given = fmpz_mat(rows)
    for number in range(start, len(_EXPONENTS)):
        field = _field(_EXPONENTS[number])
        read = _read(rows, pivots, field)
        if read is None:
            continue
        table, below = read
        own = fmpz_mat([[row[k] for k in pivots] for row in rows])
        if own * table == given * below:
            return table, below, number
    return None


def _read(
    rows: Sequence[Sequence[fmpz]], pivots: Sequence[int], field: fmpz_mod_ctx
) -> tuple[fmpz_mat, fmpz] | None:
    """What may be the form, times its denominator, by its residues."""
    order = [*pivots, *(k for k in range(len(rows[0])) if k not in set(pivots))]
    turned = [[row[k] for k in order] for row in rows]
    reduced, rank = fmpz_mod_mat(turned, field).rref()
    size = len(rows)
    if rank < size:
        return None
    table = [[int(v) for v in row] for row in reduced.tolist()]
    if any(table[i][i] != 1 for i in range(size)):
        return None
    modulus, below = int(field.modulus()), 1
    for row in table:
        d = _denominator(row[size:], modulus)
        if d is None:
            return None
        below = below * d // _gcd(below, d)
    most = 1 << (modulus.bit_length() - 1)
    found = [[0] * len(order) for _ in rows]
    for row, line in zip(table, found, strict=True):
        for k, value in zip(order, row, strict=True):
            scaled = value * below % modulus
            line[k] = scaled - modulus if 2 * scaled > most else scaled
    return fmpz_mat(found), fmpz(below)


@lru_cache
def _field(exponent: int) -> fmpz_mod_ctx:
    """The residues modulo a Mersenne prime; FLINT tests that it is one."""
    return fmpz_mod_ctx(fmpz(2) ** exponent - 1)


def _denominator(row: Sequence[int], q: int) -> int | None:
    """A common denominator of the fractions with these residues; None if none shows.

    That of a sum of multiples has mostly all of it, and each fraction adds its rest.
    """
    bound = isqrt(q >> _SPARE)
    mixed = sum((3 * k * k + 7 * k + 1) % 251 * v for k, v in enumerate(row, 1)) % q
    found = 1
    for value in (mixed, *row):
        scaled = value * found % q
        if min(scaled, q - scaled) <= bound:
            continue
        own = _own_denominator(scaled, bound, q)
        if own is None or found * own > bound:
            return None
        found *= own
    return found


def _own_denominator(residue: int, bound: int, q: int) -> int | None:
    """The denominator of the only small fraction with this residue [Wang 1981]."""
    a, b, s, t = q, residue, 0, 1
    while b > bound:
        quotient = a // b
        a, b = b, a - quotient * b
        s, t = t, s - quotient * t
    return abs(t) if 0 < abs(t) <= bound else None


def _gcd(a: int, b: int) -> int:
    return int(fmpz(a).gcd(fmpz(b)))
