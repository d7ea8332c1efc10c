"""Every box between two boxes has the same number of aspects.

Two boxes a hair apart have ends that are rational tangents; the limits lie between.
Move the box from the one to the other. The number of components of {Delta != 0} stays
as it is while the zeros of Delta cross the sides of the box transversally and miss its
corners: then a motion of V that keeps {Delta = 0} carries one box to the next, pushing
along the curve near the sides and standing still elsewhere. (The curve may cross itself
inside.) Tested, for all positions of the sides between the two:

- where the fiber is at its limit with chart coordinate t, Delta(t, x) has simple zeros
  in x, none of them at the point that the chart misses: neither its discriminant nor
  its leading coefficient, polynomials in t, has a zero between;
- where the base is at its limit x, the zeros on the fiber are simple: D has no zero;
- at a corner Delta is not 0, in balls.

**At the limit itself.** A box is open, so it is the union of the boxes from the inner
one up to it, an increasing one; where all these have equally many components, each in
one of the next, so has their union. So a zero of the first two tests that is the limit
exactly does no harm: the singular curve touches the side from outside or from inside,
and the count is that of the inner box. It is recognised where the chart coordinate of
the limit is a known quadratic number: a limit of k pi / 4 or k pi / 6.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

from flint import arb, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.elimination import discriminant, leading_coefficient
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import RealRoot, Univariate, real_roots
from cuspaudit.count import Count
from cuspaudit.surface.box_aspects import BoxAspects, Ranges
from cuspaudit.surface.box_edges import Edge, Limit, quadratic_tangent
from cuspaudit.surface.surface import Factor

__all__ = ["count_between", "keeps_count"]

_BITS = 256
Sides = list[tuple[Edge, Edge]]


def count_between(
    outer: BoxAspects, inner: BoxAspects | None, ranges: Ranges = (None, None)
) -> Count:
    """The number of aspects of a box between two; proved if all of them agree.

    Args:
        outer: of the larger box.
        inner: of the smaller, in the same charts, or None.
        ranges: of fiber and base, what the boxes stand for; None where not known.
    """
    count = outer.number_of_aspects
    if inner is None:
        return Count(count, False)
    if inner.number_of_aspects == count and keeps_count(outer, inner):
        return Count(count, True)
    if any(ranges) and keeps_count(outer, inner, ranges):
        return Count(inner.number_of_aspects, True)
    return Count(count, False)


def keeps_count(
    outer: BoxAspects, inner: BoxAspects, ranges: Ranges = (None, None)
) -> bool:
    """Whether all boxes between two have equally many aspects; False if not proved.

    Args:
        outer: of the larger box.
        inner: of the smaller, in the same charts.
        ranges: with them, the boxes from the inner one up to these open ranges.
    """
    fiber = _sides(outer.box.fiber, inner.box.fiber)
    base = _sides(outer.box.base, inner.box.base)
    if all(a == b for a, b in (*fiber, *base)):
        return True
    pieces = outer.pieces
    if pieces.change.is_zero:
        return False
    ends = [[range_.lower, range_.upper] if range_ else None for range_ in ranges]
    return (
        all(
            _is_free(pieces.change, *side, limit)
            for side, limit in _with_limits(base, ends[1])
        )
        and all(
            _crosses(outer, *side, limit)
            for side, limit in _with_limits(fiber, ends[0])
        )
        and all(_misses(outer, *corner) for corner in product(fiber, base))
    )


def _with_limits(
    sides: Sides, limits: list[Limit] | None
) -> Iterator[tuple[tuple[Edge, Edge], Limit | None]]:
    """The sides with the limits that they stand for."""
    own: Sequence[Limit | None] = limits or [None] * len(sides)
    yield from zip(sides, own, strict=True)


def _sides(outer: tuple[Edge, Edge] | None, inner: tuple[Edge, Edge] | None) -> Sides:
    return list(zip(outer, inner, strict=True)) if outer and inner else []


def _is_free(line: Univariate, a: Edge, b: Edge, limit: Limit | None) -> bool:
    """Whether a nonzero polynomial has no zero from one edge to the other.

    One that is the limit itself, between them, does not count.
    """
    if line.is_zero or a.turn != b.turn:
        return False
    low, high = sorted((a.t, b.t))
    between = _hull(low, high)
    near = [r for r in real_roots(line) if r.enclosure(_BITS).overlaps(between)]
    return all(limit is not None and _is_at(root, limit, a.factor) for root in near)


def _is_at(root: RealRoot, limit: Limit, factor: Factor) -> bool:
    """Whether a root is the chart coordinate of a limit, exactly; False if not seen."""
    number = quadratic_tangent(limit, factor)
    if number is None:
        return False
    a, b, m = number
    minimal = fmpq_poly([a * a - m * b * b, -2 * a, 1]).numer()
    saved, ctx.prec = ctx.prec, _BITS
    try:
        here = arb(a) + arb(b) * arb(m).sqrt()
        other = arb(a) - arb(b) * arb(m).sqrt()
        found = root.enclosure(_BITS)
        is_this = found.overlaps(here) and not found.overlaps(other)
    finally:
        ctx.prec = saved
    # the polynomial of a root is irreducible
    return is_this and root.polynomial in (minimal, -minimal)


def _crosses(aspects: BoxAspects, a: Edge, b: Edge, limit: Limit | None) -> bool:
    """Whether Delta has simple zeros along the limits of the fiber between two."""
    ring = Ring(("y", "x"), aspects.pieces.parts[0].radicand)
    along = _along(ring, aspects)
    if along == 0 or along.derivative("x") == 0:
        return False
    lines = [discriminant(ring, along, "x"), leading_coefficient(ring, along, "x")]
    return all(
        line != 0 and _is_free(Univariate.from_polynomial(ring, line, "y"), a, b, limit)
        for line in lines
    )


def _along(ring: Ring, aspects: BoxAspects) -> Polynomial:
    """Delta with the fiber at chart coordinate y, up to a positive factor."""
    fiber, y = aspects.pieces.fiber, ring.gen("y")
    below = fiber.denominator(y)
    factors = (*fiber.numerators(y), below)
    return ring.reduce(
        ring.total(
            _lifted(ring, part) * factor
            for part, factor in zip(aspects.pieces.parts, factors, strict=True)
        )
    )


def _lifted(ring: Ring, line: Univariate) -> Polynomial:
    x = ring.gen("x")

    def plain(coefficients: list[fmpq]) -> Polynomial:
        return ring.total(ring.constant(c) * x**i for i, c in enumerate(coefficients))

    lifted = plain(line.rational.coeffs())
    return lifted + ring.surd * plain(line.surd.coeffs()) if ring.radicand else lifted


def _misses(
    aspects: BoxAspects, fiber: tuple[Edge, Edge], base: tuple[Edge, Edge]
) -> bool:
    """Whether Delta is not 0 at a corner, wherever its two sides are."""
    ring = Ring(("y", "x"), aspects.pieces.parts[0].radicand)
    saved, ctx.prec = ctx.prec, _BITS
    try:
        at = {
            name: _hull(*sorted(edge.t for edge in side))
            for name, side in (("y", fiber), ("x", base))
        }
        return not ring.evaluate(_along(ring, aspects), at).contains(0)
    finally:
        ctx.prec = saved


def _hull(low: fmpq, high: fmpq) -> arb:
    """A ball from one rational to another."""
    return arb(low).union(arb(high))
