"""How neighbouring axes of an exact model stand to each other, tested exactly.

Axes are counted from 1. What is tested holds in every posture.
"""

from __future__ import annotations

from collections.abc import Callable

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.transform import Column, cross, dot

__all__ = [
    "coincide",
    "concurrent",
    "coplanar",
    "crossing",
    "direction",
    "orthogonal",
    "parallel",
]


def direction(model: ExactModel, number: int) -> Column:
    """The axis after joint ``number``, in the frame of that joint."""
    following = model.joints[number]
    return following.before.turn(following.axis)


def orthogonal(model: ExactModel, number: int) -> bool:
    """Whether axes ``number`` and ``number`` + 1 are at right angles."""
    return _pair(model, number, lambda a, b: dot(model.ring, a, b))


def parallel(model: ExactModel, number: int) -> bool:
    """Whether axes ``number`` and ``number`` + 1 are parallel."""
    return _pair(model, number, lambda a, b: cross(model.ring, a, b))


def coplanar(model: ExactModel, number: int) -> bool:
    """Whether axes ``number`` and ``number`` + 1 meet or are parallel."""
    ring, step = model.ring, model.joints[number].before.translation
    return _pair(model, number, lambda a, b: dot(ring, step, cross(ring, a, b)))


def coincide(model: ExactModel, number: int) -> bool:
    """Whether two parallel axes are one line."""
    ring, step = model.ring, model.joints[number].before.translation
    return _pair(model, number, lambda a, b: cross(ring, step, a))


def concurrent(model: ExactModel, number: int) -> bool:
    """Whether three axes from ``number`` meet in one point, neighbours not parallel."""
    neighbours = (number, number + 1)
    if any(parallel(model, k) or not coplanar(model, k) for k in neighbours):
        return False
    back = model.joints[number].before.inverse()
    here = back.turn(model.joints[number - 1].axis), back.translation
    there = direction(model, number + 1), model.joints[number + 1].before.translation
    axis = model.joints[number].axis
    return crossing(model, axis, *here) == crossing(model, axis, *there)


def crossing(
    model: ExactModel, axis: Column, other: Column, point: Column
) -> Polynomial:
    """How far from 0 the line through 0 along ``axis`` meets another line.

    Args:
        model: whose ring all is in.
        axis: a unit vector.
        other: the direction of the other line, in one plane with it, not parallel.
        point: a point of the other line.
    """
    # x axis = point + mu other, and the product with other cancels mu
    ring, normal = model.ring, cross(model.ring, axis, other)
    above = dot(ring, cross(ring, point, other), normal)
    below = dot(ring, normal, normal)
    if ring.radicand is None:
        return above / below.leading_coefficient()
    top = ring.reduce(above * ring.conjugate(below))
    return top / ring.norm(below).leading_coefficient()


def _pair(
    model: ExactModel,
    number: int,
    test: Callable[[Column, Column], Polynomial | Column],
) -> bool:
    value = test(model.joints[number - 1].axis, direction(model, number))
    entries = value if isinstance(value, tuple) else (value,)
    return all(model.ring.reduce(entry) == 0 for entry in entries)
