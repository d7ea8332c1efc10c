"""Constraints of a family: comparisons of expressions, decided exactly."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from flint import arb, ctx, fmpq

from cuspaudit.family.expressions import Expression, Value, parse_expression
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.place import Place, quoted

__all__ = ["Condition", "parse_condition"]

_SIGN = re.compile(r"(<=|>=|==|!=|<|>)")
_TRUE_FOR = {
    "<": (-1,),
    "<=": (-1, 0),
    "==": (0,),
    "!=": (-1, 1),
    ">=": (0, 1),
    ">": (1,),
}


@dataclass(frozen=True)
class Condition:
    """A chain of comparisons such as ``0 < a3 <= a2 + 3``.

    Attributes:
        text: as it stands in the file.
        sides: the expressions, left to right.
        signs: the signs between them.
    """

    text: str
    sides: tuple[Expression, ...]
    signs: tuple[str, ...]

    @property
    def names(self) -> frozenset[str]:
        """The names in it."""
        return frozenset().union(*(side.names for side in self.sides))

    def holds(self, values: Mapping[str, Value]) -> bool:
        """Whether every comparison is true.

        Raises:
            InvalidRobotError: a side has no value, or an angle meets a number.
        """
        found = [side.value(values) for side in self.sides]
        return all(
            _compared(a, b, side.place, self.text) in _TRUE_FOR[sign]
            for (a, b), sign, side in zip(
                pairwise(found), self.signs, self.sides, strict=False
            )
        )


def parse_condition(text: str, place: Place) -> Condition:
    """The condition ``text``.

    >>> parse_condition("0 < a <= 1/2", Place("")).holds({"a": Fraction(1, 2)})
    True

    Raises:
        InvalidRobotError: it is not a comparison.
    """
    parts = _SIGN.split(text)
    if len(parts) < 3:
        raise place.error(f"{quoted(text)} compares nothing", "write a3 <= a2 + 3")
    sides = tuple(parse_expression(part, place) for part in parts[::2])
    return Condition(text, sides, tuple(parts[1::2]))


def _compared(a: Value, b: Value, place: Place, text: str) -> int:
    """-1, 0 or 1 as ``a`` is below, equal to or above ``b``."""
    if isinstance(a, Fraction) and isinstance(b, Fraction):
        return (a > b) - (a < b)
    angles = [Angle() if value == 0 else value for value in (a, b)]
    left, right = angles
    if not isinstance(left, Angle) or not isinstance(right, Angle):
        found = f"{quoted(text)} compares an angle with a number"
        raise place.error(found, "write deg or rad after the number")
    return _sign(left + -right)


def _sign(angle: Angle) -> int:
    """The sign of a rational multiple of pi plus a rational, 0 only if both are 0."""
    if angle.is_zero:
        return 0
    before = ctx.prec
    try:
        for bits in (64, 256, 1024, 4096, 65536):
            ctx.prec = bits
            x = _ball(angle.half_turns) * arb.pi() + _ball(angle.radians)
            if x > 0:
                return 1
            if x < 0:
                return -1
    finally:
        ctx.prec = before
    raise AssertionError("pi is not that close to a short rational")


def _ball(value: Fraction) -> arb:
    return arb(fmpq(value.numerator, value.denominator))
