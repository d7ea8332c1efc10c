"""Which of the fixed motions of a chain are geometry, and which are not.

A turn about a joint's own axis is the zero of the joint. The motion before the first
joint places the base. What follows the last joint matters as far as the task asks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import takewhile

from cuspaudit.robot.axes import unit_axis
from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.virtual_joint import with_virtual_joint

__all__ = [
    "absorb_zero",
    "geometry",
    "has_exact_cosine",
    "is_algebraic",
    "joined_turns",
    "split_tool",
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


def absorb_zero(joint: Joint) -> tuple[Joint, Angle]:
    """The joint without the turns about its own axis before it, and their angle."""
    before, zero = list(joint.before), Angle()
    if joint.kind == "revolute":
        while before and isinstance(before[-1], Rotation):
            factor = _ratio(before[-1].axis, joint.axis)
            if factor is None:
                break
            last = before.pop()
            assert isinstance(last, Rotation)
            zero = zero + (last.angle if factor > 0 else -last.angle)
    return replace(joint, before=tuple(before)), zero


def split_tool(chain: Chain) -> tuple[tuple[Motion, ...], tuple[Motion, ...]]:
    """What of the motion after the last joint the task asks for, and the rest.

    A pose of the tip is known from that of any frame fixed to it. For a position the
    last turns do not count. The virtual joint of a tool axis is taken for a joint.
    """
    motions = joined_turns(chain.tool)
    if chain.task == "pose":
        return (), motions
    turns = takewhile(lambda motion: isinstance(motion, Rotation), reversed(motions))
    deciding = len(motions) - len(list(turns))
    return motions[:deciding], motions[deciding:]


def geometry(chain: Chain) -> list[tuple[Motion, ...]]:
    """The motions that decide: between the joints, and from the last one to the tip."""
    chain = with_virtual_joint(chain)
    between = [joined_turns(absorb_zero(j)[0].before) for j in chain.joints[1:]]
    return [*between, split_tool(chain)[0]]


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
