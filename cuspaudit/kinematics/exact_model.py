"""An exact algebraic model of a chain, over Q or Q(sqrt 2) or Q(sqrt 3).

Cosine and sine of a multiple of pi/4 or pi/6 are exact in the field of the model. Any
other angle, and any axis whose length is irrational, has no exact algebraic form: it
is replaced by a rational point of the circle or of the sphere within ``tolerance``,
and the replacement is recorded. A rotation about a joint's own axis is not geometry:
it shifts the joint's zero and needs no cosine.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.directions import cos_sin, unit_vector
from cuspaudit.kinematics.transform import (
    Column,
    Transform,
    column,
    identity,
    turn,
    zero,
)
from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
)
from cuspaudit.robot.fixed_motions import split_tool, without_zeros
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.virtual_joint import with_virtual_joint

__all__ = [
    "Approximation",
    "ExactJoint",
    "ExactModel",
    "exact_model",
    "revolute_circles",
]

TOLERANCE = Fraction(1, 10**12)
_NO_FIELD = -1


@dataclass(frozen=True)
class Approximation:
    """A number of the chain that the exact model only comes close to.

    Attributes:
        where: joint and what about it.
        difference: a bound on the distance, in rad.
        is_idle: whether it only turns the base, or the tip where the task does not
            ask for it: the arm is the same.
        joint: the number of the joint that it stands before, or whose axis it is, from
            1; 0 where it may be any.
    """

    where: str
    difference: float
    is_idle: bool = False
    joint: int = 0


@dataclass(frozen=True)
class ExactJoint:
    """A joint of the model.

    Attributes:
        name: as in the chain.
        kind: "revolute" or "prismatic".
        before: the fixed transform from the previous joint's moved frame.
        axis: unit vector.
        zero: what is added to the joint value to get the model's variable (rad).
        variables: names of (cos, sin), or of the displacement, in the ring.
    """

    name: str
    kind: str
    before: Transform
    axis: Column
    zero: Angle
    variables: tuple[str, ...]


@dataclass(frozen=True)
class ExactModel:
    """A chain in exact numbers.

    Attributes:
        chain: what it models.
        ring: K[c1, s1, ...], the variables of all joints, base to tip.
        joints: base to tip.
        tool: the fixed transform after the last joint.
        approximations: empty when the model is the chain exactly.
    """

    chain: Chain
    ring: Ring
    joints: tuple[ExactJoint, ...]
    tool: Transform
    approximations: tuple[Approximation, ...]

    @property
    def is_exact(self) -> bool:
        """Whether no number that decides was approximated."""
        return all(entry.is_idle for entry in self.approximations)

    @cached_property
    def circles(self) -> list[tuple[str, str]]:
        """The variables (c_i, s_i) of the revolute joints, base to tip."""
        turning = (joint for joint in self.joints if joint.kind == "revolute")
        return [(joint.variables[0], joint.variables[1]) for joint in turning]

    @cached_property
    def equations(self) -> tuple[Polynomial, ...]:
        """The equation c^2 + s^2 - 1 of each revolute joint, base to tip."""
        gen = self.ring.gen
        return tuple(gen(c) ** 2 + gen(s) ** 2 - 1 for c, s in self.circles)

    @cached_property
    def zeros(self) -> NDArray[np.float64]:
        """What is added to each joint value to get the model's variable, in rad."""
        zeros = np.array([angle_value(joint.zero) for joint in self.joints])
        zeros.flags.writeable = False
        return zeros

    def motion(self, joint: ExactJoint) -> Transform:
        """The transform of a joint's own motion, polynomial in its variables."""
        ring = self.ring
        if joint.kind == "prismatic":
            q = ring.gen(joint.variables[0])
            identity = turn(ring, joint.axis, ring.constant(1), ring.constant(0))
            return Transform(ring, identity, tuple(x * q for x in joint.axis))
        c, s = (ring.gen(name) for name in joint.variables)
        return Transform(ring, turn(ring, joint.axis, c, s), zero(ring))


def exact_model(chain: Chain, tolerance: Fraction = TOLERANCE) -> ExactModel:
    """The exact model of ``chain``, with its virtual joint if its task asks for one.

    Args:
        chain: any chain.
        tolerance: how far, in rad, an angle or an axis may be moved to a rational one.
    """
    chain = with_virtual_joint(chain)
    fixed = without_zeros(chain)
    tip, idle = split_tool(chain, fixed.tool)
    rest = [motion for before in fixed.before[1:] for motion in before]
    ring = Ring(_variables(chain), _radicand(chain, [*rest, *tip]))
    seen = [Approximation(where, float(tolerance)) for where in chain.near]

    def note(where: str, joint: int, is_idle: bool = False) -> None:
        seen.append(Approximation(where, float(tolerance), is_idle, joint))

    def product(
        motions: Sequence[Motion], where: str, joint: int, is_idle: bool
    ) -> Transform:
        result, near = _product(ring, motions, tolerance)
        for what in near:
            note(f"{where}, {what}", joint, is_idle)
        return result

    joints = []
    for number, (joint, moves, zero_angle) in enumerate(
        zip(chain.joints, fixed.before, fixed.zeros, strict=True), 1
    ):
        before = product(moves, f"{joint.name} before", number, number == 1)
        axis, exact = unit_vector(joint.axis, tolerance)
        if not exact:
            note(f"{joint.name} axis", number)
        names, unit = _names(number, joint), column(ring, axis)
        joints.append(
            ExactJoint(joint.name, joint.kind, before, unit, zero_angle, names)
        )
    last = len(joints) + 1
    tool = product(tip, "tool", last, False) @ product(idle, "tool", last, True)
    return ExactModel(chain, ring, tuple(joints), tool, tuple(seen))


def revolute_circles(model: ExactModel) -> list[tuple[str, str]]:
    """The variables (c_i, s_i) of each joint.

    Raises:
        UnableError: a joint is prismatic.
    """
    for joint in model.joints:
        if joint.kind != "revolute":
            raise UnableError("aspects", f"joint {joint.name} is prismatic")
    return model.circles


def _names(number: int, joint: Joint) -> tuple[str, ...]:
    if joint.kind == "prismatic":
        return (f"q{number}",)
    return (f"c{number}", f"s{number}")


def _variables(chain: Chain) -> Iterator[str]:
    for number, joint in enumerate(chain.joints, 1):
        yield from _names(number, joint)


def _radicand(chain: Chain, motions: list[Motion]) -> int | None:
    """The radicand that most of the angles ask for, or None.

    When no field makes all angles of a three-joint chain exact, its model is near
    anyway, and the elimination is ten to fifty times faster over Q. The reductions of
    a six-joint chain gain from every angle that stays exact.
    """
    wanted: Counter[int] = Counter()
    for motion in motions:
        if isinstance(motion, Rotation):
            denominator = motion.angle.half_turns.denominator
            kind = {1: 0, 2: 0, 4: 2, 3: 3, 6: 3}.get(denominator, _NO_FIELD)
            wanted[kind if motion.angle.radians == 0 else _NO_FIELD] += 1
    del wanted[0]
    if len(wanted) > 1 and len(chain.joints) <= 3:
        return None
    del wanted[_NO_FIELD]
    return wanted.most_common(1)[0][0] if wanted else None


def _product(
    ring: Ring, motions: Sequence[Motion], tolerance: Fraction
) -> tuple[Transform, list[str]]:
    """The product of ``motions``, and what of it was approximated."""
    result, near = Transform(ring, identity(ring), zero(ring)), []
    for motion in motions:
        if isinstance(motion, Translation):
            step = Transform(ring, identity(ring), column(ring, motion.vector))
        else:
            axis, exact_axis = unit_vector(motion.axis, tolerance)
            c, s, exact = cos_sin(ring, motion.angle, tolerance)
            near += [] if exact_axis else ["rotation axis"]
            near += [] if exact else ["angle"]
            rows = turn(ring, column(ring, axis), c, s)
            step = Transform(ring, rows, zero(ring))
        result = result @ step
    return result, near
