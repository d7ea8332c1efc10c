"""Resultants, discriminants, contents: exact elimination on FLINT.

Over Q(sqrt m) the eliminants are computed with sqrt m as one more variable and
reduced afterwards; they are then right up to nothing (a resultant is a polynomial in
the coefficients). Only gcds need the field itself; they go through sympy, once a map.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import gcd, lcm

from flint import Ordering, fmpq, fmpz, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_poly

from cuspaudit.algebra.interpolation import Row, interpolated_discriminant
from cuspaudit.algebra.long_calls import in_time
from cuspaudit.algebra.ring import Polynomial, Ring

__all__ = [
    "deflated",
    "discriminant",
    "exact_quotient",
    "leading_coefficient",
    "primitive_part",
    "rational_factors",
    "resultant",
    "square_free_factors",
]

#: terms times squares of degrees, or degrees, of calls of 0.1 s and longer
_LONG_RESULTANT = 3_000_000
_LONG_DISCRIMINANT = 15_000
_LONG_FACTORS = 200_000


def resultant(ring: Ring, p: Polynomial, q: Polynomial, name: str) -> Polynomial:
    """The resultant of ``p`` and ``q`` with respect to ``name``.

    It vanishes wherever p and q have a common root or their leading coefficients
    vanish together.
    """
    i = ring.context.variable_to_index(name)
    size = (len(p) + len(q)) * (p.degrees()[i] + q.degrees()[i]) ** 2
    (found,) = in_time(
        ring, lambda: [p.resultant(q, name)], size > _LONG_RESULTANT, "resultant"
    )
    return ring.reduce(found)


def discriminant(ring: Ring, p: Polynomial, name: str) -> Polynomial:
    """The discriminant of ``p`` with respect to ``name``, up to a positive constant.

    Denominators are cleared first: FLINT is twice as fast over Z. In two variables
    the discriminant is interpolated from those of univariate polynomials: on the
    curves of critical values four times as fast again, nine times over Q(sqrt m).
    """
    integral = _over_z(ring, p)
    used = [n for n in ring.variables if integral.derivative(n) != 0]
    others = [n for n in used if n != name]
    if len(others) == 1 and name in used:
        rows = _rows(ring, integral, others[0], name)
        halves = interpolated_discriminant(rows, ring.radicand)
        other = ring.gen(others[0])
        plain, surd = (
            ring.total(fmpq(c) * other**i for i, c in enumerate(half) if c)
            for half in halves
        )
        return plain + surd * ring.surd if ring.radicand else plain
    degree = integral.degrees()[ring.context.variable_to_index(name)]
    size = 8 * len(integral) * degree**2

    def work() -> list[Polynomial]:
        return [ring.context.from_dict(integral.discriminant(name).to_dict())]

    (found,) = in_time(ring, work, size > _LONG_DISCRIMINANT, "discriminant")
    return ring.reduce(found)


def deflated(
    ring: Ring, polynomials: Sequence[Polynomial], name: str
) -> tuple[list[Polynomial], int]:
    """The q_i, with p_i = q_i(name^k), for the largest k common to all; and k.

    >>> ring = Ring(["x", "y"])
    >>> x, y = ring.gens
    >>> deflated(ring, [x**4 + y * x**2 + 1], "x")
    ([x^2 + x*y + 1], 2)
    """
    i = ring.context.variable_to_index(name)
    k = gcd(*(int(e[i]) for p in polynomials for e in p.to_dict()))
    if k < 2:
        return list(polynomials), 1
    return [_divided(ring, p, i, k) for p in polynomials], k


def leading_coefficient(ring: Ring, p: Polynomial, name: str) -> Polynomial:
    """The coefficient of the highest power of ``name`` in ``p``."""
    coefficients = ring.coefficients(p, [name])
    return coefficients[max(coefficients)]


def primitive_part(
    ring: Ring, p: Polynomial, name: str, over: Sequence[str]
) -> Polynomial:
    """``p`` divided by the gcd, in K[name], of its coefficients in ``over``.

    The zeros of p in ``name`` that do not depend on ``over`` are removed.
    """
    coefficients = list(ring.coefficients(p, over).values())
    if ring.radicand is None:
        content = coefficients[0]
        for coefficient in coefficients[1:]:
            content = content.gcd(coefficient)
    else:
        from cuspaudit.algebra.field_gcd import field_gcd  # sympy: half a second

        content = field_gcd(ring, coefficients, name)
    return exact_quotient(ring, p, content)


def exact_quotient(ring: Ring, p: Polynomial, q: Polynomial) -> Polynomial:
    """``p / q`` for a divisor ``q`` of ``p`` over K.

    Over Q(sqrt m) both are multiplied by the conjugate of q, so that the division is
    one by a polynomial over Q.
    """
    if ring.radicand is not None:
        p, q = ring.reduce(p * ring.conjugate(q)), ring.norm(q)
    quotient, remainder = divmod(p, q)
    assert remainder == 0, "not a divisor"
    return quotient


def square_free_factors(
    ring: Ring, polynomials: Iterable[Polynomial]
) -> list[Polynomial]:
    """Polynomials, coprime in pairs over Q, with the same zeros as the product.

    Over Q(sqrt m) they are left as they are, constants and repetitions removed.
    """
    found: list[Polynomial] = []
    for p in polynomials:
        if p.is_constant():
            continue
        parts = [p] if ring.radicand else _factors(ring, p)
        found += [part for part in parts if part not in found]
    return found


def rational_factors(ring: Ring, polynomials: Iterable[Polynomial]) -> list[Polynomial]:
    """Irreducible polynomials over Q, distinct, whose zeros contain those of the input.

    Over Q(sqrt m) these are the factors of the norms: the zeros of the conjugate
    polynomials come along.
    """
    found: list[Polynomial] = []
    for p in polynomials:
        parts = _factors(ring, ring.norm(p))
        found += [part for part in parts if part not in found]
    return found


def _factors(ring: Ring, p: Polynomial) -> list[Polynomial]:
    """The irreducible factors over Q, each once."""

    def work() -> list[Polynomial]:
        return [factor for factor, _ in p.factor()[1]]

    size = len(p) * max(p.degrees())
    return in_time(ring, work, size > _LONG_FACTORS, "factors")


def _divided(ring: Ring, p: Polynomial, i: int, k: int) -> Polynomial:
    terms = p.to_dict().items()
    return ring.context.from_dict(
        {(*e[:i], int(e[i]) // k, *e[i + 1 :]): c for e, c in terms}
    )


def _rows(ring: Ring, p: fmpz_mpoly, outer: str, inner: str) -> list[Row]:
    """The coefficients of the powers of ``inner``, polynomials in ``outer``."""
    i, j = ring.variables.index(outer), ring.variables.index(inner)
    size, length = p.degrees()[j] + 1, p.degrees()[i] + 1
    dense = [([fmpz(0)] * length, [fmpz(0)] * length) for _ in range(size)]
    for exponents, coefficient in p.to_dict().items():
        half = int(exponents[-1]) if ring.radicand else 0
        dense[exponents[j]][half][exponents[i]] = coefficient
    return [(fmpz_poly(plain), fmpz_poly(surd)) for plain, surd in dense]


def _over_z(ring: Ring, p: Polynomial) -> fmpz_mpoly:
    context = fmpz_mpoly_ctx.get(ring.context.names(), Ordering.lex)
    terms = p.to_dict()
    common = lcm(*(int(coefficient.q) for coefficient in terms.values()))
    return context.from_dict({e: (c * common).p for e, c in terms.items()})
