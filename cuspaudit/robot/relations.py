"""How the axes of a chain stand to each other, in words.

These are the D-H numbers that are 0 or a special angle: an offset between two axes in a
row that is 0 (they meet, or coincide), a twist that is a multiple of 30 or 45 degrees,
an offset along an axis that is 0. They hold in every posture. The words describe, and
nothing is proved by them: a number below 1e-300 counts as 0.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from itertools import pairwise

from flint import arb, ctx

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.lines import (
    BITS,
    Ball,
    Line,
    axis_lines,
    common_normal,
    cross,
    dot,
    minus,
    vanishes,
)
from cuspaudit.robot.virtual_joint import with_virtual_joint

__all__ = ["relations", "relations_of_lines"]

_UP: Ball = (arb(0), arb(0), arb(1))
_TWISTS = ("are square", "stand at 60 deg", "stand at 45 deg", "stand at 30 deg")


def relations(chain: Chain) -> frozenset[str]:
    """The sentences that hold of ``chain``, axes counted from 1 at the base.

    The last axis is the tool axis where that belongs to the task.

    >>> from fractions import Fraction
    >>> from cuspaudit.robot.chain import X_AXIS, Joint
    >>> joints = (Joint("a", "revolute"), Joint("b", "revolute", (), X_AXIS))
    >>> sorted(relations(Chain("arm", joints)))[:2]
    ['axes 1 and 2 are square', 'axes 1 and 2 meet']
    """
    chain = with_virtual_joint(chain)
    with ctx.workprec(BITS):
        lines, tip = axis_lines(chain)
        axis = lines[0].direction
        base = {f"axis 1 and z of the base {w}" for w in _twist(_UP, axis)}
        return frozenset(base) | relations_of_lines(chain, lines, tip)


def relations_of_lines(chain: Chain, lines: list[Line], tip: Ball) -> frozenset[str]:
    """The sentences that hold of the axes ``lines`` and of ``tip``, in any frame.

    A slide has a direction and no line: with it axes are parallel or square, and no
    more.

    Assumed is that ``ctx.prec`` is `BITS`.

    Args:
        chain: whose kinds of joints and task they have, its virtual joint included.
        lines: the axes, base to tip.
        tip: the tip's origin.
    """
    found: set[str] = set()
    for k, (line, after) in enumerate(pairwise(lines), 1):
        slides = "prismatic" in chain.kinds[k - 1 : k + 1]
        words = (
            _twist(line.direction, after.direction) if slides else _pair(line, after)
        )
        found |= {f"axes {k} and {k + 1} {word}" for word in words}
    for first, last in _level(lines, None if chain.task == "pose" else tip):
        if "prismatic" not in chain.kinds[first - 1 : last]:
            found.add(_no_offset(first, last, found))
    return frozenset(found)


def _pair(first: Line, second: Line) -> Iterator[str]:
    normal = cross(first.direction, second.direction)
    between = minus(second.point, first.point)
    if not vanishes(*normal):
        yield from _twist(first.direction, second.direction)
        if vanishes(dot(normal, between)):
            yield "meet"
    elif vanishes(*cross(first.direction, between)):
        yield "coincide"
    else:
        yield "are parallel"


def _twist(u: Ball, v: Ball) -> Iterator[str]:
    """The special angle between two directions: its cosine is sqrt(k)/2 or 1."""
    square = 4 * dot(u, v) * dot(u, v)
    for k, word in enumerate((*_TWISTS, "are parallel")):
        if vanishes(square - k):
            yield word


def _level(lines: list[Line], tip: Ball | None) -> Iterator[tuple[int, int]]:
    """First and last of the parallel axes in a row with no offset along them.

    That is between the common normals with the axes before and after, or the tip.
    """
    first, foot = 1, None
    for k, (line, after) in enumerate(pairwise(lines), 1):
        if vanishes(*cross(line.direction, after.direction)):
            continue
        here, there = common_normal(line, after)
        if foot and vanishes(dot(minus(here, foot), line.direction)):
            yield first, k
        first, foot = k + 1, there
    if foot and tip and vanishes(dot(minus(tip, foot), lines[-1].direction)):
        yield first, len(lines)


def _no_offset(first: int, last: int, found: Container[str]) -> str:
    """The sentence for no offset along axes ``first`` to ``last``."""
    if first < last:
        return f"no offset along axes {first} to {last}"
    before, after = (f"axes {k} and {k + 1} meet" for k in (first - 1, first))
    if before in found and after in found:
        return f"axes {first - 1}, {first} and {first + 1} meet in one point"
    return f"no offset along axis {first}"
