"""det J of a chain and its task, as a polynomial on V = {f = 0}."""

from __future__ import annotations

from itertools import combinations

from cuspaudit.algebra.matrix import determinant
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import factor_on_circles
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import ExactJoint, ExactModel
from cuspaudit.kinematics.fact import fact
from cuspaudit.kinematics.polynomial_map import on_circles
from cuspaudit.kinematics.transform import Column, Transform, cross, dot, identity, zero
from cuspaudit.robot.task import DIMENSIONS

__all__ = ["determinant_factors", "jacobian_determinant"]


@fact
def jacobian_determinant(model: ExactModel) -> Polynomial:
    """The determinant det J of the task, a polynomial reduced modulo the circles.

    Rows are the linear velocity of the tip, then for a pose the angular velocity, for
    an angle its part along the last axis that turns (the rate of the angle where
    `kinematics.common_direction` finds one); columns are the joints. The determinant
    does not depend on the base frame, nor (pose) on the point of the tip body that is
    followed, so the screws are written in a frame in the middle of the chain, where
    each depends on few joints [mathematics 9].

    Raises:
        UnableError: the number of joints is not the dimension of the task.
    """
    task, count = model.chain.task, len(model.joints)
    if count != DIMENSIONS[task]:
        raise UnableError("det J", f"{count} joints for a {task} task")
    build = _pose_determinant if task == "pose" else _point_determinant
    return on_circles(model, build(model))


@fact
def determinant_factors(model: ExactModel) -> list[tuple[Polynomial, int]]:
    """Det J as a function on V, factored: each factor with its multiplicity.

    Raises:
        UnableError: the number of joints is not the dimension of the task.
    """
    return factor_on_circles(model.ring, model.circles, jacobian_determinant(model))


def _point_determinant(model: ExactModel) -> Polynomial:
    """Velocity of the tip, and its turn about the last axis for an angle task.

    Everything is written in the moved frame of joint 2.
    """
    ring = model.ring
    first, second, *rest = model.joints
    back = (second.before @ model.motion(second)).inverse()
    placed = [
        (first, back.turn(first.axis), back.translation),
        (second, second.axis, zero(ring)),
    ]
    frame = Transform(ring, identity(ring), zero(ring))
    for joint in rest:
        frame = frame @ joint.before
        placed.append((joint, frame.turn(joint.axis), frame.translation))
        frame = frame @ model.motion(joint)
    point = frame.apply(model.tool.translation)
    columns = []
    for joint, axis, origin in placed:
        arm = tuple(a - b for a, b in zip(point, origin, strict=True))
        columns.append(cross(ring, axis, arm) if joint.kind == "revolute" else axis)
    rows = list(zip(*columns, strict=True))
    if model.chain.task == "position-and-angle":
        turns = [
            axis if joint.kind == "revolute" else zero(ring)
            for joint, axis, _ in placed
        ]
        last = next((axis for axis in reversed(turns) if any(axis)), zero(ring))
        rows.append(tuple(dot(ring, axis, last) for axis in turns))
    return determinant(ring, rows)


def _pose_determinant(model: ExactModel) -> Polynomial:
    """Laplace expansion over the columns of joints 1-3 and of joints 4-6."""
    ring = model.ring
    inner = _screws_before(model)
    outer = _screws_after(model)
    total = ring.constant(0)
    for rows in combinations(range(6), 3):
        rest = tuple(row for row in range(6) if row not in rows)
        sign = (-1) ** (sum(rows) + sum(range(3)))
        first = determinant(ring, [[column[row] for column in inner] for row in rows])
        last = determinant(ring, [[column[row] for column in outer] for row in rest])
        total += sign * on_circles(model, first) * on_circles(model, last)
    return total


def _screws_before(model: ExactModel) -> list[Column]:
    """Screws of joints 1, 2, 3 in the moved frame of joint 3."""
    ring, screws = model.ring, []
    back: Transform | None = None
    for joint in reversed(model.joints[:3]):
        undo = model.motion(joint).inverse()
        frame = undo if back is None else back @ undo
        screws.append(_screw(ring, joint, frame.turn(joint.axis), frame.translation))
        back = frame @ joint.before.inverse()
    return screws[::-1]


def _screws_after(model: ExactModel) -> list[Column]:
    """Screws of joints 4, 5, 6 in the moved frame of joint 3."""
    screws = []
    placed: Transform | None = None
    for joint in model.joints[3:]:
        frame = joint.before if placed is None else placed @ joint.before
        screws.append(
            _screw(model.ring, joint, frame.turn(joint.axis), frame.translation)
        )
        placed = frame @ model.motion(joint)
    return screws


def _screw(ring: Ring, joint: ExactJoint, axis: Column, origin: Column) -> Column:
    """(velocity at the frame's origin, angular velocity) of a unit joint speed."""
    if joint.kind == "prismatic":
        return (*axis, *zero(ring))
    return (*cross(ring, origin, axis), *axis)
