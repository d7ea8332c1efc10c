"""Events of the base of a box: ways over one, and the intervals between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from flint import arb, ctx, fmpq

from cuspaudit.algebra.rationals import rationals_between
from cuspaudit.algebra.univariate import (
    PRECISIONS,
    RealRoot,
    disjoint_balls,
    real_roots,
)
from cuspaudit.errors import PrecisionError
from cuspaudit.surface.box_edges import Edge
from cuspaudit.surface.fiber_pieces import AtRational, AtRoot, FiberPieces, Interval

__all__ = ["Gate", "gates", "strips_of"]


@dataclass(frozen=True)
class Gate:
    """A way over an event, along a rational point of the fiber.

    Attributes:
        edge: the point of the fiber: Delta is not 0 there from one side to the other.
        sides: rational points of the base left and right of the event, no other event
            between.
        names: of the pieces that the way leads from and to.
    """

    edge: Edge
    sides: tuple[fmpq, fmpq]
    names: tuple[int, int]


def gates(pieces: FiberPieces, events: Sequence[RealRoot], k: int) -> Iterator[Gate]:
    """A way through every piece over event ``k``; the fiber has limits."""
    at = AtRoot(events[k])
    near = [*events[max(k - 1, 0) : k + 2]]
    for edge in pieces.points(at):
        low, high = _beside(events[k], [*near, *real_roots(pieces.along(edge))])
        first, last = (pieces.place(AtRational(x), edge) for x in (low, high))
        yield Gate(edge, (low, high), (first, last))


def _beside(root: RealRoot, others: list[RealRoot]) -> tuple[fmpq, fmpq]:
    """Rational points left and right of a root, with none of the others between."""
    distinct = list(dict.fromkeys([root, *others]))
    balls = disjoint_balls(distinct)
    here = balls[0]
    left = max((b for b in balls if b < here), key=lambda b: b.mid(), default=None)
    right = min((b for b in balls if b > here), key=lambda b: b.mid(), default=None)
    return next(rationals_between(left, here)), next(rationals_between(here, right))


def strips_of(
    limits: Interval | None, events: list[RealRoot]
) -> Iterator[tuple[int, int]]:
    """(turn, interval between events) along the base, from its lower limit on."""
    last = len(events)
    if limits is None:
        yield from ((0, k) for k in range(last + 1))
        return
    low, high = limits
    first = sum(not _is_above(root, low.t) for root in events)
    final = sum(_is_below(root, high.t) for root in events)
    for k in range(low.turn, high.turn + 1):
        start = first if k == low.turn else 0
        end = final if k == high.turn else last
        yield from ((k, interval) for interval in range(start, end + 1))


def _is_below(root: RealRoot, x: fmpq) -> bool:
    return _compare(root, x) < 0


def _is_above(root: RealRoot, x: fmpq) -> bool:
    return _compare(root, x) > 0


def _compare(root: RealRoot, x: fmpq) -> int:
    """The sign of ``root`` - ``x``, exactly."""
    is_zero = root.polynomial(x) == 0
    for bits in PRECISIONS:
        ball, saved = root.enclosure(bits), ctx.prec
        ctx.prec = bits
        try:
            at = arb(x)
        finally:
            ctx.prec = saved
        if ball > at:
            return 1
        if ball < at:
            return -1
        if is_zero and root.polynomial.degree() == 1:
            return 0
    raise PrecisionError("order of a root and a rational number", PRECISIONS[-1])
