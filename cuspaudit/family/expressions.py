"""Arithmetic in the numbers of a family file: names, + - * / and parentheses.

An expression is parsed into a tree by the grammar below; nothing is ever evaluated by
Python. Its values are exact: a rational, or an angle ``half_turns*pi + radians``.

::

    sum      product, then any number of (+ or -) product
    product  factor, then any number of (* or /) factor, then an optional deg or rad
    factor   any number of + or -, then a number, pi, a name or a sum in parentheses
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from cuspaudit.algebra.tokens import Tokens
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.numbers import parse_decimal
from cuspaudit.robot.place import Place, quoted

__all__ = ["NAME", "WORDS", "Expression", "Value", "parse_expression"]

Value = Fraction | Angle
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,39}")
WORDS = frozenset({"pi", "deg", "rad"})

_LONGEST = 400
_DEEPEST = 40
_MOST_BITS = 4000
_TOKEN = re.compile(
    r"\s*(?:((?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?![A-Za-z0-9_.]))"
    rf"|({NAME.pattern}(?![A-Za-z0-9_]))|([-+*/()]))"
)
_HOW = "write numbers, names, + - * / and parentheses"

_Node = Value | str | tuple[str, "_Node", "_Node"]


@dataclass(frozen=True)
class Expression:
    """A parsed expression.

    Attributes:
        text: what it was parsed from.
        names: the names in it.
        place: where it stands.
    """

    text: str
    names: frozenset[str]
    place: Place
    _tree: _Node

    def value(self, values: Mapping[str, Value]) -> Value:
        """Its value where every name has the value given.

        Args:
            values: a value for each of ``names``, at least.

        Raises:
            InvalidRobotError: a division by zero, two angles multiplied, an angle
                added to a number, or a result of thousands of digits.
        """
        return self._value(self._tree, values)

    def _value(self, node: _Node, values: Mapping[str, Value]) -> Value:
        if isinstance(node, str):
            return values[node]
        if not isinstance(node, tuple):
            return node
        sign, left, right = node
        result = self._combined(
            sign, self._value(left, values), self._value(right, values)
        )
        parts = (result,) if isinstance(result, Fraction) else _parts(result)
        for part in parts:
            if part.numerator.bit_length() + part.denominator.bit_length() > _MOST_BITS:
                raise self._error("grows to thousands of digits", "write less of it")
        return result

    def _combined(self, sign: str, a: Value, b: Value) -> Value:
        if sign in ("+", "-"):
            if isinstance(a, Fraction) and isinstance(b, Fraction):
                return a + b if sign == "+" else a - b
            left, right = self._angle(a), self._angle(b)
            return left + (right if sign == "+" else -right)
        if isinstance(b, Angle):
            if sign == "/" or isinstance(a, Angle):
                raise self._error(
                    "multiplies two angles or divides by one",
                    "an angle is multiplied and divided by plain numbers only",
                )
            return _scaled(b, a)
        if sign == "/":
            if b == 0:
                raise self._error("divides by zero", "exclude this by a constraint")
            b = 1 / b
        return _scaled(a, b) if isinstance(a, Angle) else a * b

    def _angle(self, value: Value) -> Angle:
        if isinstance(value, Angle):
            return value
        if value == 0:
            return Angle()
        raise self._error(
            "adds a plain number to an angle", "write deg or rad after it"
        )

    def _error(self, found: str, expected: str) -> Exception:
        return self.place.error(f"{quoted(self.text)} {found}", expected)


def parse_expression(text: str, place: Place) -> Expression:
    """The expression ``text``.

    >>> half = parse_expression("(a2 + 1)/2", Place("a doctest"))
    >>> half.value({"a2": Fraction(1, 5)})
    Fraction(3, 5)
    >>> parse_expression("pi - 90 deg", Place("a doctest")).value({})
    Angle(half_turns=Fraction(1, 2), radians=Fraction(0, 1))

    Raises:
        InvalidRobotError: it is not one, or is too long or too deep.
    """
    if len(text) > _LONGEST:
        found = f"an expression of {len(text)} characters"
        raise place.error(found, f"write at most {_LONGEST}")
    reader = _Reader(text, place)
    tree = reader.sum(0)
    reader.end()
    return Expression(text.strip(), frozenset(reader.names), place, tree)


class _Reader:
    """Recursive descent over the tokens of one text."""

    def __init__(self, text: str, place: Place) -> None:
        self.names: set[str] = set()
        self._text, self._place = text.strip(), place
        self._tokens = Tokens(text, _TOKEN, self._unreadable)

    def sum(self, depth: int) -> _Node:
        """The longest sum from here on."""
        if depth > _DEEPEST:
            raise self._place.error("parentheses too deep", "write less of them")
        result = self._product(depth)
        while self._tokens.peek() in ("+", "-"):
            result = (self._tokens.take(), result, self._product(depth))
        return result

    def end(self) -> None:
        """Check that nothing is left."""
        if self._tokens.peek():
            raise self._unreadable(self._tokens.peek())

    def _product(self, depth: int) -> _Node:
        result = self._factor(depth)
        while self._tokens.peek() in ("*", "/"):
            result = (self._tokens.take(), result, self._factor(depth))
        if self._tokens.peek() in ("deg", "rad"):
            degrees = self._tokens.take() == "deg"
            unit = Angle(Fraction(1, 180)) if degrees else Angle(radians=Fraction(1))
            result = ("*", result, unit)
        return result

    def _factor(self, depth: int) -> _Node:
        negative = False
        while self._tokens.peek() in ("+", "-"):
            negative ^= self._tokens.take() == "-"
        node = self._atom(depth)
        return ("*", Fraction(-1), node) if negative else node

    def _atom(self, depth: int) -> _Node:
        token = self._tokens.take()
        if token == "(":
            node = self.sum(depth + 1)
            if self._tokens.take() != ")":
                raise self._place.error(f"{quoted(self._text)} lacks a )", _HOW)
            return node
        if token == "pi":
            return Angle(Fraction(1))
        if NAME.fullmatch(token) and token not in WORDS:
            self.names.add(token)
            return token
        if token and (token[0].isdigit() or token[0] == "."):
            return parse_decimal(token, self._place)
        raise self._unreadable(token)

    def _unreadable(self, token: str) -> Exception:
        at = f"cannot be read at {quoted(token)}" if token else "ends too early"
        return self._place.error(f"{quoted(self._text)} {at}", _HOW)


def _parts(angle: Angle) -> tuple[Fraction, Fraction]:
    return angle.half_turns, angle.radians


def _scaled(angle: Angle, factor: Fraction) -> Angle:
    return Angle(angle.half_turns * factor, angle.radians * factor)
