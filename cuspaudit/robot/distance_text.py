"""How far an arm is from a structure, in words."""

from __future__ import annotations

import math

__all__ = ["distance_text", "structure_words"]

_IN_DEGREES = 0.1


def distance_text(length: float, angle: float, unit: str) -> str:
    """A shift and a tilt in words, two digits each.

    Where both are 0 and the structure does not hold, they are less than rounding.

    Args:
        length: of the shift, in ``unit``.
        angle: of the tilt, in rad.
        unit: "m", which is written in mm, or another.

    >>> distance_text(0.0001, 0, "m")
    '0.10 mm'
    >>> distance_text(0, 0.0039, "mm")
    '3.9 mrad'
    """
    parts = []
    if length > 0:
        value, name = (length * 1000, "mm") if unit == "m" else (length, unit)
        parts.append(f"{_short(value)} {name}")
    if angle > _IN_DEGREES:
        parts.append(f"{_short(math.degrees(angle))} deg")
    elif angle > 0:
        parts.append(f"{_short(angle * 1000)} mrad")
    return " and ".join(parts) or "less than rounding"


def structure_words(name: str) -> str:
    """The name of a structure with its article.

    >>> structure_words("spherical wrist"), structure_words("axes 2 and 3 parallel")
    ('a spherical wrist', 'an arm with axes 2 and 3 parallel')
    """
    if name.startswith("axes"):
        return f"an arm with {name}"
    return f"{'the' if name.startswith('UR') else 'a'} {name}"


def _short(value: float) -> str:
    """Two digits; more before the point where there are more.

    >>> _short(150.2), _short(0.1), _short(2.04e-7)
    ('150', '0.10', '2.0e-07')
    """
    if value >= 10:
        return f"{value:.0f}"
    return f"{value:.1e}" if value < 1e-3 else f"{value:#.2g}"
