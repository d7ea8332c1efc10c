from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.certificate.structure.exact import (
    LONGEST,
    fraction_from_text,
    text_from_fraction,
)


@given(st.fractions())
def test_text_and_number_are_inverse(number: Fraction) -> None:
    """Every rational is read back exactly from its text."""
    assert fraction_from_text(text_from_fraction(number)) == number


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e9, max_value=1e9))
def test_ordinary_floats_are_written_exactly(number: float) -> None:
    """A float that is no hair's breadth from 0 has a text, and it is exact."""
    exact = Fraction(number)
    if number == 0 or abs(number) > 1e-60:
        assert fraction_from_text(text_from_fraction(exact)) == exact


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("0", Fraction(0)),
        ("-0", Fraction(0)),
        ("007", Fraction(7)),
        ("-0.125", Fraction(-1, 8)),
        ("-6/4", Fraction(-3, 2)),
    ],
)
def test_numbers_are_read_exactly(text: str, number: Fraction) -> None:
    """Integers, decimals and fractions are read as they are."""
    assert fraction_from_text(text) == number


@pytest.mark.parametrize(
    "text",
    [
        *("", " 1", "1 ", "1\n", "+1", "--1", ".5", "5.", "1e3", "1e999999999"),
        *("nan", "NaN", "inf", "-inf", "Infinity", "0x10", "1_000", "1/0", "1/-2"),
        *("1.5/2", "1/2/3", "pi", "2**3", "__import__('os')", "\u0661", "1,5"),
        "1" * (LONGEST + 1),
    ],
)
def test_anything_else_is_refused(text: str) -> None:
    """What is no plain number is refused, and never evaluated."""
    with pytest.raises(ValueError, match="write"):
        fraction_from_text(text)


@pytest.mark.parametrize(
    "number",
    [
        *(Fraction(1, 3**1000), Fraction(1, 2**5000)),
        *(Fraction(10**LONGEST), Fraction(2**9999), Fraction(2**9999 + 1, 2)),
    ],
)
def test_a_number_too_long_for_a_reader_is_not_written(number: Fraction) -> None:
    """What could not be read back is not written."""
    with pytest.raises(ValueError, match="round"):
        text_from_fraction(number)


def test_a_fraction_is_written_where_the_decimal_is_too_long() -> None:
    """A decimal of more than 400 places gives way to p/q."""
    number = Fraction(1, 2**500)
    assert text_from_fraction(number) == str(number)
    assert text_from_fraction(Fraction(1, 8)) == "0.125"
