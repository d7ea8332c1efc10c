"""The parameters of a family, as axes whose values are found one by one.

A grid is the product of its axes in the order of the file, the last running fastest.
All ``random`` parameters together are one axis, the last: its k-th point takes the k-th
draw of each. A draw is a hash of seed, name and k, so it needs no list and no memory.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from cuspaudit.family.expressions import Value, parse_expression
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.entries import check_known, word
from cuspaudit.robot.place import Place

__all__ = ["MOST_STEPS", "Parameter", "parse_parameter", "parse_whole"]

MOST_STEPS = 10**6
_DRAWS = 10**4


@dataclass(frozen=True)
class Parameter:
    """One parameter: a name and its values, exact.

    Attributes:
        name: as it stands in the numbers of the robot.
        size: how many values it has.
        values: the values of a list; empty for a range.
        bounds: the ends of a range, both taken; None for a list.
        seed: of a random range, None for a grid. A draw is one of 10001 equally
            spaced points of the range, so that its text is a short decimal.
    """

    name: str
    size: int
    values: tuple[Value, ...] = ()
    bounds: tuple[Value, Value] | None = None
    seed: int | None = None

    def value(self, number: int) -> Value:
        """Value ``number``, counted from 0."""
        if self.bounds is None:
            return self.values[number]
        if self.seed is None:
            return _between(*self.bounds, Fraction(number, max(self.size - 1, 1)))
        text = f"{self.seed}/{self.name}/{number}"
        draw = int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big")
        return _between(*self.bounds, Fraction(draw % (_DRAWS + 1), _DRAWS))

    def refined(self, times: int) -> Parameter:
        """The same range in ``times`` times as many steps, both ends kept."""
        return Parameter(
            self.name, (self.size - 1) * times + 1, self.values, self.bounds
        )


def parse_parameter(name: str, entry: object, seed: int, place: Place) -> Parameter:
    """The parameter ``name``: values, a range with steps, or random with a count.

    Raises:
        InvalidRobotError: it is none of these.
    """
    how = (
        "write {range: [0.2, 3], steps: 15}, {values: [1/2, 1]} or "
        "{random: [0.1, 2], count: 100}"
    )
    if not isinstance(entry, Mapping):
        raise place.error("no mapping", how)
    check_known(entry, ("range", "steps", "values", "random", "count"), place)
    if set(entry) == {"values"}:
        values = _values(entry["values"], place.at("values"))
        return Parameter(name, len(values), values)
    if set(entry) == {"range", "steps"}:
        size = parse_whole(entry, "steps", place, least=1)
        return Parameter(name, size, bounds=_bounds(entry["range"], place.at("range")))
    if set(entry) == {"random", "count"}:
        size = parse_whole(entry, "count", place, least=1)
        bounds = _bounds(entry["random"], place.at("random"))
        return Parameter(name, size, bounds=bounds, seed=seed)
    raise place.error(f"the keys {', '.join(sorted(entry)) or 'none'}", how)


def parse_whole(
    entries: Mapping[str, object], key: str, place: Place, least: int = 0
) -> int:
    """The whole number under ``key``.

    Raises:
        InvalidRobotError: it is missing, no whole number, too small or too large.
    """
    text = word(entries, key, place) or ""
    if not (text.isascii() and text.isdigit() and len(text) < 19):
        raise place.at(key).error("no whole number", f"write {least} or more")
    if not least <= int(text) <= (MOST_STEPS if least else 10**18):
        raise place.at(key).error(
            f"{text} is out of range", f"write {least} to {MOST_STEPS}"
        )
    return int(text)


def _values(entry: object, place: Place) -> tuple[Value, ...]:
    if not isinstance(entry, Sequence) or isinstance(entry, str) or not entry:
        raise place.error("no list of numbers", "write [1/2, 1]")
    texts = [text if isinstance(text, str) else "" for text in entry]
    values = tuple(parse_expression(text, place).value({}) for text in texts)
    if len({type(v) for v in values if v != 0}) > 1:
        raise place.error("angles and plain numbers in one list", "write one kind")
    if len(set(values)) < len(values):
        raise place.error("a value stands twice", "write it once")
    return values


def _bounds(entry: object, place: Place) -> tuple[Value, Value]:
    values = _values(entry, place)
    if len(values) != 2:
        raise place.error(f"{len(values)} ends", "write [lowest, highest]")
    lower, upper = values
    if isinstance(lower, Angle) or isinstance(upper, Angle):
        return _as_angle(lower), _as_angle(upper)
    return lower, upper


def _as_angle(value: Value) -> Angle:
    return value if isinstance(value, Angle) else Angle()


def _between(lower: Value, upper: Value, part: Fraction) -> Value:
    """``lower + part * (upper - lower)``, exactly."""
    if isinstance(lower, Angle) and isinstance(upper, Angle):
        return Angle(
            lower.half_turns + part * (upper.half_turns - lower.half_turns),
            lower.radians + part * (upper.radians - lower.radians),
        )
    assert isinstance(lower, Fraction) and isinstance(upper, Fraction)
    return lower + part * (upper - lower)
