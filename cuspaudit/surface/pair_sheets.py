"""Pairs of points of one value, as two sheets over the pairs of base points.

Two points over x and w, x != w, with one value p: the circles of values over x and w
(``surface.value_circles``) meet in p. With <p - C, p - C> - N = <p, p> - 2 <C, p> + E
the difference of the two equations, divided by x - w, is a line <n, p> = m. From C it
has the distance l / |n|, l = m - <n, C>, so the circles meet in the two points

    p = C + (l n +- sqrt(mu B) n') / <n, n>,    B = N <n, n> - l^2,

where n' = (-n_2, n_1 / mu) is across n and B > 0; n and mu B are symmetric in x and w,
and the two signs are two *sheets*. The Jacobian h of R is, up to a nonzero
constant, half the derivative of the equation of the circle by x at p (differentiate it
at R(u, x) and use that dR/du is across p - C), so

    <n, n> h = (x - w) (U +- V sqrt(mu B)).

U^2 - mu B V^2 is divisible by <n, n>: modulo <n, n> it is a multiple of
<n, C_x>^2 + mu (n_1 C_2x - n_2 C_1x)^2 = <n, n> <C_x, C_x>. The quotient H vanishes
where h is 0 on a sheet. Where it is zero identically, h is 0 on one of the sheets
everywhere (all circles pass through one point) and a multiple of U on the other.
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb, ctx, fmpq

from cuspaudit.algebra.elimination import exact_quotient
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.univariate import Univariate
from cuspaudit.surface.value_circles import ValueCircles

__all__ = ["PairSheets", "pair_sheets"]


@dataclass(frozen=True, eq=False)
class PairSheets:
    """The two sheets, by numerators in K[x, w] over positive denominators.

    Attributes:
        circles: of values, not triangular.
        normal: the numerators of n over D(x) D(w), D = ``circles.below``, themselves
            taken for n in what follows.
        offset: l, over 2 D(x) D(w).
        meeting: B, over the square of that; the circles meet in two points where it
            is positive.
        critical: H, or U where H is zero identically; h = 0 at x on a sheet only where
            this vanishes, or x = w.
    """

    circles: ValueCircles
    normal: tuple[Polynomial, Polynomial]
    offset: Polynomial
    meeting: Polynomial
    critical: Polynomial

    @property
    def are_empty(self) -> bool:
        """Whether B > 0 nowhere, as B = 0 or, the circles concentric, B = -l^2."""
        return bool(self.meeting == 0 or not any(self.normal))

    @property
    def walls(self) -> tuple[Polynomial, ...]:
        """Off their zeros the sheets exist or not, and h != 0 at both ends."""
        x, w = self.circles.ring.gens
        other = self.circles.exchanged(self.critical)
        return (x - w, self.meeting, self.critical, other)

    def meet(self, x: fmpq, w: fmpq) -> bool:
        """Whether B > 0, exactly."""
        ring = self.circles.ring
        value = ring.substitute(self.meeting, {"x": x, "w": w})
        return Univariate.from_polynomial(ring, value, "x").sign(fmpq(0)) > 0

    def fiber_point(self, x: fmpq, w: fmpq, sheet: int, bits: int) -> tuple[arb, arb]:
        """Balls of (c, s) of the end over ``x`` of the pair over (x, w).

        Args:
            x: chart coordinate of this end.
            w: of the other end; B > 0 at (x, w).
            sheet: 1 or -1; the pair (w, x) has the same one.
            bits: of the working precision.
        """
        saved, ctx.prec = ctx.prec, bits
        try:
            return self._fiber_point({"x": arb(x), "w": arb(w)}, sheet)
        finally:
            ctx.prec = saved

    def _fiber_point(self, at: dict[str, arb], sheet: int) -> tuple[arb, arb]:
        circles, ring = self.circles, self.circles.ring

        def value(polynomial: Polynomial) -> arb:
            return ring.evaluate(polynomial, at)

        mu = value(circles.metric)
        a, b = (value(p) for p in self.normal)
        along, across = value(self.offset), sheet * (mu * value(self.meeting)).sqrt()
        first, second = along * a - across * b, along * b + across * a / mu
        (k11, k12), (k21, k22) = (tuple(map(value, row)) for row in circles.rows)
        scale = 2 * value(circles.exchanged(circles.below)) * (a * a + mu * b * b)
        scale *= value(circles.square)
        return (
            (k11 * first + mu * k21 * second) / scale,
            (k12 * first + mu * k22 * second) / scale,
        )


def pair_sheets(circles: ValueCircles) -> PairSheets:
    """The sheets of pairs of a map with these circles of values, mu != 0."""
    ring, mu, below = circles.ring, circles.metric, circles.below
    x, w = ring.gens
    reduce, swap = ring.reduce, circles.exchanged
    under = swap(below)

    def divided(p: Polynomial, q: Polynomial) -> Polynomial:
        """(p / q (x) - p / q (w)) / (x - w), over q(x) q(w)."""
        return exact_quotient(ring, reduce(p * swap(q) - swap(p) * q), x - w)

    def slope(p: Polynomial, q: Polynomial) -> Polynomial:
        """The derivative of p / q by x, over q^2."""
        return reduce(p.derivative("x") * q - p * q.derivative("x"))

    first, second = circles.center
    power = reduce(first * first + mu * second * second - circles.square)
    a, b = normal = divided(first, below), divided(second, below)
    length = reduce(a * a + mu * b * b)
    line = divided(power, below**2)
    offset = reduce(line - 2 * under * (a * first + mu * b * second))
    meeting = reduce(4 * circles.square * length * under**2 - offset * offset)
    down, up = slope(first, below), slope(second, below)
    swelling = reduce(exact_quotient(ring, slope(circles.square, below**2), below))
    even, odd = (
        exact_quotient(ring, reduce(p), x - w)
        for p in (
            offset * (a * down + mu * b * up) + swelling * length * under,
            a * up - b * down,
        )
    )
    norm = reduce(even * even - mu * meeting * odd * odd)
    critical = even if odd == 0 or norm == 0 else exact_quotient(ring, norm, length)
    return PairSheets(circles, normal, offset, meeting, critical)
