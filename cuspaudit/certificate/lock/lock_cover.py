"""det J keeps its sign along a path that moves with a lock: boxes that cover it.

On a segment put f(s, d) = sign det J at the parameter s, 0 <= s <= 1, and the value d
of the lock. For a box |s - c| <= h, |d - e| <= w the mean value theorem in d and
Taylor's in s say

    f(s, d)  in  P(s - c) + r (s - c)^N + g (d - e),

where P has the N Taylor coefficients of f(., e) at c, r encloses the N-th coefficient
of f(., e) at every s of the box, and g the derivative of f by d on the whole box; all
come out of det J over power series with ball coefficients. A box on which this does not
prove f > 0 is halved, in the direction in which its points move more. The boxes cover
every segment and every value of the lock.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from flint import arb, arb_series

from cuspaudit.certificate.arm import Arm
from cuspaudit.certificate.balls import S, ball_from_fraction, working_precision
from cuspaudit.certificate.cover import Refusal
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.lock.locked_path import arm_at_lock, moving_point
from cuspaudit.certificate.model import LockCertificate

__all__ = ["BITS", "MAX_BOXES", "LockCover"]

BITS = 96
"""The working precision."""
MAX_BOXES = 4000
"""A path that needs more boxes is refused as not proved."""
_TERMS = 4
_FIRST = 2


@dataclass(slots=True)
class LockCover:
    """The boxes that cover the path of one certificate, at every value of the lock.

    Attributes:
        certificate: well formed.
        boxes: number of boxes looked at so far.
    """

    certificate: LockCertificate
    boxes: int = 0
    _arms: dict[tuple[Fraction, Fraction], tuple[Arm[arb_series], ...]] = field(
        default_factory=dict
    )

    def cover(self) -> arb:
        """Prove that det J has the claimed sign on the whole path, at every value.

        Returns:
            The smallest of the bounds of the boxes: 0 < it <= sign det J.

        Raises:
            Refusal: it has not, or this could not be proved within `MAX_BOXES` boxes.
        """
        with working_precision(BITS, _TERMS + 1):
            return min(map(self._segment, range(len(self.certificate.path) - 1)))

    def _segment(self, index: int) -> arb:
        half = self.certificate.lock.half
        reach, turn = _lengths(self.certificate, index)
        stack = [(Fraction(1, 2), Fraction(1, 2), Fraction(0), half)]
        bounds = []
        while stack:
            self.boxes += 1
            if self.boxes > MAX_BOXES:
                total = len(self.certificate.path) - 1
                where = f"segment {index + 1} of {total}"
                raise Refusal(f"{where}: not proved with {MAX_BOXES} boxes")
            c, h, e, w = stack.pop()
            bound = self._bound(index, c, h, e, w)
            if bound is not None:
                bounds.append(bound)
            elif reach * h >= turn * w:
                stack += [(c + h / 2, h / 2, e, w), (c - h / 2, h / 2, e, w)]
            else:
                stack += [(c, h, e + w / 2, w / 2), (c, h, e - w / 2, w / 2)]
        return min(bounds)

    def _bound(
        self, index: int, c: Fraction, h: Fraction, e: Fraction, w: Fraction
    ) -> arb | None:
        """A positive lower bound of f on a box; None if none is found.

        Raises:
            Refusal: f is not positive at its centre.
        """
        at, over = self._arms_of(e, w)
        s, d, half = (ball_from_fraction(x) for x in (c, e, h))
        box, wide = arb(0, half), arb(0, ball_from_fraction(w))
        centre = self._along(index, at, s, d, _TERMS)
        if centre[0] < 0:
            raise Refusal(
                f"det J has the opposite sign at s = {float(c):.9g} of segment "
                f"{index + 1}, the lock {float(e):.9g} rad from its value in the file"
            )
        value = _horner(centre, box)
        if not value > 0:
            return None
        rest = self._along(index, at, s + box, d, _TERMS + 1)[_TERMS]
        value += rest * _power(box, _TERMS)
        if not value > 0:
            return None
        value += self._slope(index, over, s + box, d + wide) * wide
        return value.lower() if value > 0 else None

    def _arms_of(self, e: Fraction, w: Fraction) -> tuple[Arm[arb_series], ...]:
        """The arm at the centre, and with its derivative over the values of a box."""
        if (e, w) not in self._arms:
            d, wide = ball_from_fraction(e), arb(0, ball_from_fraction(w))
            self._arms[e, w] = (
                arm_at_lock(self.certificate, arb_series([d]), _constant),
                arm_at_lock(self.certificate, arb_series([d + wide, 1]), _constant),
            )
        return self._arms[e, w]

    def _along(
        self, index: int, arm: Arm[arb_series], s: arb, d: arb, terms: int
    ) -> list[arb]:
        """Taylor coefficients of f(., d) at ``s``."""
        start, step = self._ends(index, d)
        q = [arb_series([a + s * b, b]) for a, b in zip(start, step, strict=True)]
        return self._signed(arm, q, terms)

    def _slope(self, index: int, arm: Arm[arb_series], s: arb, d: arb) -> arb:
        """The derivative of f by the lock at every point of the balls."""
        with working_precision(BITS, _FIRST):
            start, step = self._ends(index, arb_series([d, 1]))
            q = [a + s * b for a, b in zip(start, step, strict=True)]
            return self._signed(arm, q, _FIRST)[1]

    def _signed(
        self, arm: Arm[arb_series], q: list[arb_series], terms: int
    ) -> list[arb]:
        value = jacobian_determinant(arm, q)
        if value is None:
            return [arb(0)] * terms
        return [value[k] * self.certificate.sign for k in range(terms)]

    def _ends(self, index: int, d: S) -> tuple[list[S], list[S]]:
        """Start and step of a segment at the value d."""
        start, end = (moving_point(self.certificate, k, d) for k in (index, index + 1))
        return start, [b - a for a, b in zip(start, end, strict=True)]


def _lengths(certificate: LockCertificate, index: int) -> tuple[Fraction, Fraction]:
    """How far the joints go on a segment, and the lock and the joints with it."""
    a, b = certificate.path[index : index + 2]
    u, v = certificate.slopes[index : index + 2]
    reach = sum((abs(y - x) for x, y in zip(a, b, strict=True)), Fraction(0))
    rates = (abs(x) for row in (u, v) for x in row)
    return reach, 1 + sum(rates, Fraction(0)) / 2


def _constant(ball: arb) -> arb_series:
    return arb_series([ball])


def _horner(coefficients: list[arb], t: arb) -> arb:
    value = arb(0)
    for coefficient in reversed(coefficients):
        value = value * t + coefficient
    return value


def _power(t: arb, exponent: int) -> arb:
    value = arb(1)
    for _ in range(exponent):
        value *= t
    return value
