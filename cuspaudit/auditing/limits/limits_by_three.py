"""Three joints within their limits, exactly: the arm, or those before a wrist.

A path through the cells of the box is shown with a CUSPIDAL. Of a wrist a NONCUSPIDAL
of the three joints is one of the six; a CUSPIDAL is where a path is lifted to all six.
"""

from __future__ import annotations

from dataclasses import replace

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.limits.limits_result import LimitsAnswer
from cuspaudit.auditing.limits.limits_witness import first_proved, paths_of_cells, shown
from cuspaudit.auditing.limits.three_in_box import ThreeInBox, decide_three
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, TimeLimitError, UnableError
from cuspaudit.robot.chain import Chain
from cuspaudit.runtime.clock import Clock

__all__ = ["WRISTS", "box_of", "by_three", "with_path"]

WRISTS = ("spherical wrist", "spherical shoulder")
_EXACT = ("FLINT resultants", "FLINT root isolation", "ball arithmetic")


def by_three(
    nothing: LimitsAnswer, found: Answer, literal: Chain, clock: Clock
) -> LimitsAnswer | None:
    """What the exact routes for three joints say, of the arm or of its first three."""
    box, reduction = box_of(found, clock), found.reduction
    if box is None:
        return None
    if found.model.chain.task == "position":
        return with_path(_of_three(nothing, box), found, box, literal)
    assert reduction is not None, "three joints of six are those of a wrist"
    if box.verdict is Verdict.NONCUSPIDAL:
        why = (
            f"{reduction.kind}: the three joints that place its centre are noncuspidal "
            f"within their limits; {box.why}"
        )
        three = _of_three(nothing, box)
        return replace(three, why=why, kind="reduction", aspects=nothing.aspects)
    if box.verdict is Verdict.CUSPIDAL:
        return _of_wrist(nothing, found, box, literal)
    return None


def box_of(found: Answer, clock: Clock) -> ThreeInBox | None:
    """Three joints within their limits: the arm, or those before a wrist; else None.

    Raises:
        UnableError: of three joints that are the arm, out of reach.
    """
    if found.model.chain.task == "position":
        return decide_three(found.model, clock)
    reduction = found.reduction
    if reduction is None or reduction.regional is None or reduction.kind not in WRISTS:
        return None
    try:
        return decide_three(reduction.regional, clock)
    except TimeLimitError:
        raise
    except (UnableError, RetryableError):
        return None


def with_path(
    result: LimitsAnswer, found: Answer, box: ThreeInBox, literal: Chain
) -> LimitsAnswer:
    """With a path through the cells of the box, of a CUSPIDAL."""
    if box.verdict is not Verdict.CUSPIDAL:
        return result
    chains = (literal, found.model.chain)
    return shown(result, first_proved(paths_of_cells(found, box), chains))


def _of_wrist(
    nothing: LimitsAnswer, found: Answer, box: ThreeInBox, literal: Chain
) -> LimitsAnswer:
    """CUSPIDAL by a path of the three joints that the wrist follows in its limits."""
    assert found.reduction is not None
    chains = (literal, found.model.chain)
    witness = first_proved(paths_of_cells(found, box), chains)
    if witness is None:
        why = (
            f"{found.reduction.kind}: the three joints that place its centre are "
            "cuspidal within their limits, but no wrist was met that follows them and "
            "brings the hand back within its own"
        )
        return replace(nothing, why=why)
    result = replace(
        nothing,
        verdict=Verdict.CUSPIDAL,
        why=f"{found.reduction.kind}: {box.why}, and the wrist follows",
        kind="witness",
        rests_on=("ball arithmetic",),
    )
    return shown(result, witness)


def _of_three(nothing: LimitsAnswer, box: ThreeInBox) -> LimitsAnswer:
    decided = box.verdict is not Verdict.UNDECIDED
    return replace(
        nothing,
        verdict=box.verdict,
        why=box.why,
        kind="exact" if decided else "none",
        rests_on=_EXACT if decided else (),
        aspects=box.aspects,
    )
