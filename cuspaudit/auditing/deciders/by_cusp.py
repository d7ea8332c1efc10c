"""A six-joint arm that no theorem decides: a cusp of its map, proved.

A search by Newton's method meets cusps within half a second, inside the joint limits
first, because one there makes the arm cuspidal within them as well. A path is still
looked for afterwards: a person wants to see one.
"""

from __future__ import annotations

from dataclasses import replace

from cuspaudit.auditing.answer import Answer, Reason
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.cusp_witness import find_cusps
from cuspaudit.auditing.limits.joint_limits import has_limits
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.runtime.clock import Clock

__all__ = ["by_cusp"]


def by_cusp(case: Case, clock: Clock) -> Answer | None:
    """CUSPIDAL by a proved cusp of the model's chain; None where none was met."""
    found, chain = case.so_far, case.model.chain
    if found is None or not found.is_open_for(Reason.NO_THEOREM):
        return None
    if chain.task != "pose":
        return None
    try:
        clock.step("cusp")
        cusp = next(find_cusps(chain, case.seed), None)
        if cusp is None and has_limits(chain):
            cusp = next(find_cusps(chain, case.seed, inside=False), None)
    except UnableError:
        return None
    if cusp is None:
        return None
    at = ", ".join(f"{value:.4g}" for value in cusp.posture)
    return replace(
        found,
        verdict=Verdict.CUSPIDAL,
        why=f"the map of its task has a cusp, at ({at}); no path was proved",
        rests_on=("ball arithmetic",),
        engine="cusp",
        cusp=cusp,
        undecided=None,
    )
