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
"""

from __future__ import annotations

from itertools import product

from flint import arb, ctx, fmpq

from cuspaudit.algebra.elimination import discriminant, leading_coefficient
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import Univariate, real_roots
from cuspaudit.count import Count
from cuspaudit.surface.box_aspects import BoxAspects
from cuspaudit.surface.box_edges import Edge

__all__ = ["count_between", "keeps_count"]

_BITS = 256
Sides = list[tuple[Edge, Edge]]


def count_between(outer: BoxAspects, inner: BoxAspects | None) -> Count:
    """The number of aspects of a box between two; proved if all of them agree.

    Args:
        outer: of the larger box.
        inner: of the smaller, in the same charts, or None.
    """
    count = outer.number_of_aspects
    same = inner is not None and inner.number_of_aspects == count
    return Count(count, same and inner is not None and keeps_count(outer, inner))


def keeps_count(outer: BoxAspects, inner: BoxAspects) -> bool:
    """Whether all boxes between two have equally many aspects; False if not proved.

    Args:
        outer: of the larger box.
        inner: of the smaller, in the same charts.
    """
    fiber = _sides(outer.box.fiber, inner.box.fiber)
    base = _sides(outer.box.base, inner.box.base)
    if all(a == b for a, b in (*fiber, *base)):
        return True
    pieces = outer.pieces
    if pieces.change.is_zero:
        return False
    return (
        all(_is_free(pieces.change, *side) for side in base)
        and all(_crosses(outer, *side) for side in fiber)
        and all(_misses(outer, *corner) for corner in product(fiber, base))
    )


def _sides(outer: tuple[Edge, Edge] | None, inner: tuple[Edge, Edge] | None) -> Sides:
    return list(zip(outer, inner, strict=True)) if outer and inner else []


def _is_free(line: Univariate, a: Edge, b: Edge) -> bool:
    """Whether a nonzero polynomial has no zero from one edge to the other."""
    if line.is_zero or a.turn != b.turn:
        return False
    low, high = sorted((a.t, b.t))
    between = _hull(low, high)
    return not any(root.enclosure(_BITS).overlaps(between) for root in real_roots(line))


def _crosses(aspects: BoxAspects, a: Edge, b: Edge) -> bool:
    """Whether Delta has simple zeros along the limits of the fiber between two."""
    ring = Ring(("y", "x"), aspects.pieces.parts[0].radicand)
    along = _along(ring, aspects)
    if along == 0 or along.derivative("x") == 0:
        return False
    lines = [discriminant(ring, along, "x"), leading_coefficient(ring, along, "x")]
    return all(
        line != 0 and _is_free(Univariate.from_polynomial(ring, line, "y"), a, b)
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
