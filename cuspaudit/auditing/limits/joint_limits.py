"""The limits of a chain's joints: for searching, for certificates, for the exact model.

A joint without limits is a circle or a line. Equal limits are an exporter's placeholder
and count as none; reversed ones were refused when the robot was read.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from cuspaudit.algebra.ring import rational
from cuspaudit.certificate import Limits
from cuspaudit.kinematics.exact_model import ExactJoint, ExactModel
from cuspaudit.robot.chain import Angle, Chain, Joint
from cuspaudit.robot.frames import angle_value
from cuspaudit.surface.box_edges import Limit, Range

if TYPE_CHECKING:
    from cuspaudit.auditing.search.cusps import Interval

__all__ = [
    "has_limits",
    "interval_of",
    "limit_of",
    "outer_limits",
    "ranges_of",
    "rational_limits",
    "width_of",
]

_PI = Fraction(314159265358979323846264338327950288419, 10**38)
"""Pi, rounded down."""
_PI_ERROR = Fraction(1, 10**38)
_DIGITS = 10**30


def has_limits(chain: Chain) -> bool:
    """Whether some joint has limits."""
    return any(_pair(joint) for joint in chain.joints)


def interval_of(joint: Joint) -> Interval:
    """The limits of a joint in floating point."""
    pair = _pair(joint)
    if pair is None:
        return None
    low, high = (angle_value(limit) for limit in pair)
    return low, high


def rational_limits(chain: Chain) -> Limits:
    """Limits as rational numbers, not outside the chain's, and at most 1e-30 inside.

    A claim within them is one within the chain's, which are larger.
    """
    return tuple(
        None if pair is None else (_above(pair[0]), -_above(-pair[1]))
        for pair in map(_pair, chain.joints)
    )


def outer_limits(chain: Chain) -> Limits:
    """Limits as rational numbers, not inside the chain's, and at most 1e-30 outside."""
    return tuple(
        None if pair is None else (-_above(-pair[0]), _above(pair[1]))
        for pair in map(_pair, chain.joints)
    )


def ranges_of(model: ExactModel) -> list[Range | None]:
    """The ranges of the variables of an exact model, exactly.

    The variable of a joint is its value plus its zero.
    """
    return [
        _range(joint, own)
        for joint, own in zip(model.joints, model.chain.joints, strict=True)
    ]


def width_of(wanted: Range) -> Limit:
    """The length of a range."""
    low, high = wanted.lower, wanted.upper
    return Limit(
        high.half_turns - low.half_turns,
        high.offset - low.offset,
        high.radius + low.radius,
    )


def _range(joint: ExactJoint, own: Joint) -> Range | None:
    pair = _pair(own)
    if pair is None:
        return None
    lower, upper = (limit_of(limit + joint.zero) for limit in pair)
    return Range(lower, upper)


def limit_of(value: Angle) -> Limit:
    """A value of a variable as one of its limits would be, exactly."""
    return Limit(rational(value.half_turns), rational(value.radians))


def _pair(joint: Joint) -> tuple[Angle, Angle] | None:
    """Both limits as angles (a slide's as their plain part); None for none."""
    if joint.limits is None:
        return None
    low, high = (
        limit if isinstance(limit, Angle) else Angle(radians=limit)
        for limit in joint.limits
    )
    return None if low == high else (low, high)


def _above(value: Angle) -> Fraction:
    """The least decimal of 30 digits that is not below an angle."""
    if value.half_turns == 0:
        return value.radians
    pi = _PI + (_PI_ERROR if value.half_turns > 0 else 0)
    exact = value.half_turns * pi + value.radians
    return Fraction(-((-exact * _DIGITS) // 1), _DIGITS)
