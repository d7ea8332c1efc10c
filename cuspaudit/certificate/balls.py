"""Vectors and frames over balls, or over power series whose coefficients are balls.

A ball (`flint.arb`) is a midpoint and a radius; every operation returns a ball that
contains each result of the operation on members of its operands. The same code runs
over `flint.arb_series`, power series with ball coefficients, so that one description
of an arm serves for values and for Taylor expansions.

An entry that is exactly zero is ``None``: robots are made of right angles, and most
products vanish. Only an exact zero is dropped, so nothing is lost of the enclosure.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from typing import Generic, TypeVar

from flint import arb, arb_series, ctx, fmpq

__all__ = [
    "Frame",
    "Matrix",
    "Row",
    "S",
    "ball_from_fraction",
    "cross",
    "dot",
    "identity",
    "lifted",
    "lifted_frame",
    "minus",
    "plus",
    "times",
    "transposed",
    "turned",
    "working_precision",
]

S = TypeVar("S", arb, arb_series)

Row = tuple[S | None, S | None, S | None]
Matrix = tuple[Row[S], Row[S], Row[S]]


@contextmanager
def working_precision(bits: int, terms: int = 1) -> Iterator[None]:
    """Compute with ``bits`` bits, and with power series of ``terms`` terms."""
    before = ctx.prec, ctx.cap
    ctx.prec, ctx.cap = bits, terms
    try:
        yield
    finally:
        ctx.prec, ctx.cap = before


def ball_from_fraction(number: Fraction) -> arb:
    """A ball of the working precision that contains ``number``."""
    return arb(fmpq(number.numerator, number.denominator))


def times(a: S | None, b: S | None) -> S | None:
    """The product a b."""
    return None if a is None or b is None else a * b


def plus(a: S | None, b: S | None) -> S | None:
    """The sum a + b."""
    if a is None:
        return b
    return a if b is None else a + b


def minus(a: S | None, b: S | None) -> S | None:
    """The difference a - b."""
    if b is None:
        return a
    return -b if a is None else a - b


def dot(u: Row[S], v: Row[S]) -> S | None:
    """The scalar product of two vectors."""
    return plus(plus(times(u[0], v[0]), times(u[1], v[1])), times(u[2], v[2]))


def cross(u: Row[S], v: Row[S]) -> Row[S]:
    """The vector product of two vectors."""
    return (
        minus(times(u[1], v[2]), times(u[2], v[1])),
        minus(times(u[2], v[0]), times(u[0], v[2])),
        minus(times(u[0], v[1]), times(u[1], v[0])),
    )


def turned(R: Matrix[S], v: Row[S]) -> Row[S]:
    """The product R v of a matrix, given by rows, and a vector."""
    return dot(R[0], v), dot(R[1], v), dot(R[2], v)


def transposed(R: Matrix[S]) -> Matrix[S]:
    """The transpose of a matrix; the inverse of a rotation."""
    (a, b, c), (d, e, f), (g, h, i) = R
    return (a, d, g), (b, e, h), (c, f, i)


@dataclass(frozen=True, slots=True)
class Frame(Generic[S]):
    """A rigid motion x -> R x + p, or the frame that it carries the base frame to.

    Attributes:
        R: rotation matrix, by rows.
        p: the frame's origin.
    """

    R: Matrix[S]
    p: Row[S]

    def then(self, motion: Frame[S]) -> Frame[S]:
        """This frame followed by ``motion``, which is described in this frame."""
        columns = transposed(motion.R)
        x, y, z = turned(self.R, motion.p)
        return Frame(
            (
                turned(columns, self.R[0]),
                turned(columns, self.R[1]),
                turned(columns, self.R[2]),
            ),
            (plus(x, self.p[0]), plus(y, self.p[1]), plus(z, self.p[2])),
        )

    def inverse(self) -> Frame[S]:
        """The motion that undoes this one: x -> R^T (x - p)."""
        back = transposed(self.R)
        x, y, z = turned(back, self.p)
        return Frame(back, (minus(None, x), minus(None, y), minus(None, z)))


def identity(one: S) -> Frame[S]:
    """The motion that moves nothing; ``one`` is the number 1."""
    none = (None, None, None)
    return Frame(((one, None, None), (None, one, None), (None, None, one)), none)


def lifted(row: Row[arb], lift: Callable[[arb], S]) -> Row[S]:
    """A row of constants as numbers of another kind, exact zeros dropped."""
    x, y, z = (None if x is None or x.is_zero() else lift(x) for x in row)
    return x, y, z


def lifted_frame(frame: Frame[arb], lift: Callable[[arb], S]) -> Frame[S]:
    """A constant frame as one of numbers of another kind, exact zeros dropped."""
    first, second, third = (lifted(row, lift) for row in frame.R)
    return Frame((first, second, third), lifted(frame.p, lift))
