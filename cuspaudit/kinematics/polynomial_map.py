"""From a chain to polynomials: the variety V = {f = 0}, the map R, and det J.

Each revolute joint contributes c_i, s_i and the circle c_i^2 + s_i^2 - 1, a prismatic
joint one free variable. The variables are those of the exact model: c_i and s_i are
taken at the joint value plus the joint's zero.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

from cuspaudit.algebra.matrix import determinant
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.common_direction import cos_sin_angle
from cuspaudit.kinematics.exact_model import ExactJoint, ExactModel
from cuspaudit.kinematics.transform import Column, Transform, cross, dot, identity
from cuspaudit.robot.task import DIMENSIONS

__all__ = [
    "KinematicMap",
    "jacobian_determinant",
    "place",
    "polynomial_map",
    "reduce_circles",
    "reduced_map",
]


@dataclass(frozen=True)
class KinematicMap:
    """The map of a chain: V and the pose of the tip on it.

    Attributes:
        variety: V, one circle for each revolute joint.
        position: the tip's origin in the base frame, three components.
        rotation: the tip's axes in the base frame, nine entries by rows.
    """

    variety: PolynomialSystem
    position: PolynomialMap
    rotation: PolynomialMap


def polynomial_map(model: ExactModel) -> KinematicMap:
    """V and the pose of the tip as polynomials on it [DESIGN 3]."""
    ring = model.ring
    placed = None
    for joint in model.joints:
        step = joint.before @ model.motion(joint)
        placed = step if placed is None else placed @ step
    assert placed is not None, "a chain has at least one joint"
    placed = placed @ model.tool
    entries = [entry for row in placed.rotation for entry in row]
    return KinematicMap(
        PolynomialSystem(ring, circles(ring, model.joints)),
        PolynomialMap(ring, tuple(_on_circles(model, p) for p in placed.translation)),
        PolynomialMap(ring, tuple(_on_circles(model, p) for p in entries)),
    )


def place(model: ExactModel) -> tuple[Polynomial, ...]:
    """The map R of the task: what two postures of one place agree in.

    The tip's position, then for a pose the nine entries of its rotation, for an angle
    its cosine and sine.

    Raises:
        NoAngleError: the task is an angle, and the tip has none.
    """
    found = polynomial_map(model)
    if model.chain.task == "pose":
        return found.position.components + found.rotation.components
    if model.chain.task == "position-and-angle":
        angle = (_on_circles(model, p) for p in cos_sin_angle(model))
        return (*found.position.components, *angle)
    return found.position.components


def circles(ring: Ring, joints: tuple[ExactJoint, ...]) -> tuple[Polynomial, ...]:
    """The equation c^2 + s^2 - 1 of each revolute joint."""
    pairs = (joint.variables for joint in joints if joint.kind == "revolute")
    return tuple(ring.gen(c) ** 2 + ring.gen(s) ** 2 - 1 for c, s in pairs)


def reduce_circles(
    ring: Ring, joints: tuple[ExactJoint, ...], polynomial: Polynomial
) -> Polynomial:
    """The representative of degree at most 1 in each cosine, on V the same function."""
    for circle in circles(ring, joints):
        polynomial = divmod(polynomial, circle)[1]
    return ring.reduce(polynomial)


def reduced_map(model: ExactModel) -> tuple[PolynomialSystem, PolynomialMap]:
    """The plane map that decides a three-joint position task [DESIGN 5].

    The first joint drops out. If it is revolute with axis z1 and the tip is at p from
    a point of that axis, the arm is cuspidal if and only if (|p|^2, z1 . p) is, as a
    map on the other two joints: x^2 + y^2 = |p|^2 - (z1 . p)^2, and a turn about z1
    closes any path whose ends agree in both. If it is prismatic, the two coordinates
    of p across z1 take their place. det J is, up to a nonzero constant, the Jacobian
    of this map; so singularities, aspects and couples correspond.

    Args:
        model: three joints, task "position".

    Returns:
        V in the variables of joints 2 and 3, and the map to R^2.
    """
    first, second, third = model.joints
    full = model.ring
    ring = Ring((*second.variables, *third.variables), full.radicand)
    step = model.tool.apply(_origin(full))
    step = model.motion(third).apply(step)
    step = third.before.apply(step)
    step = model.motion(second).apply(step)
    along = dot(full, first.axis, second.before.translation)
    offset = tuple(
        t - along * a
        for t, a in zip(second.before.translation, first.axis, strict=True)
    )
    point = Transform(full, second.before.rotation, offset).apply(step)
    values: Column
    if first.kind == "revolute":
        values = (dot(full, point, point), dot(full, first.axis, point))
    else:
        values = tuple(dot(full, e, point) for e in _across(full, first.axis))
    rest = (second, third)
    components = (reduce_circles(full, rest, full.reduce(v)) for v in values)
    return (
        PolynomialSystem(ring, circles(ring, rest)),
        PolynomialMap(ring, tuple(ring.from_other(p, full) for p in components)),
    )


def jacobian_determinant(model: ExactModel) -> Polynomial:
    """The determinant det J of the task, a polynomial reduced modulo the circles.

    Rows are the linear velocity of the tip, then for a pose the angular velocity, for
    an angle its part along the last axis that turns (the rate of the angle where
    `four_joints.common_direction` finds one); columns are the joints. The determinant
    does not depend on the base frame, nor (pose) on the point of the tip body that is
    followed, so the screws are written in a frame in the middle of the chain, where
    each depends on few joints [DESIGN 9].

    Raises:
        UnableError: the number of joints is not the dimension of the task.
    """
    task, count = model.chain.task, len(model.joints)
    if count != DIMENSIONS[task]:
        raise UnableError("det J", f"{count} joints for a {task} task")
    build = _pose_determinant if task == "pose" else _point_determinant
    return _on_circles(model, build(model))


def _point_determinant(model: ExactModel) -> Polynomial:
    """Velocity of the tip, and its turn about the last axis for an angle task.

    Everything is written in the moved frame of joint 2.
    """
    ring = model.ring
    first, second, *rest = model.joints
    back = (second.before @ model.motion(second)).inverse()
    placed = [
        (first, back.turn(first.axis), back.translation),
        (second, second.axis, _origin(ring)),
    ]
    frame = Transform(ring, identity(ring), _origin(ring))
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
            axis if joint.kind == "revolute" else _origin(ring)
            for joint, axis, _ in placed
        ]
        last = next((axis for axis in reversed(turns) if any(axis)), _origin(ring))
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
        total += sign * _on_circles(model, first) * _on_circles(model, last)
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
        return (*axis, *_origin(ring))
    return (*cross(ring, origin, axis), *axis)


def _across(ring: Ring, axis: Column) -> tuple[Column, Column]:
    """Two independent directions orthogonal to a unit ``axis``."""
    for i in range(3):
        unit = tuple(ring.constant(int(i == j)) for j in range(3))
        across = cross(ring, axis, unit)
        if any(entry != 0 for entry in across):
            return across, cross(ring, axis, across)
    raise AssertionError("an axis is never zero")


def _origin(ring: Ring) -> Column:
    return tuple(ring.constant(0) for _ in range(3))


def _on_circles(model: ExactModel, polynomial: Polynomial) -> Polynomial:
    return reduce_circles(model.ring, model.joints, polynomial)
