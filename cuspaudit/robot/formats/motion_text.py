"""Fixed motions as exact text, the same in a robot file and in `cuspaudit import`.

::

    motion     move X Y Z          three lengths
               turn ANGLE about X Y Z
    direction  X Y Z               three numbers, not all 0; need not be a unit vector
"""

from __future__ import annotations

from collections.abc import Sequence

from cuspaudit.robot.chain import Motion, Rotation, Translation, Vector
from cuspaudit.robot.numbers import (
    AngleUnit,
    format_angle,
    format_rational,
    parse_angle,
    parse_length,
)
from cuspaudit.robot.place import Place, quoted

__all__ = ["format_motion", "format_vector", "parse_direction", "parse_motions"]

_EXPECTED = 'write a list such as [move 0 0 0.1, "turn pi/2 about 1 0 0"]'
_MOST_MOTIONS = 1000


def format_vector(vector: Vector) -> str:
    """The three numbers of ``vector``."""
    return " ".join(format_rational(entry) for entry in vector)


def format_motion(motion: Motion) -> str:
    """The text of ``motion``, which reads back as the same motion.

    >>> from fractions import Fraction
    >>> format_motion(Translation((Fraction(0), Fraction(1, 10), Fraction(1, 3))))
    'move 0 0.1 1/3'
    """
    if isinstance(motion, Translation):
        return f"move {format_vector(motion.vector)}"
    return f"turn {format_angle(motion.angle)} about {format_vector(motion.axis)}"


def parse_motions(
    texts: object, source: str, place: Place, unit: AngleUnit | None = None
) -> tuple[Motion, ...]:
    """The motions of a list of texts, read left to right.

    Args:
        texts: what stands in the file.
        source: what the numbers are called when they are snapped.
        place: where they stand.
        unit: the unit of bare angles, or None.

    Raises:
        InvalidRobotError: it is no list, or an entry is no motion.
    """
    if not isinstance(texts, Sequence) or isinstance(texts, str):
        raise place.error("no list of motions", _EXPECTED)
    if len(texts) > _MOST_MOTIONS:
        found = f"{len(texts)} motions"
        raise place.error(found, f"write at most {_MOST_MOTIONS}")
    return tuple(
        _motion(text, f"{source}[{k}]", place.at(f"{k + 1}"), unit)
        for k, text in enumerate(texts)
    )


def parse_direction(text: str, place: Place) -> Vector:
    """The direction of three numbers.

    Raises:
        InvalidRobotError: there are not three, or all are 0.
    """
    vector = _vector(text, place)
    if not any(vector):
        raise place.error("the zero vector", "write a direction")
    return vector


def _motion(text: object, source: str, place: Place, unit: AngleUnit | None) -> Motion:
    if not isinstance(text, str):
        raise place.error("a list or mapping", _EXPECTED)
    word, _, rest = text.strip().partition(" ")
    if word == "move":
        return Translation(_vector(rest, place), f"{source} xyz")
    angle, about, axis = rest.partition(" about ")
    if word == "turn" and about:
        direction = parse_direction(axis, place)
        return Rotation(direction, parse_angle(angle, place, unit), source)
    raise place.error(f"{quoted(text)} is no motion", _EXPECTED)


def _vector(text: str, place: Place) -> Vector:
    words = text.split()
    if len(words) != 3:
        found = f"{len(words)} numbers in {quoted(text)}"
        raise place.error(found, "write three numbers separated by blanks")
    x, y, z = (parse_length(word, place) for word in words)
    return x, y, z
