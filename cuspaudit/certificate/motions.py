"""Rotations and translations of a certificate, enclosed in balls.

Rotation by the angle q about the unit vector n is, exactly,

    R(q) = n n^T + cos q (1 - n n^T) + sin q [n]x                        (Rodrigues)

For an axis v with rational entries n n^T = v v^T / (v.v) is rational; only n itself
needs a square root. Sines and cosines of multiples of a right angle are exact.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Generic

from flint import arb, fmpq

from cuspaudit.certificate.balls import (
    Frame,
    Matrix,
    Row,
    S,
    ball_from_fraction,
    identity,
    lifted,
    minus,
    plus,
    times,
)
from cuspaudit.certificate.model import Loose, Motion, Translate, Vector

__all__ = ["Axis", "axis_from_vector", "frame_from_motions"]


@dataclass(frozen=True, slots=True)
class Axis(Generic[S]):
    """The constants of the rotations about one axis.

    Attributes:
        n: the unit vector of the axis.
        along: n n^T.
        across: 1 - n n^T.
        beside: [n]x, the matrix of the vector product with n.
    """

    n: Row[S]
    along: Matrix[S]
    across: Matrix[S]
    beside: Matrix[S]

    def rotation(self, sine: S, cosine: S) -> Matrix[S]:
        """The rotation about the axis by the angle with this sine and cosine."""
        return (
            self._row(0, sine, cosine),
            self._row(1, sine, cosine),
            self._row(2, sine, cosine),
        )

    def _row(self, i: int, sine: S, cosine: S) -> Row[S]:
        along, across, beside = self.along[i], self.across[i], self.beside[i]
        return (
            _blend(along[0], across[0], cosine, beside[0], sine),
            _blend(along[1], across[1], cosine, beside[1], sine),
            _blend(along[2], across[2], cosine, beside[2], sine),
        )


def _blend(fixed: S | None, a: S | None, x: S, b: S | None, y: S) -> S | None:
    """The sum fixed + a x + b y."""
    return plus(plus(fixed, times(a, x)), times(b, y))


def axis_from_vector(v: Vector, lift: Callable[[arb], S]) -> Axis[S]:
    """Return the axis along ``v``, which is not zero and need not be a unit vector."""
    square = sum((x * x for x in v), Fraction(0))
    length = ball_from_fraction(square).sqrt()
    x, y, z = n = _row(ball_from_fraction(entry) / length for entry in v)
    beside = (
        (None, minus(None, z), y),
        (z, None, minus(None, x)),
        (minus(None, y), x, None),
    )
    along = _matrix((v[i] * v[j] / square for j in range(3)) for i in range(3))
    across = _matrix(
        ((i == j) - v[i] * v[j] / square for j in range(3)) for i in range(3)
    )
    return Axis(
        lifted(n, lift),
        _lifted_matrix(along, lift),
        _lifted_matrix(across, lift),
        _lifted_matrix(beside, lift),
    )


def frame_from_motions(motions: Iterable[Motion]) -> Frame[arb]:
    """Return the product of the motions, left to right; loose ones in all values."""
    frame = identity(arb(1))
    for motion in motions:
        frame = frame.then(_frame(motion))
    return frame


def _frame(motion: Motion) -> Frame[arb]:
    still = identity(arb(1))
    if isinstance(motion, Loose):
        axis = axis_from_vector(motion.axis, arb)
        some = arb(0, ball_from_fraction(motion.within).upper())
        if motion.kind == "turn":
            return Frame(axis.rotation(*some.sin_cos()), still.p)
        x, y, z = axis.n
        return Frame(still.R, (times(x, some), times(y, some), times(z, some)))
    if isinstance(motion, Translate):
        return Frame(still.R, _row(map(ball_from_fraction, motion.vector)))
    sine, cosine = _sin_cos(motion.half_turns, motion.radians)
    return Frame(axis_from_vector(motion.axis, arb).rotation(sine, cosine), still.p)


def _sin_cos(half_turns: Fraction, radians: Fraction) -> tuple[arb, arb]:
    """Sine and cosine of half_turns pi + radians."""
    if not radians:
        turns = fmpq(half_turns.numerator, half_turns.denominator)
        return arb.sin_pi_fmpq(turns), arb.cos_pi_fmpq(turns)
    angle = arb.pi() * ball_from_fraction(half_turns) + ball_from_fraction(radians)
    return angle.sin_cos()


def _row(entries: Iterable[arb]) -> Row[arb]:
    x, y, z = (None if entry.is_zero() else entry for entry in entries)
    return x, y, z


def _matrix(rows: Iterable[Iterable[Fraction]]) -> Matrix[arb]:
    first, second, third = (_row(map(ball_from_fraction, row)) for row in rows)
    return first, second, third


def _lifted_matrix(matrix: Matrix[arb], lift: Callable[[arb], S]) -> Matrix[S]:
    return lifted(matrix[0], lift), lifted(matrix[1], lift), lifted(matrix[2], lift)
