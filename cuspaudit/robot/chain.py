"""A serial chain, exactly as its file describes it.

A chain is a base, joints and a tip. Before each joint stands a fixed transform, a
product of translations and rotations whose numbers are exact: lengths are rational,
angles are ``half_turns * pi + radians`` with both rational. Nothing here is a float
and nothing is rounded: a chain is the robot of the data sheet, and the models that
the mathematics works on (`exact_model`, `frames`) are derived from it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Literal

__all__ = [
    "X_AXIS",
    "Y_AXIS",
    "Z_AXIS",
    "Angle",
    "Chain",
    "Joint",
    "JointKind",
    "Motion",
    "Rotation",
    "Task",
    "Translation",
    "Vector",
    "reverse",
]

Vector = tuple[Fraction, Fraction, Fraction]
JointKind = Literal["revolute", "prismatic"]
Task = Literal[
    "position",
    "position-and-angle",
    "position-and-x-axis",
    "position-and-y-axis",
    "position-and-z-axis",
    "pose",
]

X_AXIS: Vector = (Fraction(1), Fraction(0), Fraction(0))
Y_AXIS: Vector = (Fraction(0), Fraction(1), Fraction(0))
Z_AXIS: Vector = (Fraction(0), Fraction(0), Fraction(1))


@dataclass(frozen=True, slots=True)
class Angle:
    """The angle ``half_turns * pi + radians``, both parts rational.

    >>> Angle(Fraction(1, 2)) + Angle(radians=Fraction(1, 10))
    Angle(half_turns=Fraction(1, 2), radians=Fraction(1, 10))
    """

    half_turns: Fraction = Fraction(0)
    radians: Fraction = Fraction(0)

    def __add__(self, other: Angle) -> Angle:
        return Angle(self.half_turns + other.half_turns, self.radians + other.radians)

    def __neg__(self) -> Angle:
        return Angle(-self.half_turns, -self.radians)

    @property
    def is_zero(self) -> bool:
        """Whether the angle is exactly 0."""
        return self.half_turns == 0 and self.radians == 0


@dataclass(frozen=True, slots=True)
class Translation:
    """A translation by ``vector``, in the chain's unit of length.

    Attributes:
        vector: the three components.
        source: where the file has them ("joint_2 xyz"), or ""; not compared.
        decimals: with how many each was printed by a program, or (); not compared.
    """

    vector: Vector
    source: str = field(default="", compare=False, repr=False)
    decimals: tuple[int, ...] = field(default=(), compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Rotation:
    """A rotation by ``angle`` about the direction ``axis`` (not necessarily unit).

    Attributes:
        axis: the direction, not zero.
        angle: by the right-hand rule.
        source: where the file has the angle ("joint_2 rpy[0]"), or ""; not compared.
        decimals: with how many a program printed its radians, or (); not compared.
    """

    axis: Vector
    angle: Angle
    source: str = field(default="", compare=False, repr=False)
    decimals: tuple[int, ...] = field(default=(), compare=False, repr=False)


Motion = Translation | Rotation


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint and the fixed transform that stands before it.

    The frame of the joint is that of the previous joint (or of the base) followed by
    ``before``, read left to right; the joint then turns about, or slides along,
    ``axis`` in that frame by its value (rad, or the chain's unit of length).

    Attributes:
        name: unique in the chain.
        kind: "revolute" or "prismatic".
        before: the fixed transform from the previous joint's moved frame.
        axis: direction of the joint axis, not zero, not necessarily unit.
        limits: lower and upper value, or None when the joint has none.
        is_virtual: whether no motor makes it (`virtual_joint`).
        printed_axis: the axis as a program printed it, and with how many decimals;
            None when the numbers are exact; not compared.
    """

    name: str
    kind: JointKind
    before: tuple[Motion, ...] = ()
    axis: Vector = Z_AXIS
    limits: tuple[Angle, Angle] | tuple[Fraction, Fraction] | None = None
    is_virtual: bool = False
    printed_axis: tuple[Vector, tuple[int, ...]] | None = field(
        default=None, compare=False, repr=False
    )


@dataclass(frozen=True, slots=True)
class Chain:
    """A serial chain from ``base`` to ``tip``.

    Attributes:
        name: the robot's name.
        joints: base to tip; at least one.
        tool: the fixed transform after the last joint.
        task: what of the tip is to be reached: its position (three equations),
            position and angle (four, `four_joints`), position and direction of one
            axis of its frame (five, `virtual_joint`), or its pose (six).
        base: name of the base link or frame.
        tip: name of the tip link or frame.
        unit: unit of every length, "m" or "mm".
        near: the numbers between its axes that only come near those of the chain it
            was written for (`canonical`), in words; not compared.
    """

    name: str
    joints: tuple[Joint, ...]
    tool: tuple[Motion, ...] = ()
    task: Task = "position"
    base: str = "base"
    tip: str = "tip"
    unit: str = "m"
    near: tuple[str, ...] = field(default=(), compare=False)

    @property
    def kinds(self) -> tuple[JointKind, ...]:
        """The kind of each joint, base to tip."""
        return tuple(joint.kind for joint in self.joints)

    def with_joints(self, joints: Sequence[Joint]) -> Chain:
        """The same chain with other joints."""
        return replace(self, joints=tuple(joints))


def reverse(chain: Chain) -> Chain:
    """The chain from tip to base: its pose is the inverse of the pose of ``chain``.

    Joint values keep their meaning, joints come in reverse order and every axis
    points the other way.
    """
    fixed = [joint.before for joint in chain.joints] + [chain.tool]
    joints = [
        replace(
            joint,
            before=_inverse(after),
            axis=_opposite(joint.axis),
            printed_axis=None,
        )
        for joint, after in zip(chain.joints, fixed[1:], strict=True)
    ]
    return replace(
        chain,
        joints=tuple(reversed(joints)),
        tool=_inverse(fixed[0]),
        base=chain.tip,
        tip=chain.base,
    )


def _inverse(motions: Sequence[Motion]) -> tuple[Motion, ...]:
    return tuple(
        Translation(_opposite(motion.vector))
        if isinstance(motion, Translation)
        else Rotation(motion.axis, -motion.angle)
        for motion in reversed(motions)
    )


def _opposite(vector: Vector) -> Vector:
    x, y, z = vector
    return (-x, -y, -z)
