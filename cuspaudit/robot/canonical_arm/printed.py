"""How far the printed numbers of a file may be from those that were meant.

A CAD program places every link frame somewhere, computes each number in floating point
and prints it with the digits of its own format. What it prints is then an interval,
half a unit of the last digit to either side. A number that a person typed is that
number.

Which of the two a file holds is seen by all of its numbers together: an arm has been
through floating point when some turn or some axis is generic (no multiple of 15
degrees, no axis of a frame), and its format is that of its longest numbers, since
trailing zeros are often cut. Lengths, angles and the components of axes are printed
each in a format of its own.

With S the most significant digits and D the most decimals among the numbers of a kind,
a number x with 10^e <= |x| < 10^(e + 1) may be off by max(10^-D, 10^(e + 1 - S)) / 2:
where the format has a fixed number of decimals the first is the larger, where it has a
fixed number of digits the second. Files of fifteen digits carry the rounding of doubles
besides.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import floor, log10

from cuspaudit.robot.chain import Chain, Motion, Rotation, Translation
from cuspaudit.robot.printed_angles import PI, printed_multiple

__all__ = ["Printed", "printed_errors"]

_FEWEST_DIGITS = 5
_OF_DOUBLES = 15
_DOUBLE = Fraction(1, 10**15)
_NEAR = Fraction(1, 10**5)
_HALF = Fraction(1, 2)


@dataclass(frozen=True, slots=True)
class _Format:
    """The digits of a kind of numbers: significant ones and decimals, at most."""

    digits: int
    decimals: int

    def error(self, value: Fraction, decimals: int) -> Fraction:
        """How far ``value``, printed with so many decimals, may be off."""
        if self.digits < _FEWEST_DIGITS:
            return Fraction(0)
        if value == 0:
            return _HALF * _unit(decimals) if decimals >= 5 else Fraction(0)
        last = max(_unit(self.decimals), _unit(self.digits - 1 - _decade(value)))
        if self.digits < _OF_DOUBLES:
            return _HALF * last
        return max(_HALF * last, _DOUBLE * max(Fraction(1), abs(value)))


@dataclass(frozen=True, slots=True)
class Printed:
    """The errors of the printed numbers of one chain.

    Attributes:
        is_generic: whether the numbers have been through floating point; if not, every
            error is 0.
        digits: the most significant digits that one of them has.
    """

    is_generic: bool
    digits: int
    _lengths: _Format
    _angles: _Format
    _axes: _Format

    def of_lengths(self, motion: Translation) -> tuple[Fraction, ...]:
        """The errors of the three components."""
        return self._errors(self._lengths, motion.vector, motion.decimals)

    def of_angle(self, motion: Rotation) -> Fraction:
        """The error of the angle."""
        [error] = self._errors(self._angles, (motion.angle.radians,), motion.decimals)
        return error

    def of_axis(
        self, vector: tuple[Fraction, ...], decimals: tuple[int, ...]
    ) -> tuple[Fraction, ...]:
        """The errors of the three components of a joint axis."""
        return self._errors(self._axes, vector, decimals)

    def _errors(
        self, kind: _Format, values: tuple[Fraction, ...], decimals: tuple[int, ...]
    ) -> tuple[Fraction, ...]:
        if not self.is_generic or not decimals:
            return (Fraction(0),) * len(values)
        return tuple(map(kind.error, values, decimals))


def printed_errors(chain: Chain, is_rounded: bool = True) -> Printed:
    """The errors of the numbers of ``chain``, by its own printed text.

    Args:
        chain: any chain.
        is_rounded: whether a number may be off at all; if not, every error is 0.

    The transform before the first axis belongs to the base and says nothing of the arm,
    and neither does that after the last axis if the task is a pose.
    """
    inner = [m for joint in chain.joints[1:] for m in joint.before]
    if chain.task != "pose":
        inner += chain.tool
    every = [m for joint in chain.joints for m in joint.before] + [*chain.tool]
    axes = [joint.printed_axis for joint in chain.joints if joint.printed_axis]
    lengths = _format(
        pair
        for m in every
        if isinstance(m, Translation)
        for pair in zip(m.vector, m.decimals, strict=False)
    )
    angles = _format(
        pair
        for m in every
        if isinstance(m, Rotation)
        for pair in zip((m.angle.radians,), m.decimals, strict=False)
    )
    directions = _format(pair for axis in axes for pair in zip(*axis, strict=True))
    generic = is_rounded and (
        any(_is_generic_turn(m) for m in inner)
        or any(_is_generic_axis(vector) for vector, _ in axes)
    )
    return Printed(
        generic,
        max(lengths.digits, angles.digits, directions.digits),
        lengths,
        angles,
        directions,
    )


def _format(numbers: Iterable[tuple[Fraction, int]]) -> _Format:
    seen = [(v, decimals) for v, decimals in numbers if v]
    digits = max((_decade(v) + 1 + decimals for v, decimals in seen), default=0)
    return _Format(digits, max((decimals for _, decimals in seen), default=0))


def _is_generic_turn(motion: Motion) -> bool:
    """Whether it is a printed turn by no multiple of 15 degrees."""
    if not isinstance(motion, Rotation) or not motion.decimals:
        return False
    radians = motion.angle.radians
    if printed_multiple(radians) is not None:
        return False
    return abs(radians - round(12 * radians / PI) * PI / 12) >= _NEAR


def _is_generic_axis(vector: Iterable[Fraction]) -> bool:
    """Whether more than one component counts."""
    sizes = [abs(x) for x in vector]
    return sum(x > _NEAR * max(sizes) for x in sizes) > 1


def _decade(value: Fraction) -> int:
    """The e with 10^e <= |value| < 10^(e + 1)."""
    e = floor(log10(abs(value.numerator)) - log10(value.denominator))
    while abs(value) >= _power(e + 1):
        e += 1
    while abs(value) < _power(e):
        e -= 1
    return e


def _unit(decimals: int) -> Fraction:
    return _power(-decimals)


def _power(exponent: int) -> Fraction:
    return Fraction(10) ** exponent
