"""Ends of joint ranges, and rational points of a chart next to them.

A limit is a number pi r + b, give or take a radius: exact in the file, known in a ball
where the robot's joint was carried to the model's. Polynomials need a rational
half-angle tangent, which few limits have. So each range is taken twice, once a hair
longer and once a hair shorter, with ends that are rational in the charts. By
monotony the longer box may say "noncuspidal" and the shorter one "cuspidal" for the
box between: an inclusion of boxes keeps det J, the value of R and which points differ,
so a couple of the shorter box is one of the longer box.

A limit that is a multiple of a right angle, and every limit of a slide that is known
exactly, is rational itself; there the two boxes agree.
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb, ctx, fmpq

from cuspaudit.algebra.rationals import exact_rational, simplest_between
from cuspaudit.errors import RetryableError
from cuspaudit.surface.surface import Factor

__all__ = [
    "Edge",
    "Limit",
    "Range",
    "edge_of",
    "is_over_half_turn",
    "quadratic_tangent",
]

ZERO = fmpq(0)
_BITS = 256
#: How far a rational end is moved from its limit, in the half-angle tangent at 0.
_HAIR = fmpq(1, 2**42)
_FAR = 64


@dataclass(frozen=True)
class Limit:
    """The limit pi * ``half_turns`` + ``offset``, give or take ``radius``.

    Attributes:
        half_turns: rational; 0 for a slide.
        offset: rad, or the unit of length of a slide.
        radius: not negative; 0 where the limit is known exactly.
    """

    half_turns: fmpq
    offset: fmpq
    radius: fmpq = ZERO

    def ball(self, bits: int) -> arb:
        """A ball that contains the limit."""
        saved, ctx.prec = ctx.prec, bits
        try:
            center = arb.pi() * self.half_turns + arb(self.offset)
            return center + arb(0, 1) * arb(self.radius) if self.radius else center
        finally:
            ctx.prec = saved

    @property
    def right_angles(self) -> int | None:
        """The number of right angles that this limit is exactly, or None."""
        twice = 2 * self.half_turns
        exact = self.offset == 0 and self.radius == 0 and twice.q == 1
        return int(twice.p) if exact else None


@dataclass(frozen=True)
class Range:
    """The open interval of a joint between two limits, lower < upper."""

    lower: Limit
    upper: Limit


@dataclass(frozen=True)
class Edge:
    """A point of the line over a factor, rational in its chart.

    Attributes:
        factor: a circle or a line.
        turn: how many whole turns are added; 0 on a line.
        t: the chart coordinate.
    """

    factor: Factor
    turn: int
    t: fmpq

    def ball(self, bits: int) -> arb:
        """A ball of the angle, not reduced, or of the coordinate."""
        saved, ctx.prec = ctx.prec, bits
        try:
            if self.factor.kind == "line":
                return arb(self.t)
            return start_of(self.factor) + 2 * arb(self.t).atan() + self.turn * turn()
        finally:
            ctx.prec = saved

    @property
    def point(self) -> tuple[fmpq, ...]:
        """The values of the variables of the factor, rational."""
        if self.factor.kind == "line":
            return (self.t,)
        (c, s), t = self.factor.rotation, self.t
        cos, sin = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        return c * cos - s * sin, s * cos + c * sin


def turn() -> arb:
    """A ball of 2 pi at the working precision."""
    return 2 * arb.pi()


def start_of(factor: Factor) -> arb:
    """The angle of chart coordinate 0 of a circle, in (-pi, pi]."""
    c, s = factor.rotation
    return 2 * arb(s / (1 + c)).atan() if c != -1 else arb.pi()


def is_over_half_turn(width: Limit) -> bool:
    """Whether a range of this length is proved to be longer than half a turn."""
    saved, ctx.prec = ctx.prec, _BITS
    try:
        return bool(width.ball(_BITS) > arb.pi())
    finally:
        ctx.prec = saved


def edge_of(limit: Limit, factor: Factor, up: bool) -> Edge:
    """A rational point of the chart at the limit, or a hair above or below it.

    Args:
        limit: of the joint whose circle or line ``factor`` is.
        factor: with its chart.
        up: whether the edge must not lie below the limit; else not above it.

    Raises:
        RetryableError: the limit is at, or very near, the point the chart misses.
    """
    if factor.kind == "line":
        sign = 1 if up else -1
        if limit.half_turns == 0:
            return Edge(factor, 0, limit.offset + sign * limit.radius)
        return Edge(factor, 0, _next_to(limit.ball(_BITS), up))
    saved, ctx.prec = ctx.prec, _BITS
    try:
        angle = limit.ball(_BITS) - start_of(factor)
        turns = round(float((angle / turn()).mid()))
        local = angle - turns * turn()
        if not abs(local) < arb.pi() - arb(1) / _FAR:
            raise RetryableError("a limit lies where the chart of its circle ends")
        exact = limit.right_angles
        if exact is not None:
            return Edge(factor, turns, _tangent(factor, exact))
        return Edge(factor, turns, _next_to((local / 2).tan(), up))
    finally:
        ctx.prec = saved


def _tangent(factor: Factor, right_angles: int) -> fmpq:
    """The chart coordinate of a multiple of a right angle."""
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[right_angles % 4]
    cos, sin = factor.rotation
    return (s * cos - c * sin) / (1 + c * cos + s * sin)


def quadratic_tangent(limit: Limit, factor: Factor) -> tuple[fmpq, fmpq, int] | None:
    """The chart coordinate a + b sqrt(m) of a limit, as (a, b, m), b != 0.

    None for other limits than multiples of pi/4 and pi/6 known exactly, and where the
    coordinate is rational, or the chart misses it.
    """
    known = limit.offset == 0 and limit.radius == 0 and factor.kind == "circle"
    values = _cosine_and_sine(limit.half_turns) if known else None
    if values is None:
        return None
    (c0, c1), (s0, s1), m = values
    cos, sin = factor.rotation
    above = (s0 * cos - c0 * sin, s1 * cos - c1 * sin)
    below = (1 + c0 * cos + s0 * sin, c1 * cos + s1 * sin)
    norm = below[0] ** 2 - m * below[1] ** 2
    if norm == 0:
        return None
    a = (above[0] * below[0] - m * above[1] * below[1]) / norm
    b = (above[1] * below[0] - above[0] * below[1]) / norm
    return None if b == 0 else (a, b, m)


def _cosine_and_sine(
    half_turns: fmpq,
) -> tuple[tuple[fmpq, fmpq], tuple[fmpq, fmpq], int] | None:
    """Cosine and sine of pi times a rational, each as (a, b) for a + b sqrt(m)."""
    for m, parts in ((2, 4), (3, 6)):
        steps = parts * half_turns
        if steps.q == 1:
            k = int(steps.p)
            return _cosine(m, k), _cosine(m, k - parts // 2), m
    return None


def _cosine(m: int, k: int) -> tuple[fmpq, fmpq]:
    """cos(k pi / 4) for m = 2, cos(k pi / 6) for m = 3."""
    half, zero, one = fmpq(1, 2), fmpq(0), fmpq(1)
    if m == 2:
        table = [(one, zero), (zero, half), (zero, zero)]
    else:
        table = [(one, zero), (zero, half), (half, zero), (zero, zero)]
    turn_ = 2 * (4 if m == 2 else 6)
    k %= turn_
    k = min(k, turn_ - k)
    size = len(table) - 1
    if k <= size:
        return table[k]
    a, b = table[2 * size - k]
    return -a, -b


def _next_to(ball: arb, up: bool) -> fmpq:
    """A short rational at most a hair above (or below) every number of a ball."""
    hair = _HAIR * max(fmpq(1), abs(exact_rational(ball)) ** 2)
    if up:
        end = exact_rational(ball.upper())
        return simplest_between(end, end + hair)
    end = exact_rational(ball.lower())
    return simplest_between(end - hair, end)
