from __future__ import annotations

from fractions import Fraction

import pytest
from flint import arb, ctx

from cuspaudit.robot.canonical_arm.axis_pair import Floor
from cuspaudit.robot.canonical_arm.links import BITS
from cuspaudit.robot.canonical_arm.readings import Reader
from cuspaudit.robot.chain import Angle

FLOOR = Floor(5e-6, 1e-5, 1.0)
CAD = Reader(FLOOR, 1e-9, True, True)
TYPED = Reader(Floor(0.0, 0.0, 1.0), 1e-13, False, False)


def ball(middle: str, error: float = 0.0) -> arb:
    """A number with its error."""
    return arb(middle, error)


@pytest.mark.parametrize(
    ("middle", "error", "value"),
    [
        ("0.0891590000003", 1e-12, "0.089159"),
        ("-0.42499984", 2e-7, "-0.425"),
        ("4e-6", 0.0, "0"),
        ("-3e-5", 4e-5, "0"),
        ("0.00035", 2e-7, "0.00035"),
        ("0.00035", 4e-4, "0.0003"),
        ("0.35", 1.0, "0.35"),
    ],
)
def test_a_length_is_zero_or_the_shortest_of_its_interval(
    middle: str, error: float, value: str
) -> None:
    """An interval that reaches 0 is 0; a genuine 0.35 mm is not, however wide it is."""
    reading = CAD.length(ball(middle, error))
    assert reading.value == Fraction(value)
    assert reading.is_special == (reading.value == 0)
    assert not reading.is_near


@pytest.mark.parametrize(
    ("middle", "error", "text"),
    [
        ("1.5707999", 1e-7, "pi/2"),
        ("0.52360", 1e-6, "pi/6"),
        ("2.3561", 2e-4, "3*pi/4"),
        ("1e-6", 0.0, "0"),
        ("1.571", 1e-12, "pi/2"),
        ("0.9599310885968813", 1e-12, "11*pi/36"),
        ("0.7000000000000001", 1e-12, "0.7 rad"),
        ("1.5808", 1e-6, "1.5808 rad"),
    ],
)
def test_an_angle_is_special_or_the_shortest_of_its_interval(
    middle: str, error: float, text: str
) -> None:
    """Multiples of 30 and 45 degrees, prints of pi/2, whole degrees, else decimals."""
    assert CAD.angle(ball(middle, error)).text == text


def test_a_typed_number_is_read_as_itself() -> None:
    """Fractions and decimals come back; an irrational length is said to be near."""
    with ctx.workprec(BITS):
        third = TYPED.length(arb(1) / 3)
        root = TYPED.length(arb(2).sqrt() * 35 / 1000)
    assert third.value == Fraction(1, 3) and not third.is_near
    assert root.is_near
    assert abs(root.difference) < 1e-12


def test_the_zero_of_a_joint_is_the_middle_of_its_ball() -> None:
    """No structure hangs on it: it is not moved by the errors of the numbers."""
    assert CAD.zero(ball("0.12345678", 1e-3)) == Angle(radians=Fraction("0.12345678"))
