"""Which of the fixed motions of a chain are geometry, and which are not.

A turn about a joint's own axis is the zero of the joint. The motion before the first
joint places the base. What follows the last joint matters as far as the task asks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, takewhile

from cuspaudit.robot.axes import unit_axis
from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.virtual_joint import with_virtual_joint

__all__ = [
    "FixedMotions",
    "geometry",
    "has_exact_cosine",
    "is_algebraic",
    "joined_turns",
    "split_tool",
    "without_zeros",
]

_FIELDS = {1: 1, 2: 1, 4: 2, 3: 3, 6: 3}
"""The radicand of the field of cosine and sine, by the denominator of half turns."""


def joined_turns(motions: Sequence[Motion]) -> tuple[Motion, ...]:
    """The same motion, with turns in a row about one direction made one, and moves too.

    Their angles add exactly: 0.6 - 0.3 - 0.3 rad, or 110 - 55 - 55 deg, are no turn.

    >>> turns = [Rotation((1, 0, 0), Angle(Fraction(k))) for k in (2, -1, -1)]
    >>> joined_turns(turns)
    ()
    """
    result: list[Motion] = []
    for motion in motions:
        whole = _joined(result[-1], motion) if result else None
        if whole is None:
            result.append(motion)
            continue
        result.pop()
        if isinstance(whole, Translation) or not whole.angle.is_zero:
            result.append(whole)
    return tuple(result)


@dataclass(frozen=True, slots=True)
class FixedMotions:
    """The fixed motions of a chain without the turns that are zeros of its joints.

    Attributes:
        before: before each joint, base to tip.
        zeros: what a joint turns by when its value is 0, base to tip.
        tool: after the last joint.
    """

    before: tuple[tuple[Motion, ...], ...]
    zeros: tuple[Angle, ...]
    tool: tuple[Motion, ...]


def without_zeros(chain: Chain) -> FixedMotions:
    """The fixed motions, without the turns about a joint's own axis on either side."""
    parts = [list(joined_turns(joint.before)) for joint in chain.joints]
    parts.append(list(joined_turns(chain.tool)))
    zeros = []
    for joint, (before, after) in zip(chain.joints, pairwise(parts), strict=True):
        zero = Angle()
        if joint.kind == "revolute":
            while before and (turn := _about(joint.axis, before[-1])) is not None:
                before.pop()
                zero += turn
            while after and (turn := _about(joint.axis, after[0])) is not None:
                after.pop(0)
                zero += turn
        zeros.append(zero)
    *befores, tool = map(tuple, parts)
    return FixedMotions(tuple(befores), tuple(zeros), tool)


def _about(axis: Vector, motion: Motion) -> Angle | None:
    """The angle of a turn about ``axis``, or None."""
    if not isinstance(motion, Rotation):
        return None
    factor = _ratio(motion.axis, axis)
    if factor is None:
        return None
    return motion.angle if factor > 0 else -motion.angle


def split_tool(
    chain: Chain, tool: tuple[Motion, ...]
) -> tuple[tuple[Motion, ...], tuple[Motion, ...]]:
    """What of the motion after the last joint the task asks for, and the rest.

    A pose of the tip is known from that of any frame fixed to it. For a position the
    last turns do not count. The virtual joint of a tool axis is taken for a joint.

    Args:
        chain: whose task it is.
        tool: the motion, without what is a zero of the last joint.
    """
    if chain.task == "pose":
        return (), tool
    turns = takewhile(lambda motion: isinstance(motion, Rotation), reversed(tool))
    deciding = len(tool) - len(list(turns))
    return tool[:deciding], tool[deciding:]


def geometry(chain: Chain) -> list[tuple[Motion, ...]]:
    """The motions that decide: between the joints, and from the last one to the tip."""
    chain = with_virtual_joint(chain)
    fixed = without_zeros(chain)
    return [*fixed.before[1:], split_tool(chain, fixed.tool)[0]]


def is_algebraic(chain: Chain) -> bool:
    """Whether a model over Q, Q(sqrt 2) or Q(sqrt 3) is the chain exactly."""
    if chain.near or any(unit_axis(j.axis) is None for j in chain.joints):
        return False
    fields = set()
    for motion in (motion for part in geometry(chain) for motion in part):
        if isinstance(motion, Rotation):
            if motion.angle.radians or unit_axis(motion.axis) is None:
                return False
            fields.add(_FIELDS.get(motion.angle.half_turns.denominator, 0))
    return fields - {1} in (set(), {2}, {3})


def has_exact_cosine(angle: Angle) -> bool:
    """Whether cosine and sine lie in Q, Q(sqrt 2) or Q(sqrt 3)."""
    return angle.radians == 0 and angle.half_turns.denominator in _FIELDS


def _joined(first: Motion, second: Motion) -> Motion | None:
    if isinstance(first, Translation) and isinstance(second, Translation):
        x, y, z = (a + b for a, b in zip(first.vector, second.vector, strict=True))
        return Translation((x, y, z), first.source)
    if isinstance(first, Rotation) and isinstance(second, Rotation):
        factor = _ratio(second.axis, first.axis)
        if factor is not None:
            turned = second.angle if factor > 0 else -second.angle
            return Rotation(first.axis, first.angle + turned, first.source)
    return None


def _ratio(a: Vector, b: Vector) -> Fraction | None:
    """The factor with a = factor b, or None."""
    at = max(range(3), key=lambda i: abs(b[i]))
    factor = Fraction(a[at]) / b[at]
    parallel = all(x == factor * y for x, y in zip(a, b, strict=True))
    return factor if parallel else None
