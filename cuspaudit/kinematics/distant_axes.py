"""How any two axes of an exact model stand to each other in every posture.

Axes are counted from 1; the axis of a slide is its direction. Each test is an identity
of polynomials in the joints between, on the circles of their angles.
"""

from __future__ import annotations

from collections.abc import Sequence

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import on_circles
from cuspaudit.kinematics.transform import (
    Column,
    Transform,
    cross,
    dot,
    identity,
    zero,
)

__all__ = ["always_coincide", "always_orthogonal", "always_parallel", "dependent"]


def always_parallel(model: ExactModel, i: int, j: int) -> bool:
    """Whether axes ``i`` and ``j`` are parallel in every posture."""
    return _vanish(model, cross(model.ring, _axis(model, i), _seen(model, i, j)[0]))


def always_orthogonal(model: ExactModel, i: int, j: int) -> bool:
    """Whether axes ``i`` and ``j`` are at right angles in every posture."""
    return _vanish(model, [dot(model.ring, _axis(model, i), _seen(model, i, j)[0])])


def always_coincide(model: ExactModel, i: int, j: int) -> bool:
    """Whether axes ``i`` and ``j`` are one line in every posture."""
    step = _seen(model, i, j)[1]
    off = _vanish(model, cross(model.ring, _axis(model, i), step))
    return off and always_parallel(model, i, j)


def dependent(model: ExactModel, i: int, j: int, k: int) -> bool:
    """Whether the directions of three axes lie in one plane in every posture."""
    ring = model.ring
    b, c = (_seen(model, i, other)[0] for other in (j, k))
    return _vanish(model, [dot(ring, _axis(model, i), cross(ring, b, c))])


def _axis(model: ExactModel, number: int) -> Column:
    return model.joints[number - 1].axis


def _seen(model: ExactModel, i: int, j: int) -> tuple[Column, Column]:
    """Direction of axis j and a point of it, in the frame of joint i.

    That frame moves with the joint where j comes after it, and not where before; its
    own motion changes no relation to its axis.
    """
    ring, first, last = model.ring, min(i, j), max(i, j)
    frame = Transform(ring, identity(ring), zero(ring))
    for number in range(first + 1, last + 1):
        joint = model.joints[number - 1]
        frame = frame @ joint.before
        if number < last:
            frame = frame @ model.motion(joint)
    if j < i:
        frame = frame.inverse()
    return frame.turn(_axis(model, j)), frame.translation


def _vanish(model: ExactModel, entries: Sequence[Polynomial]) -> bool:
    """Whether polynomials are 0 wherever the joints may stand."""
    reduced = (on_circles(model, entry) for entry in entries)
    return all(entry == 0 for entry in reduced)
