"""The pieces into which limits and zeros of Delta cut the fiber over a point.

Over a point x of the base Delta = P c + Q s + S on a circle, P q + S on a line. On the
circle it has two simple zeros where D = P^2 + Q^2 - S^2 > 0, none where D < 0; where
D = 0 one double zero, opposite to (P, Q) / S, or it vanishes everywhere. Where D = 0
for all x the zero is double, and Delta keeps its sign across. On a line there is one
zero where P != 0.

A fiber with limits l < u is an open interval of the line over it, so each zero counts
once for every turn between l and u, and the pieces are counted upwards from 0. A fiber
without limits has at most one piece of each sign; its pieces are called by their sign.
(With D = 0 the circle without its double zero is still one piece.)
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Protocol

from flint import arb, ctx, fmpq

from cuspaudit.algebra.rationals import exact_rational, simplest_between
from cuspaudit.algebra.univariate import PRECISIONS, RealRoot, Univariate
from cuspaudit.errors import PrecisionError
from cuspaudit.surface.box_edges import Edge, start_of, turn
from cuspaudit.surface.surface import Factor

__all__ = [
    "AtBall",
    "AtRational",
    "AtRoot",
    "FiberPieces",
    "Interval",
    "Stand",
    "steady_angle",
    "turns_between",
]

Interval = tuple[Edge, Edge]
_SHARES = (fmpq(1, 2), fmpq(2, 5), fmpq(4, 7), fmpq(1, 3), fmpq(5, 7), fmpq(1, 5))
_FAR = 1000


class Stand(Protocol):
    """A point of the base at which polynomials are looked at."""

    def sign(self, polynomial: Univariate) -> int:
        """The exact sign of a polynomial there."""

    def value(self, polynomial: Univariate) -> arb:
        """A ball of its value, at the working precision."""

    def ball(self) -> arb:
        """A ball of the point, at the working precision."""


@dataclass(frozen=True)
class AtRational:
    """A rational point of the base."""

    x: fmpq

    def ball(self) -> arb:
        """A ball of the point."""
        return arb(self.x)

    def sign(self, polynomial: Univariate) -> int:
        """The exact sign of a polynomial there."""
        return polynomial.sign(self.x)

    def value(self, polynomial: Univariate) -> arb:
        """A ball of its value."""
        return polynomial(self.x)


@dataclass(frozen=True)
class AtRoot:
    """An algebraic point of the base."""

    x: RealRoot

    def ball(self) -> arb:
        """A ball of the point."""
        return self.x.enclosure(ctx.prec)

    def sign(self, polynomial: Univariate) -> int:
        """The exact sign of a polynomial there, 0 recognised."""
        return polynomial.sign_at(self.x)

    def value(self, polynomial: Univariate) -> arb:
        """A ball of its value."""
        return polynomial(self.x.enclosure(ctx.prec))


@dataclass(frozen=True)
class AtBall:
    """A point of the base known in balls, at no zero of what is asked for.

    Attributes:
        x: balls of it, by the bits of precision.
    """

    x: Callable[[int], arb]

    def ball(self) -> arb:
        """A ball of the point."""
        return self.x(ctx.prec)

    def sign(self, polynomial: Univariate) -> int:
        """The sign of a polynomial that is not 0 there, or is 0 everywhere."""
        if polynomial.is_zero:
            return 0
        saved = ctx.prec
        try:
            for ctx.prec in PRECISIONS:
                value = self.value(polynomial)
                if not value.contains(0):
                    return 1 if value > 0 else -1
        finally:
            ctx.prec = saved
        raise PrecisionError("a sign over a point of the base", PRECISIONS[-1])

    def value(self, polynomial: Univariate) -> arb:
        """A ball of its value."""
        return polynomial(self.ball())


@dataclass(frozen=True, eq=False)
class FiberPieces:
    """Delta along the fiber, and the limits of the fiber.

    Attributes:
        fiber: the factor.
        parts: P, Q, S (or P, S), polynomials in the chart of the base.
        change: D; on a line P^2.
        limits: the open interval of the fiber, or None.
    """

    fiber: Factor
    parts: tuple[Univariate, ...]
    change: Univariate
    limits: Interval | None

    def along(self, edge: Edge) -> Univariate:
        """Delta over the base with the fiber at ``edge``, up to a positive factor."""
        *slopes, constant = self.parts
        rational, surd = constant.rational, constant.surd
        for value, slope in zip(edge.point, slopes, strict=True):
            rational, surd = (
                rational + slope.rational * value,
                surd + slope.surd * value,
            )
        return Univariate(rational, surd, constant.radicand)

    @cached_property
    def at_limits(self) -> tuple[Univariate, ...]:
        """Delta along the two limits of the fiber; empty without limits."""
        return tuple(map(self.along, self.limits)) if self.limits else ()

    def is_critical(self, x: Stand) -> bool:
        """Whether Delta vanishes on the whole fiber over ``x``."""
        return all(x.sign(part) == 0 for part in self.parts)

    def signs(self, x: Stand) -> tuple[int, ...]:
        """The signs that Delta takes on the whole fiber over ``x``."""
        if self.is_critical(x):
            return ()
        if not self.change.is_zero and x.sign(self.change) > 0:
            return (1, -1)
        return (x.sign(self.parts[-1]),)

    def names(self, x: Stand) -> list[int]:
        """The names of the pieces over ``x``: places, or signs without limits."""
        if self.limits is None:
            return list(self.signs(x))
        return [] if self.is_critical(x) else list(range(len(self.zeros(x)) + 1))

    def place(self, x: Stand, edge: Edge) -> int:
        """The place of the piece over ``x`` that ``edge`` lies in.

        Args:
            x: Delta is not 0 at (edge, x).
            edge: between the limits.
        """
        return self._counted(x, edge.ball)

    def place_of(self, x: Stand, angle: Callable[[int], arb], turns: int) -> int:
        """The same for a point known in balls, ``turns`` turns further up."""
        return self._counted(x, lambda bits: angle(bits) + turns * turn())

    def points(self, x: Stand) -> Iterator[Edge]:
        """A rational point of every piece over ``x``, upwards; with limits only."""
        if self.limits is None or self.is_critical(x):
            return
        for bits in PRECISIONS:
            try:
                yield from [self._inside(x, k, bits) for k in self.names(x)]
            except PrecisionError:
                continue
            return
        raise PrecisionError("a point between zeros of det J", PRECISIONS[-1])

    def zeros(self, x: Stand, start: int = PRECISIONS[0]) -> list[arb]:
        """The zeros of Delta over ``x`` between the limits, increasing, disjoint.

        Args:
            x: a point over which Delta does not vanish everywhere.
            start: the least precision, in bits.

        Raises:
            PrecisionError: they could not be told apart.
        """
        assert self.limits is not None, "asked for a fiber with limits only"
        saved = ctx.prec
        try:
            for ctx.prec in (bits for bits in PRECISIONS if bits >= start):
                found = self._between(x, self._circle(x))
                if found is not None and all(a < b for a, b in pairwise(found)):
                    return found
        finally:
            ctx.prec = saved
        raise PrecisionError("zeros of det J over a point", PRECISIONS[-1])

    def turns(self, angle: Callable[[int], arb]) -> list[int]:
        """How many turns further up a point of the fiber lies between the limits.

        Args:
            angle: balls of its angle (or coordinate), by the bits of precision; it is
                at no limit.
        """
        assert self.limits is not None, "asked for a fiber with limits only"
        return turns_between(self.limits, angle)

    def _counted(self, x: Stand, angle: Callable[[int], arb]) -> int:
        saved = ctx.prec
        try:
            for ctx.prec in PRECISIONS:
                at = angle(ctx.prec)
                zeros = self.zeros(x, ctx.prec)
                if not any(zero.overlaps(at) for zero in zeros):
                    return sum(zero < at for zero in zeros)
        finally:
            ctx.prec = saved
        raise PrecisionError("the piece of a point", PRECISIONS[-1])

    def _circle(self, x: Stand) -> list[arb]:
        """The zeros of Delta over ``x``, on a circle modulo whole turns."""
        values = [x.value(part) for part in self.parts]
        if self.fiber.kind == "line":
            slope, constant = values
            return [] if x.sign(self.parts[0]) == 0 else [-constant / slope]
        p, q, s = values
        sign = 0 if self.change.is_zero else x.sign(self.change)
        if sign < 0:
            return []
        if sign == 0:
            return [angle_of(-p / s, -q / s)]
        length, root = p * p + q * q, x.value(self.change).sqrt()
        return [
            angle_of((-s * p - e * q) / length, (-s * q + e * p) / length)
            for e in (root, -root)
        ]

    def _between(self, x: Stand, zeros: list[arb]) -> list[arb] | None:
        """The zeros inside the limits, one for each turn; None for more precision."""
        assert self.limits is not None
        low, high = (edge.ball(ctx.prec) for edge in self.limits)
        at_end = [x.sign(end) == 0 for end in self.at_limits]
        found = []
        if not all(zero.is_finite() for zero in zeros):
            return None
        for zero in zeros:
            for k in windings(self.fiber, low, high, zero):
                here = zero + k * turn()
                near = [here.overlaps(low), here.overlaps(high)]
                if any(n and not e for n, e in zip(near, at_end, strict=True)):
                    return None
                if low < here < high and not any(near):
                    found.append(here)
        return sorted(found, key=lambda ball: ball.mid())

    def _inside(self, x: Stand, place: int, bits: int) -> Edge:
        assert self.limits is not None
        saved, ctx.prec = ctx.prec, bits
        try:
            ends = [edge.ball(bits) for edge in self.limits]
            marks = [ends[0], *self.zeros(x, bits), ends[1]]
            low, high = marks[place : place + 2]
            for share in _SHARES:
                edge = self._near(low + (high - low) * share, (high - low) / 8)
                if edge is not None and low < edge.ball(bits) < high:
                    return edge
        finally:
            ctx.prec = saved
        raise PrecisionError("a point between zeros of det J", bits)

    def _near(self, at: arb, width: arb) -> Edge | None:
        """A short rational point of the chart about ``width`` from ``at``."""
        turns = 0
        if self.fiber.kind == "circle":
            at = at - start_of(self.fiber)
            turns = round(float((at / turn()).mid()))
            at = at - turns * turn()
            if not abs(at) + width < arb.pi():
                return None
        ends = [at - width, at + width]
        if self.fiber.kind == "circle":
            ends = [(end / 2).tan() for end in ends]
        low, high = (exact_rational(end) for end in ends)
        if not low < high or abs(low) > _FAR or abs(high) > _FAR:
            return None
        return Edge(self.fiber, turns, simplest_between(low, high))


def angle_of(c: arb, s: arb) -> arb:
    """A ball of the angle of (c, s), modulo whole turns; c^2 + s^2 = 1 within."""
    return _angle(c, s, _quarter(c, s))


def steady_angle(point: Callable[[int], tuple[arb, arb]]) -> Callable[[int], arb]:
    """The angle of one point in balls, the same number at every precision.

    Args:
        point: balls of (c, s), by the bits of precision.

    Raises:
        PrecisionError: the point was not enclosed.
    """
    for bits in PRECISIONS:
        c, s = point(bits)
        quarter = _quarter(c, s)
        if not (s if quarter % 2 else c).contains(0):
            break
    else:
        raise PrecisionError("the angle of a point", PRECISIONS[-1])

    def angle(bits: int) -> arb:
        saved, ctx.prec = ctx.prec, bits
        try:
            return _angle(*point(bits), quarter)
        finally:
            ctx.prec = saved

    return angle


def _quarter(c: arb, s: arb) -> int:
    """The number of right angles nearest to (c, s), from -1 to 2."""
    if abs(c.mid()) > abs(s.mid()):
        return 2 if c.mid() < 0 else 0
    return 1 if s.mid() > 0 else -1


def _angle(c: arb, s: arb, quarter: int) -> arb:
    beside = -(c / s).atan() if quarter % 2 else (s / c).atan()
    return arb.pi() * quarter / 2 + beside


def windings(factor: Factor, low: arb, high: arb, at: arb) -> range:
    """The numbers of turns that may bring ``at`` between two ends; a few more too."""
    if factor.kind == "line":
        return range(1)
    first, last = (float(((end - at) / turn()).mid()) for end in (low, high))
    return range(int(first) - 2, int(last) + 3)


def turns_between(limits: Interval, angle: Callable[[int], arb]) -> list[int]:
    """The numbers of turns that bring a point between two edges.

    Args:
        limits: of the point's circle or line.
        angle: balls of its angle or coordinate, by the bits of precision; after no
            number of turns is it at an edge.

    Raises:
        PrecisionError: it could not be told from an edge.
    """
    saved = ctx.prec
    try:
        for ctx.prec in PRECISIONS:
            low, high = (edge.ball(ctx.prec) for edge in limits)
            at = angle(ctx.prec)
            if not at.is_finite():
                continue
            here = {
                k: at + k * turn() for k in windings(limits[0].factor, low, high, at)
            }
            if not any(b.overlaps(e) for b in here.values() for e in (low, high)):
                return [k for k, ball in here.items() if low < ball < high]
    finally:
        ctx.prec = saved
    raise PrecisionError("a point at a joint limit", PRECISIONS[-1])
