"""Three joints that turn, with a position: the verdict and the aspects alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cuspaudit.auditing.answer import Answer, Reason
from cuspaudit.auditing.case import Case
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.runtime.clock import Clock, time_at_least

if TYPE_CHECKING:
    from cuspaudit.cuspidality.tile_decision import TileDecision

__all__ = ["by_tiles"]

_RESTS_ON = ("FLINT root isolation", "exact signs", "ball arithmetic")
_SECONDS = 0.5
"""That tiles have, though the time limit has passed."""


def by_tiles(case: Case, clock: Clock) -> Answer | None:
    """Verdict and aspects by tiles of pairs of postures [mathematics 6.4].

    Asked where the verdict alone is, and where sample values were out of reach or out
    of time: tiles take some hundredths of a second. None where some stay open, or where
    they find a couple and a path between its ends is asked for.

    Raises:
        DegenerateMapError: det J vanishes identically.
    """
    model = case.model
    if model.chain.task != "position" or model.chain.kinds != ("revolute",) * 3:
        return None
    if case.engine != "auto" or not _is_asked(case):
        return None
    from cuspaudit.cuspidality.tile_decision import decide_by_tiles

    try:
        with time_at_least(_SECONDS):
            found = _tiled(model, decide_by_tiles(*reduced_map(model)))
    except (UnableError, RetryableError):
        return None
    needs_path = case.certify and found.verdict is Verdict.CUSPIDAL
    return None if needs_path else found


def _is_asked(case: Case) -> bool:
    if case.so_far is None:
        return case.verdict_alone and not case.certify
    return case.so_far.is_open_for(Reason.OUT_OF_REACH, Reason.TIME_LIMIT)


def _tiled(model: ExactModel, decision: TileDecision) -> Answer:
    if decision.couple is not None:
        why = "two postures of one pose, proved in ball arithmetic, lie in one aspect"
    elif decision.tiles:
        why = (
            f"in each of {decision.tiles} tiles of pairs of postures of one pose, the "
            f"two lie in different ones of the {decision.aspects} aspects"
        )
    else:
        why = (
            "up to turns of joint 1 one coordinate of the position depends on one "
            "joint alone, which tells the postures of a pose apart"
        )
    return Answer(
        model,
        decision.verdict,
        why,
        _RESTS_ON,
        "tiles",
        by_tiles=decision,
        aspects=Count(decision.aspects, True),
    )
