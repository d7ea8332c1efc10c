"""The cells of a D-H table as people write them: markup away, variables apart.

A cell is parsed and never evaluated. Markup (LaTeX, Markdown) and the letters of a
formula become the plain text that `robot.numbers` reads; a joint's own symbol in its
column, ``th_2 - pi/2`` or ``90 - q3``, is told from its constant offset and its sign.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

__all__ = ["Variable", "plain_cell", "variable_in"]

_LONGEST = 2500
_LETTERS = str.maketrans(
    {
        **{"π": "pi", "θ": "theta", "ϑ": "theta", "°": " deg", "º": " deg"},
        **dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True)),
    }
)
_MARKUP = (
    (re.compile(r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}"), r"\1/\2"),
    (re.compile(r"\^\s*(?:\{\s*\\circ\s*\}|\\circ)|\\degree"), " deg"),
    (re.compile(r"\\(?:cdot|times)"), "*"),
    (re.compile(r"\\(pi|theta)"), r"\1"),
    (re.compile(r"\\_"), "_"),
    (re.compile(r"\\[,;:! ]|[${}`]"), ""),
)
_VARIABLE = r"(?P<name>%s)(?:_?[(\[]?(?P<index>[0-9]{0,3})[)\]]?)(?:\(t\))?\*?"
_SYMBOLS = {
    "theta": r"theta|th|t|q|var|variable|\*",
    "d": r"d|q|var|variable|\*",
}


@dataclass(frozen=True, slots=True)
class Variable:
    """A joint's own symbol in a cell.

    Attributes:
        index: the number in the symbol, None without one.
        sign: 1, or -1 when the symbol is negated.
        rest: what stands beside it, "0" when nothing does.
    """

    index: int | None
    sign: int
    rest: str


def plain_cell(text: str) -> str:
    r"""``text`` without markup, its letters as words.

    >>> plain_cell(r"$-\frac{\pi}{2}$"), plain_cell("90°"), plain_cell(r"\theta_{2}")
    ('-pi/2', '90 deg', 'theta_2')
    """
    if len(text) > _LONGEST:
        return text
    text = text.translate(_LETTERS)
    for pattern, plain in _MARKUP:
        text = pattern.sub(plain, text)
    return text.strip()


def variable_in(text: str, column: str) -> Variable | None:
    """The joint's own symbol in a plain cell, None when it holds none.

    Args:
        text: as `plain_cell` returns it.
        column: "theta" or "d".

    >>> variable_in("th_2 - pi/2", "theta")
    Variable(index=2, sign=1, rest='-pi/2')
    >>> variable_in("90 deg - q3", "theta")
    Variable(index=3, sign=-1, rest='90 deg')
    """
    if len(text) > _LONGEST:
        return None
    symbol = _VARIABLE % _SYMBOLS[column]
    first = re.fullmatch(
        rf"(?P<sign>[+-]?)\s*{symbol}\s*(?:(?P<op>[+-])\s*(?P<rest>\S.*))?", text
    )
    if first:
        rest = (first["op"] or "").replace("+", "") + (first["rest"] or "0")
        return _variable(first, first["sign"], rest)
    last = re.fullmatch(rf"(?P<rest>.*\S)\s*(?P<sign>[+-])\s*{symbol}", text)
    return _variable(last, last["sign"], last["rest"]) if last else None


def _variable(found: re.Match[str], sign: str, rest: str) -> Variable:
    index = int(found["index"]) if found["index"] else None
    return Variable(index, -1 if sign == "-" else 1, rest)
