"""Cosines, sines and unit vectors: exact where they can be, else rational and near."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

from flint import arb, ctx, fmpq

from cuspaudit.algebra.rationals import exact_rational, simplest_between
from cuspaudit.algebra.ring import Polynomial, Ring, rational
from cuspaudit.robot.chain import Angle, Vector

__all__ = ["cos_sin", "unit_vector"]

_BITS = 256


def cos_sin(
    ring: Ring, angle: Angle, tolerance: Fraction
) -> tuple[Polynomial, Polynomial, bool]:
    """(cos, sin, whether they are exact) in the field of the ring."""
    if angle.radians == 0:
        table = _TABLE.get((ring.radicand, angle.half_turns % 2))
        table = table or _TABLE.get((None, angle.half_turns % 2))
        if table is not None:
            c, s = (
                ring.constant(plain) + (ring.surd * surd if surd else 0)
                for plain, surd in table
            )
            return c, s, True
    near = _near_cos_sin(angle, tolerance)
    return ring.constant(near[0]), ring.constant(near[1]), False


_Table = dict[tuple[int | None, Fraction], tuple[tuple[fmpq, fmpq], ...]]


def _build_table() -> _Table:
    """(radicand, half turns) -> (cos, sin), each as plain + surd sqrt(radicand)."""
    half, zero, one = fmpq(1, 2), fmpq(0), fmpq(1)
    first: dict[tuple[int | None, Fraction], tuple[fmpq, fmpq, fmpq, fmpq]] = {
        (None, Fraction(0)): (one, zero, zero, zero),
        (2, Fraction(1, 4)): (zero, half, zero, half),
        (3, Fraction(1, 6)): (zero, half, half, zero),
        (3, Fraction(1, 3)): (half, zero, zero, half),
    }
    table: _Table = {}
    for (radicand, turns), (c, cs, s, ss) in first.items():
        for quarter in range(4):
            key = (radicand, turns + Fraction(quarter, 2))
            table[key] = ((c, cs), (s, ss))
            c, cs, s, ss = -s, -ss, c, cs
    return table


_TABLE = _build_table()


def _near_cos_sin(angle: Angle, tolerance: Fraction) -> tuple[fmpq, fmpq]:
    """A rational point of the circle within ``tolerance`` of the angle.

    The opposite angle gives the conjugate point, so that axes that two such turns
    make parallel stay parallel.
    """
    saved, ctx.prec = ctx.prec, _BITS
    try:
        value = arb(rational(angle.half_turns)) * arb.pi() + arb(
            rational(angle.radians)
        )
        quarter = round(float(2 * value / arb.pi()))
        t = _simplest(((value - quarter * arb.pi() / 2) / 2).tan(), tolerance / 2)
    finally:
        ctx.prec = saved
    c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    for _ in range(quarter % 4):
        c, s = -s, c
    return c, s


def unit_vector(axis: Vector, tolerance: Fraction) -> tuple[Vector, bool]:
    """(rational unit vector, whether it is the direction exactly)."""
    square = sum((x * x for x in axis), Fraction(0))
    root = rational(square).sqrt() if _is_square(square) else None
    if root is not None:
        length = Fraction(int(root.p), int(root.q))
        x, y, z = (entry / length for entry in axis)
        return (x, y, z), True
    at = max(range(3), key=lambda i: abs(axis[i]))
    sign = 1 if axis[at] > 0 else -1
    saved, ctx.prec = ctx.prec, _BITS
    try:
        length_ball = arb(rational(square)).sqrt()
        rest = [
            _simplest(
                arb(rational(axis[i])) / (length_ball + sign * arb(rational(axis[at]))),
                tolerance / 4,
            )
            for i in range(3)
            if i != at
        ]
    finally:
        ctx.prec = saved
    p, q = (Fraction(int(x.p), int(x.q)) for x in rest)
    below = 1 + p * p + q * q
    found = [2 * p / below, 2 * q / below]
    found.insert(at, sign * (1 - p * p - q * q) / below)
    return (found[0], found[1], found[2]), False


def _is_square(value: Fraction) -> bool:
    return all(
        isqrt(part) ** 2 == part for part in (value.numerator, value.denominator)
    )


def _simplest(value: arb, tolerance: Fraction) -> fmpq:
    """The simplest rational within ``tolerance`` of a narrow ball."""
    middle = exact_rational(value)
    width = rational(tolerance) * fmpq(9, 10)
    return simplest_between(middle - width, middle + width)
