"""Polynomials are read exactly, and nothing else is read."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.algebra.polynomial_text import parse_polynomial
from cuspaudit.algebra.ring import Ring
from cuspaudit.errors import InvalidSystemError

RING = Ring(["x", "y", "c2"])


@pytest.mark.parametrize(
    ("text", "expanded"),
    [
        ("-x^2", "-x^2"),
        ("(-x)**2", "x^2"),
        ("2*(x + y)^2/4 - x*y", "1/2*x^2 + 1/2*y^2"),
        ("x - y - x", "-y"),
        ("1.5e-3*x", "3/2000*x"),
        ("x/2/3", "1/6*x"),
        ("x +\n  --y", "x + y"),
        ("c2*0", "0"),
    ],
)
def test_precedence_and_exact_decimals(text: str, expanded: str) -> None:
    """The usual precedence holds, and a decimal is that decimal."""
    assert str(parse_polynomial(RING, text)) == expanded


@pytest.mark.parametrize(
    "text",
    [
        "",
        "(",
        "x)",
        "2x",
        "x y",
        "z",
        "1/0",
        "1/x",
        "x^-1",
        "x^y",
        "x^2.0",
        "x**2**2",
        "exp(x)",
        "__import__('os').system('true')",
        "x\N{MINUS SIGN}y",
        "x" * 30_000,
        "(" * 500 + "x" + ")" * 500,
        "x^999999999999",
        "(x + y + c2)^900",
        "((x + y)^99)^10",
        "(9^900)^900",
        "1e99999*x",
    ],
)
def test_all_else_is_refused_in_one_line(text: str) -> None:
    """What is no polynomial, or a huge one, is one line naming file and entry."""
    with pytest.raises(InvalidSystemError) as caught:
        parse_polynomial(RING, text, "system.yaml", "map[1]")
    message = str(caught.value)
    assert message.startswith("system.yaml: map[1]: ")
    assert "\n" not in message
    assert len(message) < 400


COEFFICIENTS = st.integers(-99, 99)
EXPONENTS = st.tuples(*[st.integers(0, 5)] * 3)


@given(st.dictionaries(EXPONENTS, COEFFICIENTS, max_size=6))
def test_a_printed_polynomial_reads_back(terms: dict[tuple[int, ...], int]) -> None:
    """What FLINT prints is read as the same polynomial."""
    polynomial = RING.context.from_dict(terms)
    assert parse_polynomial(RING, str(polynomial)) == polynomial
