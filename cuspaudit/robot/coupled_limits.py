"""The limits of coupled joints, carried to the chain without the driven ones.

A driven joint has the value m d + o, d that of its driver. Its own limits are limits of
d: (l - o) / m and (u - o) / m, the smaller first. So the driver has the part that both
its ranges share, and a joint whose driver is off the chain has the part of its own
range that the driver's range gives it.

With u = q + s (m d + o) in the place of a neighbour q, the pairs (d, u) of a box of
(d, q) fill a box where q has no limits, and a slanted one where it has. A slanted one
is no product of ranges: then all limits are left out, which is said.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from cuspaudit.robot.chain import Angle, Joint
from cuspaudit.robot.place import listing

__all__ = ["Limits", "carried", "carried_limits", "shared"]

Limits = tuple[Angle, Angle] | tuple[Fraction, Fraction] | None

_PI = Fraction(314159265358979323846264338327950288419, 10**38)


def carried(limits: Limits, multiplier: Fraction, offset: Fraction) -> Limits:
    """The range of multiplier * x + offset for x in a range; multiplier is not 0."""
    if limits is None:
        return None
    low, high = (_moved(limit, multiplier, offset) for limit in limits)
    return _ordered(low, high)


def shared(first: Limits, second: Limits) -> Limits:
    """The range that two ranges share.

    Raises:
        ValueError: they share none.
    """
    if first is None or second is None:
        return second if first is None else first
    low, high = (
        max(first[0], second[0], key=_value),
        min(first[1], second[1], key=_value),
    )
    if _value(low) >= _value(high):
        raise ValueError
    return _ordered(low, high)


def carried_limits(
    joints: Sequence[Joint],
    driven: Mapping[str, tuple[str, Fraction, Fraction]],
    partners: Mapping[str, str],
) -> tuple[dict[str, Limits], str]:
    """The limits of the joints that are left, by name, and a note on them.

    Args:
        joints: of the chain, driven ones included.
        driven: name to driver, multiplier (not 0) and offset.
        partners: driven joint to the neighbour whose value becomes a sum.
    """
    known = {joint.name: joint for joint in joints}
    ranges: dict[str, Limits] = {joint.name: joint.limits for joint in joints}
    nothing: dict[str, Limits] = dict.fromkeys(ranges)
    for name, (driver, multiplier, offset) in driven.items():
        if driver in driven or known[name].kind != known[driver].kind:
            return nothing, f"limits are left out: {name} follows {driver} otherwise"
        own = carried(known[name].limits, 1 / multiplier, -offset / multiplier)
        try:
            ranges[driver] = shared(ranges[driver], own)
        except ValueError:
            return nothing, f"limits are left out: those of {name} and {driver} exclude"
    slanted = sorted({p for p in partners.values() if ranges[p] is not None})
    if slanted:
        return nothing, (
            f"limits are left out: those of {listing(slanted)} hold for a sum of values"
        )
    return ranges, "limits of driven joints are taken for their drivers"


def _moved(
    limit: Angle | Fraction, multiplier: Fraction, offset: Fraction
) -> Angle | Fraction:
    if isinstance(limit, Angle):
        radians = limit.radians * multiplier + offset
        return Angle(limit.half_turns * multiplier, radians)
    return limit * multiplier + offset


def _value(limit: Angle | Fraction) -> Fraction:
    """The limit with pi to 38 digits."""
    if isinstance(limit, Angle):
        return limit.half_turns * _PI + limit.radians
    return limit


def _ordered(a: Angle | Fraction, b: Angle | Fraction) -> Limits:
    low, high = (a, b) if _value(a) <= _value(b) else (b, a)
    if isinstance(low, Angle) and isinstance(high, Angle):
        return low, high
    assert isinstance(low, Fraction) and isinstance(high, Fraction)
    return low, high
