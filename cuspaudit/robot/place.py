"""A place in a robot file, from which one-line errors are raised.

Names and numbers of a file are other people's text: in a message they are quoted,
shortened, and stripped of what a terminal would obey.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from cuspaudit.errors import InvalidRobotError

__all__ = ["Place", "listing", "quoted"]

_LONGEST = 60


@dataclass(frozen=True, slots=True)
class Place:
    """Where a text stands: a file, and a joint, row, element or line inside it."""

    file: str
    where: str = ""

    def at(self, where: str) -> Place:
        """The place ``where``, further inside this one."""
        return replace(self, where=f"{self.where} {where}".strip())

    def error(self, found: str, expected: str) -> InvalidRobotError:
        """The error that says what stands here and what would be accepted."""
        return InvalidRobotError(
            file=self.file, where=self.where, found=found, expected=expected
        )


def quoted(text: str) -> str:
    r"""``text`` in double quotes, on one line, shortened, nothing unprintable.

    >>> quoted("tool0")
    '"tool0"'
    >>> print(quoted("j\n2"))
    "j\n2"
    """
    shown = text[:_LONGEST]
    if not shown.isprintable():
        shown = shown.encode("unicode_escape").decode("ascii")
    return f'"{shown}{"..." if len(text) > _LONGEST else ""}"'


def listing(names: list[str], most: int = 8) -> str:
    """The first ``most`` of ``names``, quoted, and how many there are in all."""
    shown = ", ".join(quoted(name) for name in names[:most])
    return shown if len(names) <= most else f"{shown}, ... ({len(names)} in all)"
