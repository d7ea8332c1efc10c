"""Polynomials read from text: parsed by the grammar below, never evaluated.

::

    sum      product, then any number of (+ or -) product
    product  factor, then any number of (* or /) factor
    factor   any number of + or -, then an atom, then an optional (^ or **) power
    atom     a number, a variable, or a sum in parentheses
    power    a natural number

A decimal is that decimal: 0.1 is 1/10. What is divided by must be a nonzero number. A
text may be short and its expansion huge, so the size is bounded before each product.
"""

from __future__ import annotations

import re
from fractions import Fraction
from math import comb

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.tokens import Tokens
from cuspaudit.errors import InvalidSystemError

__all__ = ["VARIABLE", "parse_polynomial"]

VARIABLE = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,39}")

_LONGEST = 20_000
_DEEPEST = 60
_MOST_TERMS = 20_000
_HIGHEST = 1000
_MOST_BITS = 50_000
_SHOWN = 40
_TOKEN = re.compile(
    r"\s*(?:((?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?(?![A-Za-z0-9_.]))"
    rf"|({VARIABLE.pattern}(?![A-Za-z0-9_]))|(\*\*|[-+*/^()]))"
)
_HOW = "write numbers, variables, + - * / ^ and parentheses, with every * written out"


def parse_polynomial(
    ring: Ring, text: str, file: str = "polynomial", where: str = ""
) -> Polynomial:
    """The polynomial ``text`` in ``ring``, expanded.

    >>> ring = Ring(["x", "y"])
    >>> parse_polynomial(ring, "(x - y)^2/2 - 0.5*y**2")
    1/2*x^2 - x*y

    Args:
        ring: Q[x_1..x_n].
        text: by the grammar above.
        file: where it comes from, for messages.
        where: the place in it.

    Raises:
        InvalidSystemError: it is no polynomial in these variables, or too large.
    """
    reader = _Reader(ring, text, file, where)
    result = reader.sum(0)
    reader.end()
    return result


class _Reader:
    """Recursive descent over the tokens of one text."""

    def __init__(self, ring: Ring, text: str, file: str, where: str) -> None:
        self._ring, self._file, self._where = ring, file, where
        if len(text) > _LONGEST:
            found = f"a polynomial of {len(text)} characters"
            raise self._error(found, f"write at most {_LONGEST}")
        self._tokens = Tokens(text, _TOKEN, self._unreadable)

    def sum(self, depth: int) -> Polynomial:
        """The longest sum from here on."""
        if depth > _DEEPEST:
            raise self._error("parentheses too deep", f"nest at most {_DEEPEST}")
        result = self._product(depth)
        while (sign := self._tokens.peek()) in ("+", "-"):
            self._tokens.take()
            term = self._product(depth)
            result = result + term if sign == "+" else result - term
        return result

    def end(self) -> None:
        """Check that nothing is left."""
        if self._tokens.peek():
            raise self._unreadable(self._tokens.peek())

    def _product(self, depth: int) -> Polynomial:
        result = self._factor(depth)
        while (sign := self._tokens.peek()) in ("*", "/"):
            self._tokens.take()
            factor = self._factor(depth)
            result = self._times(result, self._inverse(factor, sign))
        return result

    def _factor(self, depth: int) -> Polynomial:
        negative = False
        while self._tokens.peek() in ("+", "-"):
            negative ^= self._tokens.take() == "-"
        result = self._atom(depth)
        if self._tokens.peek() in ("^", "**"):
            self._tokens.take()
            result = self._power(result, self._tokens.take())
        return -result if negative else result

    def _atom(self, depth: int) -> Polynomial:
        token = self._tokens.take()
        if token == "(":
            result = self.sum(depth + 1)
            if self._tokens.take() != ")":
                raise self._error("a ( without its )", _HOW)
            return result
        if VARIABLE.fullmatch(token):
            if token not in self._ring.variables:
                known = ", ".join(self._ring.variables)
                raise self._error(f"unknown variable {token}", f"use one of: {known}")
            return self._ring.gen(token)
        if token and (token[0].isdigit() or token[0] == "."):
            return self._ring.constant(Fraction(token))
        raise self._unreadable(token)

    def _power(self, base: Polynomial, token: str) -> Polynomial:
        if not token.isdigit() or len(token) > 4:
            raise self._error(
                f"the exponent {token[:_SHOWN] or 'nothing'}",
                f"write a natural number up to {_HIGHEST}",
            )
        exponent, terms = int(token), max(len(base), 1)
        self._check(comb(terms + exponent - 1, exponent), exponent * _degree(base))
        self._check_bits(exponent * _bits(base))
        return base**exponent

    def _times(self, a: Polynomial, b: Polynomial) -> Polynomial:
        self._check(len(a) * len(b), _degree(a) + _degree(b))
        self._check_bits(_bits(a) + _bits(b))
        return a * b

    def _inverse(self, factor: Polynomial, sign: str) -> Polynomial:
        if sign == "*":
            return factor
        if not factor.is_constant():
            raise self._error("a division by a polynomial", "divide by numbers only")
        if factor == 0:
            raise self._error("a division by zero", "divide by nonzero numbers only")
        return self._ring.constant(1) / factor

    def _check(self, terms: int, degree: int) -> None:
        if terms > _MOST_TERMS or degree > _HIGHEST:
            raise self._error(
                f"expands to as many as {min(terms, 10**9)} terms of degree {degree}",
                f"at most {_MOST_TERMS} terms and degree {_HIGHEST} are read",
            )

    def _check_bits(self, bits: int) -> None:
        if bits > _MOST_BITS:
            raise self._error("numbers of thousands of digits", "write shorter ones")

    def _unreadable(self, token: str) -> InvalidSystemError:
        shown = token[:_SHOWN].encode("unicode_escape").decode("ascii")
        at = f'cannot be read at "{shown}"' if token else "it ends too early"
        return self._error(at, _HOW)

    def _error(self, found: str, expected: str) -> InvalidSystemError:
        return InvalidSystemError(
            file=self._file, where=self._where, found=found, expected=expected
        )


def _degree(polynomial: Polynomial) -> int:
    return 0 if polynomial == 0 else int(polynomial.total_degree())


def _bits(polynomial: Polynomial) -> int:
    return max(
        (
            int(c.p).bit_length() + int(c.q).bit_length()
            for c in polynomial.to_dict().values()
        ),
        default=0,
    )
