"""The tokens of a text, one after the other; each parser has its own grammar."""

from __future__ import annotations

import re
from collections.abc import Callable

__all__ = ["Tokens"]

Refuse = Callable[[str], Exception]


class Tokens:
    """A text split into tokens, read from the left."""

    def __init__(self, text: str, token: re.Pattern[str], refuse: Refuse) -> None:
        """Split ``text``.

        Args:
            text: of other people.
            token: one token, in the one group that matches, spaces before it.
            refuse: the error for the rest of a text that begins with no token.
        """
        self._tokens: list[str] = []
        self._next, start, text = 0, 0, text.strip()
        while start < len(text):
            match = token.match(text, start)
            if match is None:
                raise refuse(text[start:].strip())
            self._tokens.append(next(group for group in match.groups() if group))
            start = match.end()

    def peek(self) -> str:
        """The next token, "" at the end."""
        return self._tokens[self._next] if self._next < len(self._tokens) else ""

    def take(self) -> str:
        """The next token, which is then done with."""
        token = self.peek()
        self._next += 1
        return token
