"""Multiples of pi as files print them: 1.5708, 1.57, 1.570796326589793."""

from __future__ import annotations

from fractions import Fraction

from cuspaudit.robot.numbers import decimal_places

__all__ = ["PI", "is_printed", "printed_multiple"]

PI = Fraction("3.14159265358979323846264338327950288419716939937510")
"""pi to fifty digits."""

_COARSE = Fraction(1, 10**5)
_FINE = Fraction(1, 10**9)
_LONG = 12


def is_printed(value: Fraction, exact: Fraction) -> bool:
    """Whether ``value`` is ``exact``, not 0, rounded or cut at its own last decimal.

    Two decimals are the fewest; the last one is never a zero that was cut away.
    """
    places = decimal_places(value.denominator)
    if places is None or places < 2 or exact == 0:
        return False
    shift = 10**places
    cut = int(abs(exact) * shift)
    sign = 1 if exact > 0 else -1
    return sign * value * shift in (cut, round(abs(exact) * shift))


def printed_multiple(radians: Fraction) -> Fraction | None:
    """The number of half turns that a printed angle stands for, or None.

    That is a multiple of 1/2 rounded or cut at the last decimal, or one of 1/6 or 1/4
    that the angle meets to its own last digit, and to 1e-5 rad. A number of 12 decimals
    or more has to meet it to 1e-9: official files have pi/2 wrong in the tenth.

    >>> printed_multiple(Fraction("1.571")), printed_multiple(Fraction("0.52360"))
    (Fraction(1, 2), Fraction(1, 6))
    """
    right = Fraction(round(2 * radians / PI), 2)
    if is_printed(radians, right * PI):
        return right
    places = decimal_places(radians.denominator)
    if places is None or places >= _LONG:
        tolerance = _FINE
    else:
        tolerance = min(_COARSE, Fraction(6, 10 ** (places + 1)))
    for parts in (6, 4):
        multiple = Fraction(round(parts * radians / PI), parts)
        if multiple and abs(radians - multiple * PI) <= tolerance:
            return multiple
    return None
