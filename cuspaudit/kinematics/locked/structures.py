"""Structures that make an arm noncuspidal at every value of a locked joint.

The theorems are those of `kinematics.theorems`; here the identities among their
hypotheses are tested with cosine and sine of the lock as indeterminates, and what must
not vanish becomes conditions, which balls test over spans of values. Whoever uses a
structure over a span checks that det J is not identically 0 at any of its values, which
every theorem supposes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from flint import ctx

from cuspaudit.kinematics.locked.axes import (
    Condition,
    apart,
    center,
    concurrent,
    coplanar,
    not_parallel,
    parallel,
    square,
)
from cuspaudit.kinematics.locked.locked_arm import LockedArm
from cuspaudit.kinematics.locked.no_offset import has_no_offset
from cuspaudit.kinematics.locked.regular_over import is_regular
from cuspaudit.kinematics.locked.span import Span
from cuspaudit.kinematics.theorems.triple_and_pair import PLACES

__all__ = ["LockedStructure", "holds", "structures"]

_BITS = 96


@dataclass(frozen=True)
class LockedStructure:
    """A theorem whose identities hold at every value of the lock.

    Attributes:
        name: of the theorem.
        why: what holds, of the axes of the arm that is left.
        held: the arm, or the same from tip to base, in whose ring the conditions are.
        conditions: what else its hypotheses are, where it is to be used.
    """

    name: str
    why: str
    held: LockedArm
    conditions: tuple[Condition, ...] = ()


def structures(held: LockedArm) -> tuple[LockedStructure, ...]:
    """Every structure whose identities hold, all proved exactly.

    Args:
        held: three joints for a position, or six for a pose.
    """
    kinds = held.arm.chain.kinds
    if len(kinds) == 3:
        return tuple(_three_joints(held))
    found = list(_slides(held))
    if kinds == ("revolute",) * 6:
        found += [*_wrist(held, "spherical wrist"), *_ur_pattern(held)]
        back = held.reversed()
        if back.arm.is_exact or not held.arm.is_exact:
            found += [
                replace(each, why=f"{each.why}, counted from the tip")
                for each in _wrist(back, "spherical shoulder")
            ]
        found += _triple_and_pair(held)
    return tuple(found)


def holds(held: LockedArm, structure: LockedStructure, span: Span) -> bool:
    """Whether the theorem proves the arm noncuspidal at every value in ``span``.

    A shorter span may do where this fails.
    """
    with ctx.workprec(_BITS):
        return all(
            structure.held.differs(condition, span)
            for condition in structure.conditions
        ) and is_regular(held, span)


def _three_joints(held: LockedArm) -> Iterator[LockedStructure]:
    if held.arm.chain.kinds != ("revolute",) * 3:
        return
    for first in (1, 2):
        if coplanar(held, first):
            axes = f"axes {first} and {first + 1} meet or are parallel"
            yield LockedStructure("neighbouring axes", axes, held)
    tool, one = held.arm.tool.translation, held.arm.ring.constant(1)
    if has_no_offset(held, (tool, one)):
        yield LockedStructure("no offset", "the three joints have no offset", held)


def _slides(held: LockedArm) -> Iterator[LockedStructure]:
    if held.arm.chain.kinds.count("prismatic") == 3:
        yield LockedStructure("three slides", "three joints slide and three turn", held)


def _wrist(held: LockedArm, name: str) -> Iterator[LockedStructure]:
    """Axes 4, 5, 6 in one point, and three joints before them that are noncuspidal."""
    if not concurrent(held, 4):
        return
    point = "axes 4, 5, 6 meet in one point"
    conditions = (not_parallel(held, 4), not_parallel(held, 5))
    for first in (2, 1):
        if coplanar(held, first):
            axes = f"axes {first} and {first + 1} meet or are parallel"
            yield LockedStructure(name, f"{point}, and {axes}", held, conditions)
    above, below = center(held, 4)
    fourth = held.arm.joints[3]
    lever = fourth.before.turn(tuple(above * x for x in fourth.axis))
    moved = (below * x for x in fourth.before.translation)
    place = tuple(a + b for a, b in zip(lever, moved, strict=True))
    if has_no_offset(held, (place, below)):
        why = f"{point}, and joints 1, 2, 3, which move it, have no offset"
        yield LockedStructure(name, why, held, conditions)


def _ur_pattern(held: LockedArm) -> Iterator[LockedStructure]:
    level = parallel(held, 2) and parallel(held, 3)
    if level and all(square(held, k) and coplanar(held, k) for k in (1, 4, 5)):
        why = "axes 2, 3, 4 are parallel, axes 1-2, 4-5, 5-6 meet at right angles"
        yield LockedStructure("UR pattern", why, held, (apart(held, 2), apart(held, 3)))


def _triple_and_pair(held: LockedArm) -> Iterator[LockedStructure]:
    for first, other in PLACES:
        if not coplanar(held, other):
            continue
        pair = f"axes {other} and {other + 1} meet or are parallel"
        axes = f"axes {first}, {first + 1}, {first + 2}"
        if parallel(held, first) and parallel(held, first + 1):
            why = f"{axes} are parallel, and {pair}"
            yield LockedStructure("triple and pair", why, held)
        elif concurrent(held, first):
            conditions = tuple(not_parallel(held, k) for k in (first, first + 1))
            why = f"{axes} meet in one point, and {pair}"
            yield LockedStructure("triple and pair", why, held, conditions)
