from __future__ import annotations

from contextlib import suppress
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.errors import InvalidRobotError
from cuspaudit.family.conditions import parse_condition
from cuspaudit.family.expressions import Value, parse_expression
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.place import Place

HERE = Place("family.yaml", "a")
NAMES: dict[str, Value] = {
    "a2": Fraction(1, 3),
    "d2": Fraction(2),
    "tilt": Angle(Fraction(1, 6)),
}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a2 + d2/2", Fraction(4, 3)),
        ("-(a2 - 1) * 3", Fraction(2)),
        ("1.5e-1 + .05", Fraction(1, 5)),
        ("2 - 3 - 4", Fraction(-5)),
        ("8/4/2", Fraction(1)),
        ("- - a2", Fraction(1, 3)),
        ("pi/2 - tilt", Angle(Fraction(1, 3))),
        ("2*tilt + 30 deg", Angle(Fraction(1, 2))),
        ("3/2 deg", Angle(Fraction(1, 120))),
        ("a2 rad", Angle(radians=Fraction(1, 3))),
        ("tilt*0", Angle()),
    ],
)
def test_an_expression_has_its_exact_value(text: str, value: Value) -> None:
    """Arithmetic is exact, leans left, and knows angles from numbers."""
    assert parse_expression(text, HERE).value(NAMES) == value


@pytest.mark.parametrize(
    "text",
    [
        *("", "(", "a2 +", "a2 a2", "2a2", "a2**2", "a2^2", "__import__('os')"),
        *("a.b", "1 if 1 else 2", "a2; d2", "(((", ")", "1e99999", "9" * 401),
        *("tilt*tilt", "1/tilt", "tilt + 1", "a2/0", "(" * 60 + "1" + ")" * 60),
        *("9e300*9e300*9e300*9e300*9e300", "١", "0x10", "pi()", "lambda: 1"),
    ],
)
def test_anything_else_is_one_line(text: str) -> None:
    """What is no expression, or has no value, is refused with its cell."""
    with pytest.raises(InvalidRobotError) as refused:
        parse_expression(text, HERE).value(NAMES)
    assert str(refused.value).startswith("family.yaml: a: ")
    assert "\n" not in str(refused.value)


@given(st.text(alphabet="a2+-*/() .e1pi", max_size=40))
def test_hostile_texts_never_do_anything_else(text: str) -> None:
    """Any text is a value or an error of ours."""
    with suppress(InvalidRobotError, KeyError):
        parse_expression(text, HERE).value(dict.fromkeys(("a2", "a", "e"), Fraction(1)))


@given(st.integers(-9, 9), st.integers(-9, 9), st.integers(1, 9))
def test_it_agrees_with_fractions(a: int, b: int, c: int) -> None:
    """The tree computes what Fraction computes."""
    value = parse_expression("(x + y)*x - y/z", HERE).value(
        {"x": Fraction(a), "y": Fraction(b), "z": Fraction(c)}
    )
    assert value == Fraction(a + b) * a - Fraction(b, c)


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("a2 < d2", True),
        ("a2 == 1/3", True),
        ("0 < a2 < d2 <= 2", True),
        ("0 < a2 < 1/4", False),
        ("a2 != 1/3", False),
        ("tilt < 0.5236 rad", True),
        ("tilt > 30 deg", False),
        ("tilt > 0", True),
    ],
)
def test_a_constraint_is_decided_exactly(text: str, holds: bool) -> None:
    """Comparisons chain, and angles in degrees and rad are compared without floats."""
    assert parse_condition(text, HERE).holds(NAMES) is holds


@pytest.mark.parametrize("text", ["a2", "a2 = 1", "a2 <", "tilt < 1", "a2 =< 1"])
def test_what_is_no_comparison_is_refused(text: str) -> None:
    """A constraint compares; an angle is not compared with a number."""
    with pytest.raises(InvalidRobotError):
        parse_condition(text, HERE).holds(NAMES)
