"""Directions with rational components, and their unit vectors where rational."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

from cuspaudit.robot.chain import Vector

__all__ = ["rational_root", "scaled_axis", "unit_axis"]


def unit_axis(axis: Vector) -> Vector | None:
    """The unit vector of ``axis`` (not zero), or None when it is not rational.

    >>> [str(x) for x in unit_axis((Fraction(3), Fraction(0), Fraction(4)))]
    ['3/5', '0', '4/5']
    """
    length = rational_root(sum(x * x for x in scaled_axis(axis)))
    if length is None:
        return None
    x, y, z = scaled_axis(axis)
    return (x / length, y / length, z / length)


def scaled_axis(axis: Vector) -> Vector:
    """``axis`` scaled so that its largest component is 1 or -1."""
    largest = max(abs(x) for x in axis)
    x, y, z = axis
    return (x / largest, y / largest, z / largest)


def rational_root(value: Fraction | int) -> Fraction | None:
    """The square root of ``value`` >= 0, or None when it is not rational."""
    value = Fraction(value)
    above, below = isqrt(value.numerator), isqrt(value.denominator)
    if above * above != value.numerator or below * below != value.denominator:
        return None
    return Fraction(above, below)
