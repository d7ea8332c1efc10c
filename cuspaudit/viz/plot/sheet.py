"""A drawing before it has a format: what it says, its layers, and how it is drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

__all__ = ["Note", "Sheet"]

Note = Callable[[Any, str, str], None]
"""Called with a mark, its layer, and what it says when pointed at ("": nothing)."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """One or more planes on one sheet.

    Attributes:
        title: the robot and its verdict.
        notes: what the reader must know, one sentence each.
        about: what is drawn, for who cannot see it.
        layers: the name of each layer, and what its box says.
        draw: draws on a matplotlib figure, and reports every mark.
        size: width and height, inches.
        cells: what the page's script needs to read the cells under the pointer.
    """

    title: str
    notes: Sequence[str]
    about: str
    layers: Mapping[str, str]
    draw: Callable[[Any, Note], None]
    size: tuple[float, float]
    cells: Mapping[str, Any] = field(default_factory=dict)
