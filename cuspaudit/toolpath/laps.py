"""What a run of a closed path does lap after lap.

The end of a lap is the start of the next one in another run of the list, up to whole
turns of joints, which change nothing on joints without limits. So laps are followed
along the permutation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from cuspaudit.toolpath.traced_path import TracedPath

__all__ = ["Laps", "laps_of"]

Kind = Literal[
    "repeatable", "repeatable after laps", "winds", "changes posture", "ends"
]


@dataclass(frozen=True)
class Laps:
    """The laps of one run.

    Attributes:
        kind: what the first lap does: back in the same joint vector, in the same
            posture but for whole turns (winds), in another posture, or it ends.
        completed: how many of the laps asked for it completes.
        repeats_after: after how many laps the joint vector is the first again, or None.
        ends_in: for each completed lap the run in which it ends.
    """

    kind: Kind
    completed: int
    repeats_after: int | None
    ends_in: tuple[int, ...]


def laps_of(trace: TracedPath, count: int = 1) -> list[Laps]:
    """The laps of every run of a closed path, at most ``count`` of each."""
    if trace.permutation is None or trace.turns is None:
        return []
    return [
        _laps(trace, trace.permutation, trace.turns, k, count)
        for k in range(len(trace.runs))
    ]


def _laps(
    trace: TracedPath,
    sigma: Sequence[int | None],
    turns: Sequence[tuple[int, ...] | None],
    start: int,
    count: int,
) -> Laps:
    visited: list[int] = []
    total = [0] * trace.arm.joints
    here, repeats = start, None
    for lap in range(1, max(count, len(sigma)) + 1):
        to, own = sigma[here], turns[here]
        if to is None or own is None:
            break
        if lap <= count:
            visited.append(to)
        total = [a + b for a, b in zip(total, own, strict=True)]
        here = to
        if here == start and repeats is None and not any(total):
            repeats = lap
    return Laps(
        _kind(trace, sigma, turns, start, repeats),
        len(visited),
        repeats,
        tuple(visited),
    )


def _kind(
    trace: TracedPath,
    sigma: Sequence[int | None],
    turns: Sequence[tuple[int, ...] | None],
    start: int,
    repeats: int | None,
) -> Kind:
    to = sigma[start]
    if to is None:
        return "ends"
    if to == start and not any(turns[start] or ()):
        return "repeatable"
    if trace.runs[to].posture == trace.runs[start].posture:
        return "winds"
    return "changes posture" if repeats is None else "repeatable after laps"
