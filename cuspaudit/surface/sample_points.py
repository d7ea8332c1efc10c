"""The postures over one value (``SamplePoints`` for a finite fiber)."""

from __future__ import annotations

from dataclasses import dataclass, field

from flint import acb_poly, arb, ctx, fmpq

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.univariate import PRECISIONS, Univariate, real_balls
from cuspaudit.errors import PrecisionError
from cuspaudit.surface.fibers import FiberPolynomials

__all__ = ["Fiber", "FiberPosture", "sample_points"]


@dataclass(frozen=True, eq=False)
class Fiber:
    """All the postures over the value (u, v).

    Attributes:
        value: (u, v), rational and regular.
        polynomial: F(.; u, v), with simple roots.
        postures: one for each real root, by increasing separating coordinate.
    """

    value: tuple[fmpq, fmpq]
    polynomial: Univariate
    postures: tuple[FiberPosture, ...] = field(repr=False)


class FiberPosture:
    """One posture: a simple real root of F and what follows from it rationally."""

    def __init__(
        self,
        fibers: FiberPolynomials,
        polynomial: Univariate,
        partner: tuple[Univariate, Univariate],
        index: int,
    ) -> None:
        self.fibers = fibers
        self.index = index
        self._polynomial = polynomial
        self._partner = partner
        self._cache: dict[int, tuple[arb, arb]] = {}

    def chart(self, bits: int) -> tuple[arb, arb]:
        """Isolating balls of the chart coordinates (y, x).

        Raises:
            PrecisionError: the second coordinate is not enclosed with ``bits`` bits.
        """
        if bits not in self._cache:
            self._cache[bits] = self._chart(bits)
        return self._cache[bits]

    def _chart(self, bits: int) -> tuple[arb, arb]:
        saved, ctx.prec = ctx.prec, bits
        try:
            t = isolated_real_roots(self._polynomial)[self.index]
            s1, s0 = (p(t) for p in self._partner)
            if s1.contains(0):
                raise PrecisionError("second coordinate of a posture", bits)
            other = -s0 / s1
        finally:
            ctx.prec = saved
        return (t, other) if self.fibers.separating == "y" else (other, t)

    def coordinates(self, bits: int) -> dict[str, arb]:
        """Isolating balls of the variables of R^n."""
        return self.fibers.surface.coordinates(*self.chart(bits))

    def sign(self, numerator: Polynomial) -> int:
        """The sign of a polynomial of K[y, x] that does not vanish here.

        Raises:
            PrecisionError: it could not be told from zero.
        """
        ring, saved = self.fibers.ring, ctx.prec
        try:
            for bits in PRECISIONS:
                ctx.prec = bits
                try:
                    y, x = self.chart(bits)
                except PrecisionError:
                    continue
                value = ring.evaluate(numerator, {"y": y, "x": x})
                if not value.contains(0):
                    return 1 if value > 0 else -1
        finally:
            ctx.prec = saved
        raise PrecisionError("sign of Delta at a posture", PRECISIONS[-1])


def sample_points(fibers: FiberPolynomials, value: tuple[fmpq, fmpq]) -> Fiber:
    """Every real posture over a regular value, isolated.

    [Paper, routine SamplePoints on (f, R - q)]. Complete: the simple real roots of
    F(.; q) are the postures (see ``surface.fibers``).

    Args:
        fibers: the fiber polynomials of R.
        value: q = (u, v), not atypical and outside ``fibers.chart_gap()``.
    """
    ring, name = fibers.ring, fibers.separating
    at = dict(zip(("u", "v"), value, strict=True))

    def specialise(polynomial: Polynomial) -> Univariate:
        return Univariate.from_polynomial(ring, ring.substitute(polynomial, at), name)

    polynomial = specialise(fibers.polynomial)
    s1, s0 = (specialise(p) for p in fibers.linear_factor)
    count = len(isolated_real_roots(polynomial))
    postures = (FiberPosture(fibers, polynomial, (s1, s0), i) for i in range(count))
    return Fiber(value, polynomial, tuple(postures))


def isolated_real_roots(polynomial: Univariate) -> list[arb]:
    """Balls of the real roots of a polynomial with simple roots, increasing.

    Over Q(sqrt m) the complex roots are isolated with ball coefficients, to half of
    the working precision. Where the mirror image of a ball that meets the real axis
    meets no other ball, its root is real: the conjugate has no other ball to lie in.

    Raises:
        PrecisionError: the roots were not separated.
    """
    if polynomial.radicand is None or polynomial.surd == 0:
        return real_balls(polynomial.rational.numer())
    saved, bits = ctx.prec, int(ctx.prec)
    try:
        for ctx.prec in (bits, *(more for more in PRECISIONS if more > bits)):
            try:
                found = acb_poly(polynomial.ball_polynomial).roots(
                    arb(2) ** -(bits // 2)
                )
            except ValueError:
                continue
            near = [root for root in found if root.imag.contains(0)]
            if all(sum(r.conjugate().overlaps(s) for s in found) == 1 for r in near):
                return sorted((r.real for r in near), key=lambda ball: ball.mid())
    finally:
        ctx.prec = saved
    raise PrecisionError("roots of a fiber polynomial", PRECISIONS[-1])
