"""Univariate polynomials over Q or Q(sqrt m), and their exact sign at real roots."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import chain, pairwise
from typing import Any

from flint import arb, arb_poly, ctx, fmpq, fmpq_poly, fmpz, fmpz_poly

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import PrecisionError

__all__ = [
    "PRECISIONS",
    "RealRoot",
    "Univariate",
    "disjoint_balls",
    "real_root_balls",
    "real_roots",
]

PRECISIONS = (64, 128, 256, 512, 1024, 2048, 4096)


_ZERO = fmpq_poly([0])


@dataclass(frozen=True)
class Univariate:
    """A + sqrt(m) B with A, B in Q[t]; B = 0 when the field is Q.

    Attributes:
        rational: A.
        surd: B.
        radicand: m, or None.
    """

    rational: fmpq_poly
    surd: fmpq_poly
    radicand: int | None = None

    @classmethod
    def from_polynomial(
        cls, ring: Ring, polynomial: Polynomial, name: str
    ) -> Univariate:
        """``polynomial`` of ``ring``, which may use ``name`` and sqrt m only."""
        names = ring.context.names()
        before = (0,) * names.index(name)
        after = (0,) * (len(names) - len(before) - 1)
        reduced = ring.reduce(polynomial)
        powers = range(max(int(reduced.degrees()[len(before)]), 0) + 1)
        # one coefficient after the other: twelve times as fast as all terms together
        plain = fmpq_poly([reduced[(*before, i, *after)] for i in powers])
        if ring.radicand is None:
            return cls(plain, _ZERO)
        after = (*after[:-1], 1)
        surd = fmpq_poly([reduced[(*before, i, *after)] for i in powers])
        return cls(plain, surd, ring.radicand)

    @property
    def is_zero(self) -> bool:
        """Whether the polynomial is 0."""
        return self.rational == 0 and self.surd == 0

    @property
    def degree(self) -> int:
        """The degree, -1 for 0."""
        return max(self.rational.degree(), self.surd.degree())

    @cached_property
    def norm(self) -> fmpq_poly:
        """A^2 - m B^2 over Q(sqrt m), A itself over Q; zero where the polynomial is."""
        if self.radicand is None:
            return self.rational
        return self.rational**2 - self.radicand * self.surd**2

    def __call__(self, point: fmpq | arb) -> arb:
        """An enclosure of the value at ``point``, at the current precision."""
        return self.ball_polynomial(arb(point))

    @property
    def ball_polynomial(self) -> arb_poly:
        """The polynomial with ball coefficients, at the current precision."""
        value = arb_poly(self.rational)
        if self.radicand is not None and self.surd != 0:
            value += arb_poly(self.surd) * arb(self.radicand).sqrt()
        return value

    def sign(self, point: fmpq) -> int:
        """The exact sign at a rational point."""
        if self.rational(point) == 0 and self.surd(point) == 0:
            return 0
        return _separate(lambda: self(point), "sign at a rational point")

    def sign_at(self, root: RealRoot) -> int:
        """The exact sign at a real algebraic number (0 is recognised).

        Over Q, zero means that the irreducible polynomial of ``root`` divides. Over
        Q(sqrt m) it means that it divides A and B, or that it divides A^2 - m B^2
        while A and sqrt(m) B have opposite signs there.
        """
        defining = fmpq_poly(root.polynomial)
        if self.rational % defining == 0:
            if self.surd % defining == 0:
                return 0
        elif self.radicand is not None and self.norm % defining == 0:
            half = Univariate(self.rational, fmpq_poly([0]), None)
            other = Univariate(self.surd, fmpq_poly([0]), None)
            sign = half.sign_at(root)
            return 0 if other.sign_at(root) == -sign else sign
        return _separate(
            lambda: self(root.enclosure(ctx.prec)), "sign at an algebraic number"
        )

    def multiplicity(self, root: RealRoot) -> int:
        """The multiplicity of ``root`` as a zero of this nonzero polynomial.

        The irreducible polynomial f of the root is divided out of A and B together;
        what remains is divisible by at most one of the two conjugate factors of f, so
        its norm tells the rest.
        """
        defining = fmpq_poly(root.polynomial)
        if self.radicand is None and not _may_divide(root.polynomial, self.rational):
            return 0
        rest, count = self, 0
        while rest.rational % defining == 0 and rest.surd % defining == 0:
            rest = Univariate(
                rest.rational // defining, rest.surd // defining, self.radicand
            )
            count += 1
        if self.radicand is None or rest.sign_at(root) != 0:
            return count
        norm = rest.norm
        while norm % defining == 0:
            norm, count = norm // defining, count + 1
        return count


@dataclass(frozen=True)
class RealRoot:
    """The ``index``-th real root, from the left, of an irreducible polynomial over Z.

    Equality of two roots is equality of these two data, hence exact.
    """

    polynomial: fmpz_poly
    index: int

    def enclosure(self, bits: int) -> arb:
        """An isolating ball, with about ``bits`` correct bits."""
        saved = ctx.prec
        ctx.prec = bits
        try:
            return real_balls(self.polynomial)[self.index]
        finally:
            ctx.prec = saved

    def __hash__(self) -> int:
        return hash((tuple(self.polynomial.coeffs()), self.index))

    def __float__(self) -> float:
        return float(self.enclosure(64).mid())


def _may_divide(factor: fmpz_poly, polynomial: fmpq_poly) -> bool:
    """False only where a primitive factor does not divide: by values at a few integers.

    A primitive polynomial that divides one over Z over Q divides it over Z [Gauss].
    """
    integral = polynomial.numer()
    for point in (2, 3, -5):
        value = factor(point)
        if value != 0 and integral(point) % value != 0:
            return False
    return True


def real_roots(*polynomials: Univariate) -> list[RealRoot]:
    """The distinct real roots of nonzero polynomials together, in increasing order.

    Guarantee: complete, by FLINT's certified isolation of the complex roots of the
    norms (a real root is returned with imaginary part exactly 0).
    """
    return _sorted(list(dict.fromkeys(chain(*map(_roots, polynomials)))))


def _roots(polynomial: Univariate) -> Iterator[RealRoot]:
    for factor, _ in polynomial.norm.numer().factor()[1]:
        if factor.degree() > 0:
            for index in range(len(real_balls(factor))):
                root = RealRoot(factor, index)
                if polynomial.radicand is None or polynomial.sign_at(root) == 0:
                    yield root


def real_root_balls(polynomials: Sequence[Univariate]) -> list[arb]:
    """Disjoint balls, increasing, isolating the real zeros of the product.

    Args:
        polynomials: nonzero; over Q without common zeros. Over Q(sqrt m) the zeros of
            the conjugate polynomials are isolated as well.

    Raises:
        PrecisionError: two roots were not separated.
    """
    integral: list[fmpz_poly] = []
    for polynomial in polynomials:
        if polynomial.radicand is None:
            integral.append(polynomial.norm.numer())
        else:
            factors = [factor for factor, _ in polynomial.norm.numer().factor()[1]]
            integral += [factor for factor in factors if factor not in integral]
    saved = ctx.prec
    try:
        for ctx.prec in PRECISIONS:
            balls = [ball for p in integral for ball in real_balls(p)]
            balls.sort(key=lambda ball: ball.mid())
            if all(a < b for a, b in pairwise(balls)):
                return balls
    finally:
        ctx.prec = saved
    raise PrecisionError("real roots of a product", PRECISIONS[-1])


def real_balls(polynomial: fmpz_poly) -> list[arb]:
    """Balls of the distinct real roots, increasing, at the current precision or better.

    Complete: FLINT isolates every complex root and returns a real one with imaginary
    part exactly 0.
    """
    bits = max(ctx.prec, PRECISIONS[0])
    return list(_real_balls(tuple(polynomial.coeffs()), bits))


@lru_cache(maxsize=4096)
def _real_balls(coefficients: tuple[fmpz, ...], bits: int) -> tuple[arb, ...]:
    """Remembered, because the same fiber is asked for once a posture."""
    saved, ctx.prec = ctx.prec, bits
    try:
        pairs: Any = fmpz_poly(list(coefficients)).complex_roots()
    finally:
        ctx.prec = saved
    balls = [root.real for root, _ in pairs if root.imag == 0]
    return tuple(sorted(balls, key=lambda ball: ball.mid()))


def disjoint_balls(roots: Sequence[RealRoot]) -> list[arb]:
    """Balls of distinct roots, disjoint in pairs, in the order given."""
    for bits in PRECISIONS:
        balls = [root.enclosure(bits) for root in roots]
        ordered = sorted(balls, key=lambda ball: ball.mid())
        if all(a < b for a, b in pairwise(ordered)):
            return balls
    raise PrecisionError("order of distinct real roots", PRECISIONS[-1])


def _sorted(roots: list[RealRoot]) -> list[RealRoot]:
    balls = disjoint_balls(roots)
    pairs = sorted(zip(balls, roots, strict=True), key=lambda pair: pair[0].mid())
    return [root for _, root in pairs]


def _separate(evaluate: Callable[[], arb], what: str) -> int:
    saved = ctx.prec
    try:
        for bits in PRECISIONS:
            ctx.prec = bits
            value = evaluate()
            if value > 0:
                return 1
            if value < 0:
                return -1
    finally:
        ctx.prec = saved
    raise PrecisionError(what, PRECISIONS[-1])
