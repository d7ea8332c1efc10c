"""Where a structure of the axes makes the arm noncuspidal at values of the lock."""

from __future__ import annotations

from collections.abc import Iterator

from cuspaudit.auditing.free_joint.stretch import Stretch
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.locked.locked_arm import LockedArm
from cuspaudit.kinematics.locked.span import Span
from cuspaudit.kinematics.locked.structures import LockedStructure, holds, structures
from cuspaudit.runtime.clock import check_time

__all__ = ["by_structure"]

_PARTS = 16
_SHORTEST = 0.005
"""Degrees below which a span is not halved."""


def by_structure(held: LockedArm, domain: Span) -> tuple[Stretch, ...]:
    """The domain in stretches: noncuspidal by a structure, or open.

    Where the exact model only comes near the numbers, nothing is proved.
    """
    if not held.arm.is_exact:
        why = "the exact model only comes near the numbers, so no structure is proved"
        return (Stretch(domain, Verdict.UNDECIDED, "none", why),)
    found = structures(held)
    if not found:
        return (_open(domain),)
    return tuple(
        each for part in domain.parts(_PARTS) for each in _cut(held, found, part)
    )


def _cut(
    held: LockedArm, found: tuple[LockedStructure, ...], span: Span
) -> Iterator[Stretch]:
    check_time("structures")
    for structure in found:
        if holds(held, structure, span):
            why = f"{structure.name}: {structure.why}"
            yield Stretch(span, Verdict.NONCUSPIDAL, "structure", why)
            return
    if span.degrees < _SHORTEST or (
        span.degrees < 1 and not any(_may_hold(held, each, span) for each in found)
    ):
        yield _open(span)
        return
    for half in span.halves():
        yield from _cut(held, found, half)


def _may_hold(held: LockedArm, structure: LockedStructure, span: Span) -> bool:
    """Whether an end of the span, at least, has the structure."""
    ends = (Span(value, value) for value in (span.lower, span.upper))
    return any(holds(held, structure, end) for end in ends)


def _open(span: Span) -> Stretch:
    return Stretch(span, Verdict.UNDECIDED, "none", "no structure decides here")
