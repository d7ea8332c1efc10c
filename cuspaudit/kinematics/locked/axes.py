"""How axes of a locked arm stand to each other at every value of the lock.

Axes are those of the arm that is left, counted from 1. A *relation* is an identity: it
holds at every value of the lock, exactly. What has to differ from 0 may do so at some
values only; it is returned as a *condition*, entries of which one at least is not 0.
"""

from __future__ import annotations

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.kinematics.locked.locked_arm import LockedArm
from cuspaudit.kinematics.neighbors import direction
from cuspaudit.kinematics.transform import Column, cross, dot

__all__ = [
    "Condition",
    "apart",
    "center",
    "concurrent",
    "coplanar",
    "not_parallel",
    "parallel",
    "square",
]

Condition = tuple[Polynomial, ...]


def parallel(held: LockedArm, number: int) -> bool:
    """Whether axes ``number`` and the next are parallel."""
    return held.vanishes(*not_parallel(held, number))


def not_parallel(held: LockedArm, number: int) -> Condition:
    """The condition that axes ``number`` and the next are not parallel."""
    return cross(held.arm.ring, *_pair(held, number))


def square(held: LockedArm, number: int) -> bool:
    """Whether axes ``number`` and the next are at right angles."""
    return held.vanishes(dot(held.arm.ring, *_pair(held, number)))


def coplanar(held: LockedArm, number: int) -> bool:
    """Whether axes ``number`` and the next meet or are parallel."""
    ring, step = held.arm.ring, _step(held, number)
    return held.vanishes(dot(ring, step, cross(ring, *_pair(held, number))))


def apart(held: LockedArm, number: int) -> Condition:
    """The condition that parallel axes ``number`` and the next are not one line."""
    axis = held.arm.joints[number - 1].axis
    return cross(held.arm.ring, _step(held, number), axis)


def concurrent(held: LockedArm, first: int) -> bool:
    """Whether three axes from ``first`` meet in one point where none are parallel.

    That neighbours are not parallel is left to be asked (`not_parallel`).
    """
    if not (coplanar(held, first) and coplanar(held, first + 1)):
        return False
    back = held.arm.joints[first].before.inverse()
    axis = held.arm.joints[first].axis
    here = back.turn(held.arm.joints[first - 1].axis), back.translation
    there = direction(held.arm, first + 1), _step(held, first + 1)
    above, below = _crossing(held, axis, *here)
    top, bottom = _crossing(held, axis, *there)
    return held.vanishes(above * bottom - top * below)


def center(held: LockedArm, first: int) -> tuple[Polynomial, Polynomial]:
    """Where axis ``first`` meets the next, as (above, below).

    The point lies above / below along the unit vector of axis ``first`` from the origin
    of that joint's frame; below is not 0 where the two axes are not parallel.
    """
    axis = held.arm.joints[first - 1].axis
    return _crossing(held, axis, direction(held.arm, first), _step(held, first))


def _crossing(
    held: LockedArm, axis: Column, other: Column, point: Column
) -> tuple[Polynomial, Polynomial]:
    """The line through 0 along ``axis`` meets another one at above / below."""
    # x axis = point + mu other, and the product with other cancels mu
    ring = held.arm.ring
    normal = cross(ring, axis, other)
    return dot(ring, cross(ring, point, other), normal), dot(ring, normal, normal)


def _pair(held: LockedArm, number: int) -> tuple[Column, Column]:
    return held.arm.joints[number - 1].axis, direction(held.arm, number)


def _step(held: LockedArm, number: int) -> Column:
    return held.arm.joints[number].before.translation
