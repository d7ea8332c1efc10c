"""Where the branches of a curve end over a critical value v0 of a linear form mu.

Near v0 a linear form w on the curve is a root of an equation chi(w; v) = 0. Rational
*marks* between the real roots of chi(.; v0) are values of w that no point of the curve
takes while v is so close to v0 that chi(mark; v) has no root on the way. So a branch
over values of v that reach v0 ends at a point whose place between the marks is the
branch's own. Two rulers tell all ends apart: u = lambda, with chi = omega, and one more
form where the projection to (u, v) puts several points on one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from flint import arb, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.algebraic_roots import real_roots_over
from cuspaudit.algebra.points.parametrization import RealPoint
from cuspaudit.algebra.rationals import rationals_between
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import (
    PRECISIONS,
    RealRoot,
    Univariate,
    real_roots,
)
from cuspaudit.errors import CrossCheckError, PrecisionError

__all__ = ["Ruler", "coefficients_of", "ruler", "window"]


@dataclass(frozen=True, eq=False)
class Ruler:
    """Values that a linear form does not take on the curve near mu = v0.

    Attributes:
        form: w.
        zeros: disjoint balls of the real roots of chi(.; v0), increasing.
        marks: rationals round and between them.
        barrier: chi at all marks, a polynomial in v that is not 0 at v0.
    """

    form: tuple[fmpq, ...]
    zeros: tuple[arb, ...]
    marks: tuple[fmpq, ...]
    barrier: fmpq_poly

    def place(self, point: RealPoint) -> int:
        """The number of the interval of marks that w lies in at the point.

        Args:
            point: of the curve, so close to mu = v0 that w is at no mark.
        """
        for bits in PRECISIONS:
            with ctx.workprec(2 * bits):
                balls = point.ball(bits).values()
                w = sum((c * x for c, x in zip(self.form, balls, strict=True)), arb(0))
                place = self.interval(w)
            if place is not None:
                return place
        raise PrecisionError("place of a point between marks", PRECISIONS[-1])

    def interval(self, w: arb) -> int | None:
        """The interval of marks that a ball lies in, None when it meets a mark."""
        for i, (low, high) in enumerate(pairwise(self.marks)):
            if low < w < high:
                return i
        if any(w.contains(mark) for mark in self.marks):
            return None
        raise CrossCheckError("a point of a curve outside the marks round its fiber")


def ruler(
    ring: Ring, chi: Polynomial, form: Sequence[fmpq], value: RealRoot
) -> Ruler | None:
    """The ruler of a form at v0, None when chi(.; v0) is 0.

    Args:
        ring: Q[w, v].
        chi: an equation of the form on the curve.
        form: w.
        value: v0.
    """
    row = coefficients_of(ring, chi)
    minimal = fmpq_poly(value.polynomial)
    if all(c % minimal == 0 for c in row):
        return None
    zeros = real_roots_over([row], value)
    marks = _between(zeros)
    barrier = fmpq_poly([1])
    for mark in marks:
        barrier *= sum((c * mark**k for k, c in enumerate(row)), fmpq_poly([0]))
    return Ruler(tuple(form), tuple(zeros), marks, barrier)


def window(
    value: RealRoot, barrier: fmpq_poly, low: fmpq, high: fmpq
) -> tuple[fmpq, fmpq]:
    """Rationals l < v0 < r in [low, high] such that the barrier has no root in [l, r].

    Args:
        value: v0, between ``low`` and ``high``.
        barrier: not 0 at v0.
        low: below v0.
        high: above it.
    """
    walls = real_roots(Univariate(barrier, fmpq_poly([0])))
    for bits in PRECISIONS:
        here = value.enclosure(bits)
        balls = [wall.enclosure(bits) for wall in walls]
        if any(ball.overlaps(here) for ball in balls):
            continue
        below = max((b for b in [*balls, arb(low)] if b < here), key=arb.mid)
        above = min((b for b in [*balls, arb(high)] if b > here), key=arb.mid)
        left = next(rationals_between(below, here))
        return left, next(rationals_between(here, above))
    raise PrecisionError("neighbourhood of a critical value", PRECISIONS[-1])


def coefficients_of(ring: Ring, polynomial: Polynomial) -> list[fmpq_poly]:
    """The coefficients in Q[v] of a polynomial of Q[w, v], lowest power of w first."""
    first, second = ring.variables
    parts = ring.coefficients(polynomial, [first])
    return [
        Univariate.from_polynomial(
            ring, parts.get((k,), ring.constant(0)), second
        ).rational
        for k in range(max(parts, default=(0,))[0] + 1)
    ]


def _between(zeros: Sequence[arb]) -> tuple[fmpq, ...]:
    """A rational below all the balls, one in each gap, one above."""
    if not zeros:
        return ()
    ends: list[arb | None] = [None, *zeros, None]
    return tuple(next(rationals_between(a, b)) for a, b in pairwise(ends))
