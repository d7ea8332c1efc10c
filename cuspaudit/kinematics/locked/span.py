"""A span of values of a joint that turns, its ends exact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from flint import arb, fmpq

from cuspaudit.robot.chain import Angle
from cuspaudit.robot.frames import angle_value

__all__ = ["WHOLE_CIRCLE", "Span", "ball_of_angle"]


@dataclass(frozen=True, slots=True)
class Span:
    """All values from ``lower`` to ``upper``, both included.

    Attributes:
        lower: the lower end.
        upper: the upper end, above it.
    """

    lower: Angle
    upper: Angle

    @property
    def middle(self) -> Angle:
        """The value half way."""
        return _half(self.lower + self.upper)

    @property
    def degrees(self) -> float:
        """How long it is, in degrees."""
        return math.degrees(self.radians)

    @property
    def radians(self) -> float:
        """How long it is, in rad."""
        return angle_value(self.upper + -self.lower)

    def halves(self) -> tuple[Span, Span]:
        """The two halves, which share the middle."""
        return Span(self.lower, self.middle), Span(self.middle, self.upper)

    def parts(self, count: int) -> tuple[Span, ...]:
        """So many parts of equal length, in order."""
        step = _scaled(self.upper + -self.lower, Fraction(1, count))
        ends = [self.lower + _scaled(step, Fraction(k)) for k in range(count)]
        return tuple(map(Span, ends, [*ends[1:], self.upper]))

    def ball(self) -> arb:
        """A ball that contains every value of the span, at the working precision."""
        middle = ball_of_angle(self.middle)
        half = ball_of_angle(_half(self.upper + -self.lower))
        return middle + arb(0, half.abs_upper())


WHOLE_CIRCLE = Span(Angle(Fraction(-1)), Angle(Fraction(1)))
"""From -180 deg to 180 deg."""


def ball_of_angle(angle: Angle) -> arb:
    """A ball that contains the angle, in rad."""
    turns, rest = (
        arb(fmpq(part.numerator, part.denominator))
        for part in (angle.half_turns, angle.radians)
    )
    return arb.pi() * turns + rest


def _half(angle: Angle) -> Angle:
    return _scaled(angle, Fraction(1, 2))


def _scaled(angle: Angle, factor: Fraction) -> Angle:
    return Angle(angle.half_turns * factor, angle.radians * factor)
