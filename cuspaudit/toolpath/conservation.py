"""What complete lists of postures and runs must agree in."""

from __future__ import annotations

from collections.abc import Sequence

from cuspaudit.errors import CrossCheckError
from cuspaudit.toolpath.following.starts import Solved
from cuspaudit.toolpath.following.strands import Followed
from cuspaudit.toolpath.known import Known
from cuspaudit.toolpath.traced_arm import TracedArm

__all__ = ["check_conservation"]


def check_conservation(
    arm: TracedArm,
    first: Solved,
    last: Solved,
    found: Followed,
    starts: Sequence[Known],
    ends: Sequence[Known],
) -> None:
    """Conservation: what two complete lists must agree in.

    Raises:
        CrossCheckError: they do not; then one of them has a bug.
    """
    undecided = any("undecided" in (r.begin.kind, r.end.kind) for r in found.runs)
    known = all(k.knot is not None for k in (*starts, *ends))
    if undecided or not known:
        return
    for solved, matched, side in (
        (first, found.starts, "first"),
        (last, found.ends, "last"),
    ):
        if not solved.complete:
            continue
        touching = sum(
            (run.begin if side == "first" else run.end).kind == "path"
            for run in found.runs
        )
        if None in matched or touching != len(matched):
            raise CrossCheckError(
                f"{touching} runs at the {side} pose, which has {len(matched)} postures"
            )
        signs = [k.sign for k in (starts if side == "first" else ends)]
        if all(arm.balls.revolute) and signs.count(1) != signs.count(-1):
            raise CrossCheckError(
                f"the {side} pose has {signs.count(1)} postures of sign + and "
                f"{signs.count(-1)} of sign -"
            )
