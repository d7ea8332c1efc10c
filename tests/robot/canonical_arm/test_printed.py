from __future__ import annotations

from fractions import Fraction

import pytest

from cuspaudit.robot.canonical_arm.printed import printed_errors
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Rotation,
    Translation,
)
from cuspaudit.robot.numbers import printed_decimals
from cuspaudit.robot.printed_angles import printed_multiple


def printed_chain(xyz: tuple[str, str, str], yaw: str) -> Chain:
    """Two joints, the second one placed by printed numbers."""
    x, y, z = map(Fraction, xyz)
    step = (
        Translation((x, y, z), "b xyz", tuple(map(printed_decimals, xyz))),
        Rotation(X_AXIS, Angle(radians=Fraction(yaw)), "b", (printed_decimals(yaw),)),
    )
    return Chain("arm", (Joint("a", "revolute"), Joint("b", "revolute", step, Y_AXIS)))


@pytest.mark.parametrize(
    ("xyz", "yaw", "errors"),
    [
        (("0.12346", "0", "12.345"), "0.43211", ("5e-6", "0", "5e-4")),
        (("0.123456", "0.000000", "12.345678"), "0.432112", ("5e-7", "5e-7", "5e-7")),
        (("0.12346", "0", "0.5"), "1.5708", ("0", "0", "0")),
        (("0.1", "0", "0.25"), "0.4", ("0", "0", "0")),
    ],
    ids=["significant digits", "decimals", "no generic turn", "typed"],
)
def test_the_format_of_a_file_is_that_of_its_longest_numbers(
    xyz: tuple[str, str, str], yaw: str, errors: tuple[str, ...]
) -> None:
    """Half a last digit of the format, for files whose frames are a program's."""
    chain = printed_chain(xyz, yaw)
    move = chain.joints[1].before[0]
    assert isinstance(move, Translation)
    found = printed_errors(chain).of_lengths(move)
    assert found == tuple(map(Fraction, errors))


def test_nothing_is_rounded_where_that_is_not_asked() -> None:
    """For the numbers as written every error is 0."""
    chain = printed_chain(("0.12346", "0", "12.345"), "0.43211")
    move, turn = chain.joints[1].before
    printed = printed_errors(chain, is_rounded=False)
    assert isinstance(move, Translation) and isinstance(turn, Rotation)
    assert not any(printed.of_lengths(move)) and not printed.of_angle(turn)


def test_doubles_carry_their_own_rounding() -> None:
    """A number of 17 digits may be off by 1e-15, though its last digit says less."""
    text = "0.12345678901234567"
    chain = printed_chain((text, "0", "0"), "0.43211234567890123")
    move = chain.joints[1].before[0]
    assert isinstance(move, Translation)
    assert printed_errors(chain).of_lengths(move)[0] == Fraction(1, 10**15)


def test_the_base_says_nothing_of_the_arm() -> None:
    """A generic turn before the first joint makes no number of the arm uncertain."""
    turn = Rotation(X_AXIS, Angle(radians=Fraction("0.43211")), "a", (5,))
    joints = (
        Joint("a", "revolute", (turn,), Z_AXIS),
        Joint(
            "b",
            "revolute",
            (Translation((Fraction("0.12346"),) * 3, "b xyz", (5,) * 3),),
        ),
    )
    assert not printed_errors(Chain("arm", joints)).is_generic


@pytest.mark.parametrize(
    ("text", "multiple"),
    [
        ("1.5708", Fraction(1, 2)),
        ("-3.14", Fraction(-1)),
        ("1.570796326589793", Fraction(1, 2)),
        ("0.785398", Fraction(1, 4)),
        ("1.0472", Fraction(1, 3)),
        ("0.5236", Fraction(1, 6)),
        ("0.523603", None),
        ("1.5707", Fraction(1, 2)),
        ("1.5709", None),
        ("0.6", None),
        ("1.57079632", Fraction(1, 2)),
        ("1.57079700000001", None),
    ],
)
def test_an_angle_is_read_to_its_own_last_digit(
    text: str, multiple: Fraction | None
) -> None:
    """A multiple of pi counts where the print rounds or cuts it, and nowhere else."""
    assert printed_multiple(Fraction(text)) == multiple
