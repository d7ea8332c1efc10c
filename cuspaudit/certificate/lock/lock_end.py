"""One true posture near the end of a path, at every value of a lock.

At the value d of the lock (counted from what stands in the file) the path begins at
q(d), whose pose is the target, and ends at m(d). For the values |d - e| <= w and a
radius r, the test of `krawczyk` for the box m(d) + [-r, r],

    |Y F(m(d), d)| + |1 - Y A| r  <  r,

is made for all of them at once, with Y a matrix and A an enclosure of F', by joints, on
all these boxes. What is needed is enclosed by the mean value theorem in d: F by its
value and slope at e and its second derivative on all values, A by its values at e and
its slope on all values. The test proves for each value exactly one zero of F in its
box; where the trace of E is above 1 on all boxes it is a posture of the target.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from flint import arb, arb_mat, arb_series

from cuspaudit.certificate.arm import Arm
from cuspaudit.certificate.balls import (
    Frame,
    Row,
    ball_from_fraction,
    dot,
    transposed,
    turned,
    working_precision,
)
from cuspaudit.certificate.cover import Refusal
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.lock.lock_cover import BITS
from cuspaudit.certificate.lock.locked_path import arm_at_lock, moving_point
from cuspaudit.certificate.model import LockCertificate

__all__ = ["LockEnd"]

_TERMS = 3
_DEPTH = 7
"""The values of the lock are halved at most so often."""
_LEAST, _LARGEST = -60, -3
_TRIED = 3
_SECOND = 2

Matrix = list[list[arb_series]]


@dataclass(slots=True)
class LockEnd:
    """The second postures of one certificate.

    Attributes:
        certificate: well formed.
        radius: the largest half side of a box that was needed so far.
        pieces: number of intervals of the lock looked at so far.
    """

    certificate: LockCertificate
    radius: float = 0.0
    pieces: int = 0

    def prove(self) -> arb:
        """Prove the second posture at every value, that it is another, and its sign.

        Returns:
            A lower bound of sign det J on all boxes.

        Raises:
            Refusal: this is not so, or could not be proved.
        """
        stack, bounds = [(Fraction(0), self.certificate.lock.half, 0)], []
        while stack:
            e, w, depth = stack.pop()
            self.pieces += 1
            if depth > _DEPTH:
                raise Refusal(
                    "no second posture of the first posture's pose is proved near the "
                    f"end of the path where the lock is {float(e):.9g} rad from its "
                    "value in the file"
                )
            with working_precision(BITS, _TERMS):
                bound = _Piece(self.certificate, e, w).prove()
            if bound is None:
                half = w / 2
                stack += [(e + half, half, depth + 1), (e - half, half, depth + 1)]
            else:
                bounds.append(bound[0])
                self.radius = max(self.radius, bound[1])
        return min(bounds)


class _Piece:
    """The values |d - e| <= w of the lock."""

    def __init__(self, certificate: LockCertificate, e: Fraction, w: Fraction) -> None:
        self.certificate = certificate
        self.wide = arb(0, ball_from_fraction(w))
        self.at = arb_series([ball_from_fraction(e), 1])
        self.over = self.at + self.wide

    def prove(self) -> tuple[arb, float] | None:
        """A bound of sign det J and the radius; None where nothing is proved."""
        still, moving = (
            _Ends(self.certificate, self.at),
            _Ends(self.certificate, self.over),
        )
        (F, J, _), (beyond, _, _) = still.system(arb(0)), moving.system(arb(0))
        try:
            Y = arb_mat([[x[0] for x in row] for row in J]).mid().inv().mid()
        except ZeroDivisionError:
            return None
        newton = self._newton(Y, F, beyond)
        for exponent in _exponents(newton):
            radius = arb(2) ** exponent
            if self._is_proved(still, moving, Y, newton, radius):
                bound = self._other_side(still, moving, arb(0, radius))
                return None if bound is None else (bound, float(radius))
        return None

    def _newton(
        self, Y: arb_mat, F: list[arb_series], beyond: list[arb_series]
    ) -> arb_mat:
        """Y F(m(d), d) for all values."""
        size = len(F)
        value, slope = (Y * arb_mat(size, 1, [x[k] for x in F]) for k in (0, 1))
        rest = Y * arb_mat(size, 1, [x[_SECOND] for x in beyond])
        return arb_mat(
            size,
            1,
            [
                value[i, 0] + self.wide * (slope[i, 0] + self.wide * rest[i, 0])
                for i in range(size)
            ],
        )

    def _is_proved(
        self, still: _Ends, moving: _Ends, Y: arb_mat, newton: arb_mat, radius: arb
    ) -> bool:
        side, size = arb(0, radius), newton.nrows()
        (_, J, _), (_, slopes, trace) = still.system(side), moving.system(side)
        A = arb_mat(
            [
                [x[0] + self.wide * y[1] for x, y in zip(*rows, strict=True)]
                for rows in zip(J, slopes, strict=True)
            ]
        )
        unit = arb_mat(size, size, [int(i % (size + 1) == 0) for i in range(size**2)])
        moved = (unit - Y * A) * arb_mat(size, 1, [side] * size) - newton
        inside = all(entry.abs_upper() < radius for entry in moved.entries())
        return inside and (trace is None or bool(trace[0] > 1))

    def _other_side(self, still: _Ends, moving: _Ends, side: arb) -> arb | None:
        """A bound of sign det J on the boxes, if they hold other postures."""
        if not _differs(moving, side):
            return None
        value, slope = (
            jacobian_determinant(ends.arm, [q + side for q in ends.second])
            for ends in (still, moving)
        )
        if value is None or slope is None:
            return None
        sign = self.certificate.sign
        if value[0] * sign < 0:
            raise Refusal("det J has the opposite sign at the second posture")
        signed = (value[0] + slope[1] * self.wide) * sign
        return signed.lower() if signed > 0 else None


class _Ends:
    """The arm, the first posture and the end of the path, as power series in d."""

    def __init__(self, certificate: LockCertificate, d: arb_series) -> None:
        self.arm: Arm[arb_series] = arm_at_lock(certificate, d, _constant)
        self.first, self.second = (moving_point(certificate, k, d) for k in (0, -1))
        _, self.target = self.arm.outward(0, self.first)

    def system(self, side: arb) -> tuple[list[arb_series], Matrix, arb_series | None]:
        """F and F' at m(d) + ``side`` as in `krawczyk`, and the trace of E."""
        screws, tip = self.arm.outward(0, [q + side for q in self.second])
        values = [_minus(a, b) for a, b in zip(tip.p, self.target.p, strict=True)]
        columns = [_dense(screw.velocity(tip.p)) for screw in screws]
        trace = None
        if len(screws) == 6:
            E = _turn(self.target, tip)
            trace = E[0][0] + E[1][1] + E[2][2]
            values += [(E[j][i] - E[i][j]) / 2 for i, j in ((1, 2), (2, 0), (0, 1))]
            back = transposed(self.target.R)
            for column, screw in zip(columns, screws, strict=True):
                w = _dense(turned(back, screw.w))
                turning = [
                    sum((a * b for a, b in zip(row, w, strict=True)), _ZERO)
                    for row in E
                ]
                column += [(trace * a - b) / 2 for a, b in zip(w, turning, strict=True)]
        return values, [list(row) for row in zip(*columns, strict=True)], trace


def _exponents(newton: arb_mat) -> range:
    """Exponents of the radii to try: from twice the Newton defect upwards."""
    reach = max(float(entry.abs_upper()) for entry in newton.entries())
    if not math.isfinite(reach):
        return range(0)
    start = max(math.frexp(reach)[1] + 1 if reach > 0 else _LEAST, _LEAST)
    return range(start, min(start + _TRIED, _LARGEST))


def _differs(ends: _Ends, side: arb) -> bool:
    """Whether the boxes are disjoint from the first postures modulo 2 pi."""
    turn = 2 * arb.pi()
    steps = [(b - a)[0] + side for a, b in zip(ends.first, ends.second, strict=True)]
    return any(
        not (step / turn).contains_integer() if joint.turns else not step.contains(0)
        for joint, step in zip(ends.arm.joints, steps, strict=True)
    )


def _turn(target: Frame[arb_series], tip: Frame[arb_series]) -> Matrix:
    """E = R*^T R by rows."""
    columns = transposed(tip.R)
    return [
        [_zero_for_none(dot(row, column)) for column in columns]
        for row in transposed(target.R)
    ]


def _dense(row: Row[arb_series]) -> list[arb_series]:
    return [_zero_for_none(entry) for entry in row]


def _minus(a: arb_series | None, b: arb_series | None) -> arb_series:
    return _zero_for_none(a) - _zero_for_none(b)


def _zero_for_none(entry: arb_series | None) -> arb_series:
    return _ZERO if entry is None else entry


def _constant(ball: arb) -> arb_series:
    return arb_series([ball])


_ZERO = arb_series([0])
