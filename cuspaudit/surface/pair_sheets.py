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
where h is 0 on a sheet. Where it is zero identically, there is a sheet with h = 0 over
every (x, w): a point p(x) with h = 0 lies on all circles, so it stays, and h = 0 at its
other end as well. On the other sheet h is a multiple of U.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from flint import arb, ctx, fmpq

from cuspaudit.algebra.elimination import exact_quotient
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import Univariate
from cuspaudit.surface.value_circles import ValueCircles

__all__ = ["PairSheets", "pair_sheets"]

Two = tuple[arb, arb]
_Here = tuple[tuple[Two, Two], Two, Two, arb]
_KEPT = 8


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
        even: U.
        odd: V.
        norm: H.
        kept: values over the points asked for last.
    """

    circles: ValueCircles
    normal: tuple[Polynomial, Polynomial]
    offset: Polynomial
    meeting: Polynomial
    even: Polynomial
    odd: Polynomial
    norm: Polynomial
    kept: dict[tuple[fmpq, fmpq, int], _Here] = field(default_factory=dict, repr=False)

    @property
    def ring(self) -> Ring:
        """K[x, w]."""
        return self.circles.ring

    @property
    def are_empty(self) -> bool:
        """Whether nowhere B > 0 and h != 0.

        B = 0; or n = 0, the circles concentric, and B = -l^2; or U = V = 0, as all
        circles pass through two points.
        """
        return bool(self.meeting == 0 or self.critical == 0)

    @property
    def critical(self) -> Polynomial:
        """Zero where h is at x on a sheet, x != w, on which it is not everywhere."""
        return self.even if self.odd == 0 or self.norm == 0 else self.norm

    @property
    def walls(self) -> tuple[Polynomial, ...]:
        """Off their zeros the sheets exist or not, and h != 0 at both ends."""
        x, w = self.circles.ring.gens
        other = self.circles.exchanged(self.critical)
        return (x - w, self.meeting, self.critical, other)

    def over(self, x: fmpq, w: fmpq) -> tuple[int, ...]:
        """The sheets over a point off the walls, but for one on which h = 0."""
        if self._sign(self.meeting, x, w) < 0:
            return ()
        if self.norm != 0:
            return (1, -1)
        return (self._sign(self.even, x, w) * self._sign(self.odd, x, w),)

    def _sign(self, polynomial: Polynomial, x: fmpq, w: fmpq) -> int:
        ring = self.circles.ring
        value = ring.substitute(polynomial, {"x": x, "w": w})
        return Univariate.from_polynomial(ring, value, "x").sign(fmpq(0))

    def fiber_point(
        self, x: fmpq | arb, w: fmpq | arb, sheet: int, bits: int
    ) -> tuple[arb, arb]:
        """Balls of (c, s) of the end over ``x`` of the pair over (x, w).

        Args:
            x: chart coordinate of this end.
            w: of the other end; B > 0 at (x, w).
            sheet: 1 or -1; for the pair (w, x) it is the same.
            bits: of the working precision.
        """
        saved, ctx.prec = ctx.prec, bits
        try:
            rows, along, across, scale = self._at(x, w, bits)
            first, second = along[0] - sheet * across[0], along[1] - sheet * across[1]
            return (
                (rows[0][0] * first + rows[1][0] * second) / scale,
                (rows[0][1] * first + rows[1][1] * second) / scale,
            )
        finally:
            ctx.prec = saved

    def _at(self, x: fmpq | arb, w: fmpq | arb, bits: int) -> _Here:
        """What both sheets over (x, w) have in common; the last few are kept."""
        key = (x, w, bits) if isinstance(x, fmpq) and isinstance(w, fmpq) else None
        if key is None:
            return self._measured(x, w)
        if key not in self.kept:
            while len(self.kept) >= _KEPT:
                del self.kept[next(iter(self.kept))]
            self.kept[key] = self._measured(x, w)
        return self.kept[key]

    def _measured(self, x: fmpq | arb, w: fmpq | arb) -> _Here:
        circles, ring = self.circles, self.circles.ring
        at = {"x": arb(x), "w": arb(w)}
        # the kernel substitutes rationals, and at most sqrt m is left for a ball
        exact = {n: v for n, v in (("x", x), ("w", w)) if isinstance(v, fmpq)}

        def value(polynomial: Polynomial) -> arb:
            return ring.evaluate(ring.substitute(polynomial, exact), at)

        mu = value(circles.metric)
        a, b = (value(p) for p in self.normal)
        along, across = value(self.offset), (mu * value(self.meeting)).sqrt()
        (k11, k12), (k21, k22) = (tuple(map(value, row)) for row in circles.rows)
        scale = 2 * value(circles.exchanged(circles.below)) * (a * a + mu * b * b)
        scale *= value(circles.square)
        return (
            ((k11, k12), (mu * k21, mu * k22)),
            (along * a, along * b),
            (across * b, -across * a / mu),
            scale,
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
    if norm != 0:
        norm = exact_quotient(ring, norm, length)
    return PairSheets(circles, normal, offset, meeting, even, odd, norm)
