"""The numbers of a robot file, read exactly from their text.

A number is parsed by the grammar below and never evaluated, so a file can neither run
code nor ask for a billion digits. A decimal is that decimal: 0.0892 is 892/10000.

::

    decimal  [+-] digits with an optional point, and an optional exponent
    length   decimal  or  decimal/decimal
    angle    0, a term, or two terms joined by a spaced + or -
    term     a multiple of pi (pi, -pi/2, 3*pi/4, 3pi/4, 0.5*pi, pi*3/4),
             length deg, length rad, or a bare length where the file states a unit

`format_rational` and `format_angle` write texts that read back as the same number.
"""

from __future__ import annotations

import re
import unicodedata
from fractions import Fraction
from typing import Literal

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.place import Place, quoted

__all__ = [
    "AngleUnit",
    "decimal_places",
    "format_angle",
    "format_rational",
    "is_bare_angle",
    "parse_angle",
    "parse_decimal",
    "parse_length",
    "printed_decimals",
]

AngleUnit = Literal["deg", "rad"]

_MOST_CHARACTERS = 400
_MOST_EXPONENT = 400
_LONGEST_PLAIN = 24
_SOMEWHERE = Place("number")

_DECIMAL = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_PLAIN = re.compile(rf"[+-]?{_DECIMAL}")
_QUOTIENT = re.compile(rf"([+-]?{_DECIMAL})\s*/\s*({_DECIMAL})")
_FACTOR = rf"(?:{_DECIMAL}(?:\s*/\s*{_DECIMAL})?)"
_PI = re.compile(
    rf"([+-]?)\s*(?:({_FACTOR})\s*\*?\s*)?pi(?:\s*\*\s*({_DECIMAL}))?"
    rf"(?:\s*/\s*({_DECIMAL}))?(?:\s*rad)?"
)
_UNIT = re.compile(r"(.*?)\s*(deg|rad)", re.DOTALL)
_TWO_TERMS = re.compile(r"(.*\S)\s+([+-])\s+(\S.*)", re.DOTALL)
_HINTS = {
    "\N{MINUS SIGN}": "write an ordinary minus, -",
    "\N{EN DASH}": "write an ordinary minus, -",
    "\N{GREEK SMALL LETTER PI}": "write pi",
    "\N{DEGREE SIGN}": "write deg",
    "_": "write the digits together",
    ",": "write a decimal point",
}


def parse_decimal(text: str, place: Place = _SOMEWHERE) -> Fraction:
    """The integer or decimal ``text``, exactly.

    >>> parse_decimal("-1.5e-1")
    Fraction(-3, 20)

    Raises:
        InvalidRobotError: it is not one, or it is too long to be a measured number.
    """
    stripped = text.strip()
    _check_size(stripped, place)
    if not _PLAIN.fullmatch(stripped):
        raise _unreadable(stripped, "a decimal number such as 0.425 or 1e-3", place)
    _, _, exponent = stripped.lower().partition("e")
    if len(exponent) > 6 or abs(int(exponent or "0")) > _MOST_EXPONENT:
        raise place.error(
            f"the exponent of {quoted(stripped)} is out of range",
            f"write a number between 1e-{_MOST_EXPONENT} and 1e{_MOST_EXPONENT}",
        )
    return Fraction(stripped)


def parse_length(text: str, place: Place = _SOMEWHERE) -> Fraction:
    """The length ``text``: a decimal or a quotient of two decimals.

    >>> parse_length("3/2"), parse_length("0.0892")
    (Fraction(3, 2), Fraction(223, 2500))

    Raises:
        InvalidRobotError: it is not one, or divides by zero.
    """
    stripped = text.strip()
    _check_size(stripped, place, parts=2)
    match = _QUOTIENT.fullmatch(stripped)
    if match:
        return _quotient(match[1], match[2], place)
    if len(stripped) <= _MOST_CHARACTERS and not _PLAIN.fullmatch(stripped):
        raise _unreadable(stripped, "a length such as 0.425 or 3/2", place)
    return parse_decimal(stripped, place)


def parse_angle(
    text: str, place: Place = _SOMEWHERE, unit: AngleUnit | None = None
) -> Angle:
    """The angle ``text``.

    Args:
        text: one term, or two joined by a spaced plus or minus sign.
        place: where it stands, for the message.
        unit: what a bare number means; None where the file states no unit.

    >>> parse_angle("3*pi/4")
    Angle(half_turns=Fraction(3, 4), radians=Fraction(0, 1))
    >>> parse_angle("55 deg") == parse_angle("55", unit="deg") == parse_angle("11pi/36")
    True

    Raises:
        InvalidRobotError: it is not one, or it is a bare number of unstated unit.
    """
    stripped = text.strip()
    _check_size(stripped, place, parts=5)
    match = _TWO_TERMS.fullmatch(stripped)
    if not match:
        return _term(stripped, place, unit)
    second = _term(match[3], place, unit)
    first = _term(match[1], place, unit)
    return first + (second if match[2] == "+" else -second)


def is_bare_angle(text: str) -> bool:
    """Whether a number other than 0 stands in the angle ``text`` without a unit.

    >>> [is_bare_angle(text) for text in ("90", "pi/2 + 0.1", "90 deg", "pi/2", "0.0")]
    [True, True, False, False, False]
    """
    if len(text) > 5 * _MOST_CHARACTERS:
        return False
    match = _TWO_TERMS.fullmatch(text.strip())
    terms = (match[1], match[3]) if match else (text,)
    return any(_is_bare(term.strip()) for term in terms)


def format_rational(value: Fraction) -> str:
    """``value`` as the shortest exact text: a decimal when it is one, else p/q.

    >>> [format_rational(Fraction(n, 8)) for n in (-4, 1, 8)]
    ['-0.5', '0.125', '1']
    >>> format_rational(Fraction(1, 3)), format_rational(Fraction(1, 10**30))
    ('1/3', '1e-30')
    """
    places = decimal_places(value.denominator)
    if places is None:
        return f"{value.numerator}/{value.denominator}"
    digits = value.numerator * 10**places // value.denominator
    sign, figures = ("-" if digits < 0 else ""), str(abs(digits))
    if places == 0 and len(figures) > _LONGEST_PLAIN:
        trimmed = figures.rstrip("0")
        zeros = len(figures) - len(trimmed)
        return f"{sign}{trimmed}e{zeros}" if zeros > 3 else f"{sign}{figures}"
    if places > _LONGEST_PLAIN:
        return f"{sign}{figures}e-{places}"
    figures = figures.rjust(places + 1, "0")
    whole, fraction = figures[: len(figures) - places], figures[len(figures) - places :]
    return f"{sign}{whole}.{fraction}" if fraction else f"{sign}{whole}"


def format_angle(angle: Angle) -> str:
    """``angle`` as exact text.

    >>> format_angle(Angle(Fraction(-3, 4))), format_angle(Angle(Fraction(1, 2)))
    ('-3*pi/4', 'pi/2')
    >>> format_angle(Angle(Fraction(1), Fraction(-1, 10)))
    'pi - 0.1 rad'
    """
    if angle.is_zero:
        return "0"
    if angle.radians == 0:
        return _multiple_of_pi(angle.half_turns)
    if angle.half_turns == 0:
        return f"{format_rational(angle.radians)} rad"
    sign = "+" if angle.radians > 0 else "-"
    rest = format_rational(abs(angle.radians))
    return f"{_multiple_of_pi(angle.half_turns)} {sign} {rest} rad"


def decimal_places(denominator: int) -> int | None:
    """The least k such that ``denominator`` divides 10**k, or None."""
    twos = (denominator & -denominator).bit_length() - 1
    rest, fives = denominator >> twos, 0
    while rest % 5 == 0:
        rest, fives = rest // 5, fives + 1
    return max(twos, fives) if rest == 1 else None


def printed_decimals(text: str) -> int:
    """With how many decimals the number ``text`` is written, zeros included.

    >>> printed_decimals("0.500"), printed_decimals("1.25e-3"), printed_decimals("2")
    (3, 5, 0)
    """
    mantissa, _, exponent = text.strip().lower().partition("e")
    return len(mantissa.partition(".")[2]) - int(exponent or "0")


def _term(text: str, place: Place, unit: AngleUnit | None) -> Angle:
    match = _PI.fullmatch(text)
    if match:
        return Angle(half_turns=_half_turns(match, place))
    match = _UNIT.fullmatch(text)
    if match:
        return _angle(parse_length(match[1], place), match[2])
    if not _PLAIN.fullmatch(text) and not _QUOTIENT.fullmatch(text):
        expected = "an angle such as pi/2, 55 deg or 0.9599 rad"
        raise _unreadable(text, expected, place)
    value = parse_length(text, place)
    if value != 0 and unit is None:
        raise place.error(
            f"the angle {quoted(text)} has no unit",
            f'write "{text} deg" or "{text} rad", or state the unit of the file',
        )
    return _angle(value, unit or "rad")


def _is_bare(term: str) -> bool:
    number = re.split("[eE/]", term)[0]
    plain = _PLAIN.fullmatch(term) or _QUOTIENT.fullmatch(term)
    return plain is not None and any(digit in number for digit in "123456789")


def _angle(value: Fraction, unit: str) -> Angle:
    return Angle(value / 180) if unit == "deg" else Angle(radians=value)


def _half_turns(match: re.Match[str], place: Place) -> Fraction:
    """The factor of pi: sign, a factor before, a factor after, a divisor."""
    sign, before, after, divisor = match.groups()
    factor = parse_length(before, place) if before else Fraction(1)
    factor *= parse_decimal(after, place) if after else 1
    if divisor:
        factor *= _quotient("1", divisor, place)
    return -factor if sign == "-" else factor


def _quotient(numerator: str, denominator: str, place: Place) -> Fraction:
    below = parse_decimal(denominator, place)
    if below == 0:
        raise place.error(
            f"{quoted(f'{numerator}/{denominator}')} divides by zero",
            "write a denominator other than 0",
        )
    return parse_decimal(numerator, place) / below


def _multiple_of_pi(factor: Fraction) -> str:
    sign, above = ("-" if factor < 0 else ""), abs(factor.numerator)
    text = "pi" if above == 1 else f"{above}*pi"
    below = "" if factor.denominator == 1 else f"/{factor.denominator}"
    return f"{sign}{text}{below}"


def _check_size(text: str, place: Place, parts: int = 1) -> None:
    if len(text) > parts * (_MOST_CHARACTERS + 2):
        raise place.error(
            f"a number of {len(text)} characters",
            f"write at most {_MOST_CHARACTERS} characters",
        )


def _unreadable(text: str, expected: str, place: Place) -> InvalidRobotError:
    """The error for ``text``, naming the character that cannot stand there."""
    for character in text:
        if character in _HINTS or not character.isascii():
            name = unicodedata.name(character, "no name")
            hint = _HINTS.get(character, "write plain ASCII characters")
            point = f"U+{ord(character):04X} {name}"
            return place.error(f"{quoted(text)} contains {point}", hint)
    if text.lower().lstrip("+-") in {"nan", "inf", "infinity"}:
        return place.error(f"{quoted(text)} is not finite", f"write {expected}")
    if not text:
        return place.error("no number", f"write {expected}")
    return place.error(f"{quoted(text)} is not a number", f"write {expected}")
