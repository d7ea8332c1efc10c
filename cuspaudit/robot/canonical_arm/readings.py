"""One number out of a ball: a structural value where it holds one, else the simplest.

The structural values are 0 for a length, and the multiples of 30 and 45 degrees for an
angle. A ball that reaches one, by its own radius and the floor of the policy, is read
as that. Any other number is the shortest decimal of its ball; the floor serves
relations only and moves no other number. A ball wider than the caps of `axis_pair`
counts as that wide.

A number that was typed has a ball of the computation alone, about 1e-90. It is read
as the simple fraction in it; where there is none (a length such as 0.035 sqrt 2) the
decimal that is read is another number, and `Reading.is_near` says so.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from flint import arb, fmpq

from cuspaudit.algebra.rationals import exact_rational
from cuspaudit.robot.canonical_arm.axis_pair import (
    CAP_ANGLE,
    CAP_LENGTH,
    Floor,
    simple_fraction,
)
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.numbers import decimal_places, format_angle, format_rational
from cuspaudit.robot.printed_angles import PI, is_printed

__all__ = ["ReadNumber", "Reader"]

_FINEST = 24
_PRINTED_NOISE = 1e-8
_ZERO = 1e-12
_RELATIVE = 1e-6


@dataclass(frozen=True, slots=True)
class ReadNumber:
    """A number, read.

    Attributes:
        value: the number, or the angle.
        text: it as exact text.
        given: the middle of the ball.
        error: the radius of the ball.
        difference: the number less the middle.
        is_special: whether it is a structural value.
        is_near: whether it is another number than the one the chain has.
    """

    value: Fraction | Angle
    text: str
    given: float
    error: float
    difference: float
    is_special: bool
    is_near: bool

    @property
    def moved(self) -> float:
        """By how much it was moved beyond its error."""
        return abs(self.difference) if abs(self.difference) > self.error else 0.0


@dataclass(frozen=True, slots=True)
class Reader:
    """Reads the numbers of one chain.

    Attributes:
        floor: what counts as structural beyond a ball.
        slack: what a decimal may be off beyond its ball, in m and rad.
        reads_pi: whether 1.571 among angles is pi/2.
        is_rounded: whether the numbers carry errors of their own. Those that do not
            are other numbers where they are read as decimals; none is read as 0 then.
    """

    floor: Floor
    slack: float
    reads_pi: bool
    is_rounded: bool

    def length(self, ball: arb, extra: float = 0.0) -> ReadNumber:
        """A length, in the unit of the chain; ``extra`` is what moved it."""
        if self.floor.is_zero_length(ball, extra):
            return self._reading(Fraction(0), ball, True)
        return self.offset(ball)

    def offset(self, ball: arb) -> ReadNumber:
        """A length that has no structural value: the zero of a slide."""
        reach = min(float(ball.rad()), CAP_LENGTH * self.floor.unit)
        value = _decimal(ball, reach + self._slack(ball) * self.floor.unit)
        return self._reading(value, ball, value == 0)

    def angle(self, ball: arb) -> ReadNumber:
        """An angle between two axes, or between two common normals."""
        reach = min(float(ball.rad()), CAP_ANGLE)
        for parts in (6, 4):
            multiple = Fraction(round(parts * float(ball.mid()) / float(PI)), parts)
            off = ball.mid() - _half_turns(multiple)
            if abs(float(off)) <= reach + self.floor.angle:
                return self._turn(Angle(multiple), ball, True)
        if self.reads_pi and float(ball.rad()) <= _PRINTED_NOISE:
            printed = _printed(ball)
            if printed is not None:
                return self._turn(Angle(printed), ball, True)
        reach = min(float(ball.rad()), CAP_ANGLE)
        return self._plain(ball, reach + self._slack(ball))

    def _slack(self, ball: arb) -> float:
        if self.is_rounded:
            return self.slack
        return min(self.slack, _RELATIVE * abs(float(ball.mid())))

    def zero(self, ball: arb) -> Angle:
        """The zero of a joint, which is no invariant: the middle of the ball."""
        angle = self._plain(ball, _ZERO).value
        assert isinstance(angle, Angle)
        return angle

    def _plain(self, ball: arb, reach: float) -> ReadNumber:
        pi = arb.pi()
        degrees = _decimal(ball * 180 / pi, reach * 180 / float(PI))
        radians = _decimal(ball, reach)
        if len(format_rational(degrees)) <= len(format_rational(radians)):
            angle = Angle(degrees / 180)
        else:
            angle = Angle(radians=radians)
        return self._turn(angle, ball, angle.is_zero)

    def _turn(self, angle: Angle, ball: arb, is_special: bool) -> ReadNumber:
        used = _half_turns(angle.half_turns) + _ball(angle.radians)
        return self._compared(angle, format_angle(angle), used, ball, is_special)

    def _reading(self, value: Fraction, ball: arb, is_special: bool) -> ReadNumber:
        text = format_rational(value)
        return self._compared(value, text, _ball(value), ball, is_special)

    def _compared(
        self,
        value: Fraction | Angle,
        text: str,
        used: arb,
        ball: arb,
        is_special: bool,
    ) -> ReadNumber:
        difference = float(used - ball.mid())
        is_other = not ball.overlaps(used)
        return ReadNumber(
            value,
            text,
            float(ball.mid()),
            float(ball.rad()),
            difference,
            is_special,
            is_other and not is_special and not self.is_rounded,
        )


def _decimal(ball: arb, reach: float) -> Fraction:
    """The simple fraction that a typed number is, else the shortest decimal."""
    simple = simple_fraction(ball)
    if simple is not None:
        return simple
    middle = exact_rational(ball)
    exact = Fraction(int(middle.p), int(middle.q))
    for places in range(_FINEST):
        value = Fraction(round(exact * 10**places), 10**places)
        if abs(value - exact) <= reach:
            return value
    return Fraction(round(exact * 10**_FINEST), 10**_FINEST)


def _printed(ball: arb) -> Fraction | None:
    """The multiple of pi/2 that a composed twist prints: 1.571 and some noise."""
    value = _decimal(ball, max(float(ball.rad()), 1e-9))
    right = Fraction(round(2 * value / PI), 2)
    places = decimal_places(value.denominator)
    if right == 0 or places is None or places > 8:
        return None
    return right if is_printed(value, right * PI) else None


def _half_turns(multiple: Fraction) -> arb:
    return _ball(multiple) * arb.pi()


def _ball(value: Fraction) -> arb:
    return arb(fmpq(value.numerator, value.denominator))
