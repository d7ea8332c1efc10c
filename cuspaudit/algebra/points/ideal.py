"""Ideals of Q[x_1..x_n] by exact Groebner bases in the degree reverse order, on FLINT.

FLINT's Buchberger is naive and is given limits on the number, the length and the
bits of its polynomials, so that it never runs away; what it stops at is still made of
elements of the ideal. Remainders by any such elements prove membership when they are
0; only the remainder by a Groebner basis disproves it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import Any, SupportsInt

from flint import (
    Ordering,
    fmpq_mpoly,
    fmpq_mpoly_ctx,
    fmpz_mpoly,
    fmpz_mpoly_ctx,
    fmpz_mpoly_vec,
)

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import primitive
from cuspaudit.errors import TimeLimitError, UnableError
from cuspaudit.runtime.clock import Progress, check_time, seconds_left
from cuspaudit.runtime.own_process import run_in_own_process

__all__ = [
    "LIMITS",
    "GroebnerBasis",
    "dimension_bound",
    "free_variables",
    "groebner_basis",
    "ideal_elements",
    "normal_form",
]

Exponents = tuple[int, ...]

#: elements, terms of an element, bits of a coefficient: well under a second
LIMITS = (200, 2000, 4000)
_AT_ONCE = (60, 300, 500)


@dataclass(frozen=True, eq=False)
class GroebnerBasis:
    """The reduced Groebner basis of an ideal for the degree reverse order.

    Attributes:
        ring: Q[x_1..x_n], n >= 1.
        elements: monic, none divisible by the leading monomial of another, in FLINT's
            context of that order.
    """

    ring: Ring
    elements: tuple[fmpq_mpoly, ...]

    @cached_property
    def leading(self) -> tuple[Exponents, ...]:
        """The exponents of the leading monomials."""
        return tuple(as_exponents(g.monomial(0)) for g in self.elements)

    def normal_form(self, polynomial: Polynomial) -> Polynomial:
        """The only polynomial congruent to ``polynomial`` without leading monomials."""
        return normal_form(self.ring, polynomial, self.elements)

    def contains(self, polynomial: Polynomial) -> bool:
        """Whether ``polynomial`` belongs to the ideal."""
        return bool(self.normal_form(polynomial) == 0)

    @property
    def dimension(self) -> int:
        """The dimension of the zero set in C^n, -1 when it is empty."""
        return free_variables(len(self.ring.variables), self.leading)

    def free_sets(self) -> list[tuple[str, ...]]:
        """The sets of as many variables as the dimension, independent modulo I.

        No leading monomial is in these variables alone; fixed to generic values, they
        leave finitely many points.
        """
        names = self.ring.variables
        used = [{names[i] for i, e in enumerate(m) if e} for m in self.leading]
        chosen = combinations(names, max(self.dimension, 0))
        return [s for s in chosen if not any(own <= set(s) for own in used)]


def groebner_basis(
    ring: Ring,
    polynomials: Iterable[Polynomial],
    limits: tuple[int, int, int] = LIMITS,
) -> GroebnerBasis:
    """The reduced Groebner basis of the ideal that ``polynomials`` generate.

    Exact: FLINT's Buchberger over Z, then autoreduction.

    >>> ring = Ring(["x", "y"])
    >>> x, y = ring.gens
    >>> basis = groebner_basis(ring, [x * y, x * x - y])
    >>> basis.elements, basis.dimension, basis.contains(y**2)
    ((y^2, x*y, x^2 - y), 0, True)

    Raises:
        UnableError: a limit was met, or the coefficients are not in Q.
    """
    found, complete = ideal_elements(ring, polynomials, limits)
    if not complete:
        raise UnableError(
            "groebner_basis",
            f"over {limits[0]} elements, {limits[1]} terms or {limits[2]} bits",
        )
    monic = [g / g.leading_coefficient() for g in found]
    return GroebnerBasis(ring, tuple(sorted(monic, key=_leading_key)))


def ideal_elements(
    ring: Ring,
    polynomials: Iterable[Polynomial],
    limits: tuple[int, int, int] = LIMITS,
) -> tuple[list[fmpq_mpoly], bool]:
    """Generators of the ideal, and whether they are its reduced Groebner basis.

    Returns:
        Polynomials with coprime integer coefficients in the degree reverse context:
        what Buchberger's algorithm had when it ended, or when it met a limit.
    """
    if ring.radicand is not None:
        raise UnableError("groebner_basis", f"coefficients in Q(sqrt{ring.radicand})")
    context = fmpz_mpoly_ctx.get(ring.variables, Ordering.degrevlex)
    integral = [_over_z(context, primitive(ring, p)) for p in polynomials if p != 0]
    if not integral:
        return [], True
    found, complete = _buchberger(context, integral, limits)
    order = degree_reverse_context(ring)
    elements = found.autoreduction() if complete else found
    return [order.from_dict(g.to_dict()) for g in elements], complete


def _buchberger(
    context: fmpz_mpoly_ctx,
    given: Sequence[fmpz_mpoly],
    limits: tuple[int, int, int],
) -> tuple[fmpz_mpoly_vec, bool]:
    """What FLINT has within ``limits``, and whether it is a basis.

    It is done in a few milliseconds, or may take a minute: what is not done at once is
    done in a process of its own where a time limit is in force.

    Raises:
        TimeLimitError: the limit has passed.
    """
    vector = fmpz_mpoly_vec(given, context)
    first = (
        min(limits[0], _AT_ONCE[0]),
        min(limits[1], _AT_ONCE[1]),
        min(limits[2], _AT_ONCE[2]),
    )
    answer: Any = vector.buchberger_naive(first)  # its stub knows no limits
    found, complete = answer
    if complete or first == limits:
        return found, bool(complete)
    left = seconds_left()

    def work(progress: Progress) -> tuple[list[dict[Exponents, int]], bool]:
        told: Any = vector.buchberger_naive(limits)
        elements, is_basis = told
        rows = [
            {as_exponents(e): int(c) for e, c in p.to_dict().items()} for p in elements
        ]
        return rows, bool(is_basis)

    if left is None:
        answer = vector.buchberger_naive(limits)
        return answer[0], bool(answer[1])
    try:
        rows, complete = run_in_own_process(work, timeout=left)
    except TimeLimitError as late:
        raise TimeLimitError("groebner_basis", late.seconds) from None
    return fmpz_mpoly_vec([context.from_dict(row) for row in rows], context), complete


def dimension_bound(
    ring: Ring,
    polynomials: Iterable[Polynomial],
    limits: tuple[int, int, int] = LIMITS,
) -> tuple[int, bool]:
    """An upper bound on the dimension of the zero set, and whether it is attained.

    The leading monomials of any elements of the ideal are some of those of its basis,
    and fewer monomials leave more variables free: a bound is known when a limit is met.
    """
    found, complete = ideal_elements(ring, polynomials, limits)
    leading = [as_exponents(g.monomial(0)) for g in found]
    return free_variables(len(ring.variables), leading), complete


def normal_form(
    ring: Ring, polynomial: Polynomial, divisors: Sequence[fmpq_mpoly]
) -> Polynomial:
    """A remainder of ``polynomial`` by ``divisors``, in ``ring``.

    It differs from ``polynomial`` by an element of the ideal of the divisors, and no
    term of it is divisible by one of their leading monomials. It is 0 only for members
    of the ideal.

    Args:
        ring: the ring of ``polynomial``, over Q.
        polynomial: the dividend.
        divisors: nonzero, in the degree reverse context of the ring.
    """
    rest = degree_reverse_context(ring).from_dict(polynomial.to_dict())
    changed = True
    while changed:
        before = rest
        for divisor in divisors:
            rest = divmod(rest, divisor)[1]
        changed = rest != before
    return ring.context.from_dict(rest.to_dict())


def degree_reverse_context(ring: Ring) -> fmpq_mpoly_ctx:
    """FLINT's context of Q[x_1..x_n] with the degree reverse lexicographic order."""
    return fmpq_mpoly_ctx.get(ring.variables, Ordering.degrevlex)


def as_exponents(exponents: Iterable[SupportsInt]) -> Exponents:
    """The same exponents as plain integers."""
    return tuple(int(e) for e in exponents)


def degree_reverse_key(exponents: Exponents) -> tuple[int, Exponents]:
    """A key by which monomials sort upwards in the degree reverse order."""
    return sum(exponents), tuple(-e for e in reversed(exponents))


def free_variables(n: int, leading: Sequence[Exponents]) -> int:
    """The largest number of variables with no leading monomial in these alone.

    -1 when 1 is among the monomials [Cox, Little, O'Shea, *Ideals, Varieties, and
    Algorithms*, chapter 9].
    """
    used = {frozenset(i for i, e in enumerate(lead) if e) for lead in leading}
    for size in range(n, -1, -1):
        for chosen in combinations(range(n), size):
            if not any(support <= set(chosen) for support in used):
                return size
    return -1


def _leading_key(polynomial: fmpq_mpoly) -> tuple[int, Exponents]:
    return degree_reverse_key(as_exponents(polynomial.monomial(0)))


def _over_z(context: fmpz_mpoly_ctx, polynomial: Polynomial) -> fmpz_mpoly:
    check_time("groebner_basis")
    return context.from_dict({k: c.p for k, c in polynomial.to_dict().items()})
