"""Polynomial rings over Q or over a real quadratic field, on FLINT.

The coefficient field is Q, or K = Q(sqrt m) with m = 2 or 3 when a twist has its
cosine there. An element of K[x_1..x_n] is a polynomial over Q in one more variable,
``sqrtm``, kept reduced modulo sqrtm^2 - m; the number meant is the positive root.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import reduce as fold
from operator import mul

from flint import Ordering, arb, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

__all__ = ["Polynomial", "Rational", "Ring", "rational"]

Polynomial = fmpq_mpoly
Rational = fmpq


def rational(value: Fraction | int | fmpq) -> fmpq:
    """The same number as FLINT's rational."""
    if isinstance(value, Fraction):
        return fmpq(value.numerator, value.denominator)
    return fmpq(value)


class Ring:
    """K[variables] with K = Q or Q(sqrt ``radicand``).

    Two rings with the same variables and radicand are the same ring to FLINT, so
    their polynomials mix.

    Attributes:
        variables: names, in the order of the monomial order (lexicographic).
        radicand: m of K = Q(sqrt m), square-free, or None for K = Q.
        context: FLINT's context; its last generator is sqrt m unless K = Q.
    """

    def __init__(self, variables: Iterable[str], radicand: int | None = None) -> None:
        self.variables = tuple(variables)
        self.radicand = radicand
        names = self.variables + ((f"sqrt{radicand}",) if radicand else ())
        self.context = fmpq_mpoly_ctx.get(names or ("_",), Ordering.lex)

    def __repr__(self) -> str:
        field = f"Q(sqrt{self.radicand})" if self.radicand else "Q"
        return f"{field}[{', '.join(self.variables)}]"

    def gen(self, name: str) -> Polynomial:
        """The variable ``name``."""
        return self.context.gen(self.context.variable_to_index(name))

    @property
    def gens(self) -> tuple[Polynomial, ...]:
        """The variables, without sqrt m."""
        return self.context.gens()[: len(self.variables)]

    @property
    def surd(self) -> Polynomial:
        """The generator sqrt m of the coefficient field; only when there is one."""
        return self.context.gens()[len(self.variables)]

    def constant(self, value: Fraction | int | fmpq) -> Polynomial:
        """``value`` as a polynomial."""
        return self.context.constant(rational(value))

    def reduce(self, polynomial: Polynomial) -> Polynomial:
        """The representative of degree at most 1 in sqrt m."""
        if self.radicand is None or polynomial.degrees()[-1] < 2:
            return polynomial
        return divmod(polynomial, self.surd**2 - self.radicand)[1]

    def conjugate(self, polynomial: Polynomial) -> Polynomial:
        """The image of ``polynomial`` under sqrt m -> -sqrt m."""
        if self.radicand is None:
            return polynomial
        return polynomial.compose(*self.gens, -self.surd, ctx=self.context)

    def norm(self, polynomial: Polynomial) -> Polynomial:
        """The product with the conjugate over Q; the polynomial itself if K = Q."""
        if self.radicand is None:
            return polynomial
        return self.reduce(polynomial * self.conjugate(polynomial))

    def parts(self, polynomial: Polynomial) -> tuple[Polynomial, Polynomial]:
        """(A, B), both over Q, with ``polynomial`` = A + sqrt(m) B."""
        if self.radicand is None:
            return polynomial, self.constant(0)
        split: tuple[dict[tuple[int, ...], fmpq], ...] = ({}, {})
        for exponents, coefficient in self.reduce(polynomial).to_dict().items():
            split[exponents[-1]][*exponents[:-1], 0] = coefficient
        return self.context.from_dict(split[0]), self.context.from_dict(split[1])

    def substitute(
        self, polynomial: Polynomial, values: Mapping[str, fmpq | int]
    ) -> Polynomial:
        """``polynomial`` with rational ``values`` for some variables, same ring."""
        return polynomial.subs({name: fmpq(value) for name, value in values.items()})

    def evaluate(self, polynomial: Polynomial, values: Mapping[str, arb]) -> arb:
        """An enclosure of ``polynomial`` at balls for every variable it uses.

        Powers are products: python-flint's power of a ball that meets 0 is nan.
        """
        names = self.variables
        total = arb(0)
        for exponents, coefficient in _terms(polynomial):
            term = arb(coefficient)
            for name, exponent in zip(names, exponents, strict=False):
                for _ in range(int(exponent)):
                    term *= values[name]
            if self.radicand and exponents[-1]:
                term *= arb(self.radicand).sqrt() ** exponents[-1]
            total += term
        return total

    def coefficients(
        self, polynomial: Polynomial, names: Sequence[str]
    ) -> dict[tuple[int, ...], Polynomial]:
        """``polynomial`` as a polynomial in ``names`` alone.

        Returns:
            exponents in ``names`` -> coefficient, a polynomial in the other variables.
        """
        where = [self.context.variable_to_index(name) for name in names]
        split: dict[tuple[int, ...], dict[tuple[int, ...], fmpq]] = {}
        for exponents, coefficient in _terms(polynomial):
            key = tuple(exponents[i] for i in where)
            rest = tuple(0 if i in where else e for i, e in enumerate(exponents))
            split.setdefault(key, {})[rest] = coefficient
        return {key: self.context.from_dict(terms) for key, terms in split.items()}

    def from_other(self, polynomial: Polynomial, source: Ring) -> Polynomial:
        """``polynomial`` of ``source`` in this ring, variables matched by name.

        This ring must have every variable that ``polynomial`` uses, and sqrt m if it
        is used.
        """
        target = {name: i for i, name in enumerate(self.context.names())}
        index = [target.get(name) for name in source.context.names()]
        terms = {}
        for exponents, coefficient in polynomial.to_dict().items():
            key = [0] * len(target)
            for i, exponent in zip(index, exponents, strict=True):
                if exponent:
                    assert i is not None, "a variable is missing in the target ring"
                    key[i] = exponent
            terms[tuple(key)] = coefficient
        return self.context.from_dict(terms)

    def total(self, polynomials: Iterable[Polynomial]) -> Polynomial:
        """The sum of ``polynomials``."""
        return fold(lambda a, b: a + b, polynomials, self.constant(0))

    def dot(self, a: Sequence[Polynomial], b: Sequence[Polynomial]) -> Polynomial:
        """The inner product of two columns, reduced."""
        return self.reduce(self.total(map(mul, a, b)))


def _terms(polynomial: Polynomial) -> Iterator[tuple[tuple[int, ...], fmpq]]:
    """Exponents and coefficients; as FLINT's ``to_dict``, twice as fast."""
    return zip(polynomial.monoms(), polynomial.coeffs(), strict=True)
