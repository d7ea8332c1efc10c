from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.errors import CuspauditError, InvalidRobotError
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.numbers import (
    format_angle,
    format_rational,
    parse_angle,
    parse_decimal,
    parse_length,
)
from cuspaudit.robot.place import Place

RATIONALS = st.fractions(max_denominator=10**40)
DECIMALS = st.builds(
    lambda digits, places: digits * Fraction(10) ** -places,
    st.integers(-(10**30), 10**30),
    st.integers(-20, 60),
)


@given(st.one_of(RATIONALS, DECIMALS))
def test_a_rational_reads_back(value: Fraction) -> None:
    """format_rational writes a text that parse_length reads as the same number."""
    assert parse_length(format_rational(value)) == value


@given(st.builds(Angle, RATIONALS, st.one_of(RATIONALS, st.just(Fraction(0)))))
def test_an_angle_reads_back(angle: Angle) -> None:
    """format_angle writes a text that parse_angle reads as the same angle."""
    assert parse_angle(format_angle(angle)) == angle


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_printed_float_is_read_as_its_decimal(value: float) -> None:
    """A decimal is read as the number its digits name, and rounds to that float."""
    text = repr(value)
    assert parse_decimal(text) == Fraction(text)
    assert float(parse_decimal(text)) == value


@given(st.text("0123456789+-.*/eEpidegra _\n−π\u202e", max_size=30))
def test_any_text_is_a_number_or_one_line_of_refusal(text: str) -> None:
    """Whatever the text, the answer is a number or one printable line."""
    for parse in (parse_decimal, parse_length, parse_angle):
        try:
            parse(text)
        except CuspauditError as error:
            assert str(error).isprintable()


@pytest.mark.parametrize(
    ("text", "half_turns"),
    [
        ("pi", "1"),
        ("-pi/2", "-1/2"),
        ("+pi", "1"),
        ("3*pi/4", "3/4"),
        ("3pi/4", "3/4"),
        ("0.5*pi", "1/2"),
        ("pi*3/4", "3/4"),
        ("3/4*pi", "3/4"),
        ("-2 * pi / 3", "-2/3"),
        ("55 deg", "11/36"),
        ("-90deg", "-1/2"),
        ("0", "0"),
        ("-0.0", "0"),
    ],
)
def test_multiples_of_pi_are_exact(text: str, half_turns: str) -> None:
    """A multiple of pi, or of a degree, is a rational number of half turns."""
    assert parse_angle(text) == Angle(Fraction(half_turns))


@given(st.sampled_from(["pi/2", "-3*pi/4", "55 deg", "0.9599 rad", "pi - 0.1 rad"]))
def test_an_angle_has_the_value_its_text_names(text: str) -> None:
    """The exact angle is, in floating point, what Python makes of the same text."""
    word = text.replace(" deg", "*pi/180").replace(" rad", "")
    expected = eval(word, {"pi": math.pi})
    assert angle_value(parse_angle(text)) == pytest.approx(expected, abs=1e-15)


def test_a_bare_angle_needs_a_unit() -> None:
    """A bare number that is not 0 is refused, unless the file states a unit."""
    with pytest.raises(InvalidRobotError, match=r"write .1.57 deg. or .1.57 rad."):
        parse_angle("1.57")
    assert parse_angle("90", unit="deg") == Angle(Fraction(1, 2))
    assert parse_angle("1.57", unit="rad") == Angle(radians=Fraction(157, 100))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("−1", "MINUS SIGN"),
        ("１", "FULLWIDTH DIGIT ONE"),
        ("1_000", "LOW LINE"),
        ("1,5", "decimal point"),
        ("nan", "not finite"),
        ("-inf", "not finite"),
        ("", "no number"),
        ("0x10", "not a number"),
        ("1/0", "divides by zero"),
        ("1e401", "out of range"),
        ("1e-999999999", "out of range"),
        ("9" * 20000, "20000 characters"),
        ("__import__('os')", "LOW LINE"),
        ("1\n2", "not a number"),
    ],
)
def test_a_refusal_names_what_stands_there(text: str, said: str) -> None:
    """What is no number is refused on one line that names the trouble and the place."""
    with pytest.raises(InvalidRobotError) as caught:
        parse_length(text, Place("arm.csv", "row 2 a"))
    assert said in str(caught.value)
    assert str(caught.value).startswith("arm.csv: row 2 a: ")
    assert str(caught.value).isprintable()


@pytest.mark.parametrize("text", ["π/2", "90°", "sin(1)", "pi/0", "pi pi", "1 + 2"])
def test_what_is_no_angle_is_refused(text: str) -> None:
    """An angle outside the grammar is refused, never evaluated."""
    with pytest.raises(InvalidRobotError):
        parse_angle(text)
