"""Five joints that place a point and point an axis: a pose task with one more joint.

A symmetric tool (a torch, a nozzle, a spindle) has no angle about its own axis. Its
task is the position p of the tip and the direction u of one axis of the tip's frame.

Theorem. Give a five-joint arm with this task a sixth joint that turns about the line
through the tip along u. The six-joint arm with the task "pose" has the same det J,
aspects that are those of the five-joint arm times a circle, as many postures of a pose,
and is cuspidal if and only if the five-joint arm is.

Proof. Let F(q) = (p, u) on the five joints and G(q, t) = (p, R(q) Rot(u, t)) on six.
Rot(u, t) keeps p and u, so F(q) is known from G(q, t), and the poses with one (p, u)
are one turn about u of each other.

Postures: if F(q) = F(q'), there is exactly one t' modulo 2 pi with G(q', t') = G(q, t);
so q -> (q, t) is a bijection of the postures of (p, u) with those of any of its poses.

det J: the last column of the six-joint Jacobian is (0; u). Write the angular rows in a
right-handed orthonormal frame (a, b, u), a rotation of the rows: the column becomes
(0, 0, 0, 0, 0, 1), and det J is the determinant of the rows p, a, b of the other five
columns. That is det J of the five-joint arm, for any such a and b, and t is not in it.
So the nonsingular postures of six joints are those of five times the circle of t.

Couples: a nonsingular path q(s) from q to q' with F(q) = F(q') lifts to (q(s), t(s)),
t any path from 0 to the t' above; a path of six joints projects to its first five,
and its ends differ in these, since a pose and q leave one t only.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Rotation,
    Task,
    Vector,
)

__all__ = ["TOOL_AXES", "TO_Z", "with_virtual_joint", "without_virtual_joint"]

TOOL_AXES: dict[Task, Vector] = {
    "position-and-x-axis": X_AXIS,
    "position-and-y-axis": Y_AXIS,
    "position-and-z-axis": Z_AXIS,
}
"""The axis of the tip's frame whose direction belongs to the task."""

TO_Z: dict[Vector, tuple[Rotation, ...]] = {
    X_AXIS: (Rotation(Y_AXIS, Angle(Fraction(-1, 2))),),
    Y_AXIS: (Rotation(X_AXIS, Angle(Fraction(1, 2))),),
    Z_AXIS: (),
}
"""The turn of a frame that carries this axis of it to z."""

_NAME = "tool axis"


def with_virtual_joint(chain: Chain) -> Chain:
    """The chain with a virtual joint about its tool axis, and the task "pose".

    A chain whose task has no tool axis, or has its virtual joint, comes back as it is.
    """
    axis = TOOL_AXES.get(chain.task)
    if axis is None:
        return chain
    turn = Joint(_NAME, "revolute", chain.tool, axis, is_virtual=True)
    return replace(chain, joints=(*chain.joints, turn), tool=(), task="pose")


def without_virtual_joint(chain: Chain) -> Chain:
    """The chain that `with_virtual_joint` made ``chain`` from.

    A chain that has no virtual joint comes back as it is.
    """
    *joints, last = chain.joints
    if not last.is_virtual:
        return chain
    [task] = (task for task, axis in TOOL_AXES.items() if axis == last.axis)
    return replace(chain, joints=tuple(joints), tool=last.before, task=task)
