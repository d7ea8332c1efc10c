"""Exact numbers as text: what stands in a certificate is read as it is, or refused.

Every number of a certificate is a string: an integer, a decimal or a fraction p/q.
It is matched against one pattern and turned into a rational; it is never evaluated,
never rounded, and never longer than `LONGEST` characters, so a file cannot make
its reader work for long. There is no exponent and no infinity.
"""

from __future__ import annotations

import re
from fractions import Fraction

__all__ = ["LONGEST", "fraction_from_text", "text_from_fraction"]

LONGEST = 400
"""The largest number of characters that a number may have."""

_NUMBER = re.compile(r"-?[0-9]+(?:\.[0-9]+|/[0-9]+)?", re.ASCII)


def fraction_from_text(text: str) -> Fraction:
    """Return the rational number that ``text`` denotes.

    Args:
        text: an integer, a decimal or p/q, at most `LONGEST` characters.

    Returns:
        That number, exactly.

    Raises:
        ValueError: the text is anything else; the message says what is expected.

    >>> fraction_from_text("-0.125"), fraction_from_text("3/2")
    (Fraction(-1, 8), Fraction(3, 2))
    """
    if len(text) > LONGEST:
        raise ValueError(f"write a number in at most {LONGEST} characters")
    if not _NUMBER.fullmatch(text):
        raise ValueError("write an integer, a decimal or a fraction p/q")
    try:
        return Fraction(text)
    except ZeroDivisionError:
        raise ValueError("write a fraction whose denominator is not 0") from None


def text_from_fraction(number: Fraction) -> str:
    """Return the text of ``number``: a decimal where a finite one is short enough.

    Args:
        number: any rational.

    Returns:
        A text that `fraction_from_text` turns into the same number.

    Raises:
        ValueError: no text of at most `LONGEST` characters denotes the number.

    >>> text_from_fraction(Fraction(-1, 8)), text_from_fraction(Fraction(1, 3))
    ('-0.125', '1/3')
    """
    for text in (_decimal(number), str(number)):
        if text is not None and len(text) <= LONGEST:
            return text
    raise ValueError(f"round it first, to at most {LONGEST} characters")


def _decimal(number: Fraction) -> str | None:
    """The finite decimal of ``number``; None if it has none, or a far too long one."""
    rest, twos, fives = number.denominator, 0, 0
    if rest.bit_length() > 4 * LONGEST:
        return None
    while rest % 2 == 0:
        rest, twos = rest // 2, twos + 1
    while rest % 5 == 0:
        rest, fives = rest // 5, fives + 1
    if rest != 1:
        return None
    places = max(twos, fives)
    if not places:
        return _integer(number.numerator)
    digits = _integer(abs(number.numerator) * 10**places // number.denominator)
    if digits is None:
        return None
    digits = digits.rjust(places + 1, "0")
    sign = "-" if number < 0 else ""
    return f"{sign}{digits[:-places]}.{digits[-places:]}"


def _integer(number: int) -> str | None:
    """The digits of an integer, None where they cannot be few enough."""
    return None if number.bit_length() > 4 * LONGEST else str(number)
