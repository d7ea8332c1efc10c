"""From a chain to polynomials: the variety V = {f = 0} and the map R.

Each revolute joint contributes c_i, s_i and the circle c_i^2 + s_i^2 - 1, a prismatic
joint one free variable. The variables are those of the exact model: c_i and s_i are
taken at the joint value plus the joint's zero.
"""

from __future__ import annotations

from dataclasses import dataclass

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.kinematics.common_direction import cos_sin_angle
from cuspaudit.kinematics.exact_model import ExactJoint, ExactModel
from cuspaudit.kinematics.fact import fact
from cuspaudit.kinematics.transform import Column, Transform, cross, dot

__all__ = [
    "KinematicMap",
    "across_axis",
    "on_circles",
    "place",
    "polynomial_map",
    "reduce_circles",
    "reduced_map",
    "reduced_ring",
    "tip_from_first_axis",
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


@fact
def polynomial_map(model: ExactModel) -> KinematicMap:
    """V and the pose of the tip as polynomials on it [mathematics 3]."""
    ring = model.ring
    placed = None
    for joint in model.joints:
        step = joint.before @ model.motion(joint)
        placed = step if placed is None else placed @ step
    assert placed is not None, "a chain has at least one joint"
    placed = placed @ model.tool
    entries = [entry for row in placed.rotation for entry in row]
    return KinematicMap(
        PolynomialSystem(ring, model.equations),
        PolynomialMap(ring, tuple(on_circles(model, p) for p in placed.translation)),
        PolynomialMap(ring, tuple(on_circles(model, p) for p in entries)),
    )


@fact
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
        angle = (on_circles(model, p) for p in cos_sin_angle(model))
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


@fact
def reduced_map(model: ExactModel) -> tuple[PolynomialSystem, PolynomialMap]:
    """The plane map that decides a three-joint position task [mathematics 5].

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
    full, ring = model.ring, reduced_ring(model)
    _, point = tip_from_first_axis(model)
    values: Column
    if first.kind == "revolute":
        values = (dot(full, point, point), dot(full, first.axis, point))
    else:
        values = tuple(dot(full, e, point) for e in across_axis(full, first.axis))
    rest = (second, third)
    components = (reduce_circles(full, rest, full.reduce(v)) for v in values)
    return (
        PolynomialSystem(ring, circles(ring, rest)),
        PolynomialMap(ring, tuple(ring.from_other(p, full) for p in components)),
    )


def reduced_ring(model: ExactModel) -> Ring:
    """The ring of the variables of joints 2 and 3."""
    _, second, third = model.joints
    return Ring((*second.variables, *third.variables), model.ring.radicand)


def tip_from_first_axis(model: ExactModel) -> tuple[Transform, Column]:
    """The fixed transform before joint 2, seen from axis 1, and the tip there.

    Origin is the foot on axis 1: the translation has no part along the axis.
    """
    first, second, third = model.joints
    full = model.ring
    step = model.tool.apply(_origin(full))
    step = model.motion(third).apply(step)
    step = third.before.apply(step)
    step = model.motion(second).apply(step)
    along = dot(full, first.axis, second.before.translation)
    offset = tuple(
        t - along * a
        for t, a in zip(second.before.translation, first.axis, strict=True)
    )
    frame = Transform(full, second.before.rotation, offset)
    return frame, frame.apply(step)


def across_axis(ring: Ring, axis: Column) -> tuple[Column, Column]:
    """Two independent directions orthogonal to a unit ``axis``."""
    for i in range(3):
        unit = tuple(ring.constant(int(i == j)) for j in range(3))
        across = cross(ring, axis, unit)
        if any(entry != 0 for entry in across):
            return across, cross(ring, axis, across)
    raise AssertionError("an axis is never zero")


def _origin(ring: Ring) -> Column:
    return tuple(ring.constant(0) for _ in range(3))


def on_circles(model: ExactModel, polynomial: Polynomial) -> Polynomial:
    """The representative of degree at most 1 in each cosine, on V the same function."""
    for circle in model.equations:
        polynomial = divmod(polynomial, circle)[1]
    return model.ring.reduce(polynomial)
