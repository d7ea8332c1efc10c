"""Three joints that turn, with a position, where the verdict alone is asked for."""

from __future__ import annotations

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.case import Case
from cuspaudit.count import Count
from cuspaudit.cuspidality.tile_decision import TileDecision, decide_by_tiles
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.runtime.clock import Clock

__all__ = ["by_tiles"]

_RESTS_ON = ("FLINT root isolation", "exact signs", "ball arithmetic")


def by_tiles(case: Case, clock: Clock) -> Answer | None:
    """Verdict and aspects by tiles of pairs of postures [mathematics 6.4].

    None where more is asked for, and where some tiles stay open: the complete engines
    come next.

    Raises:
        DegenerateMapError: det J vanishes identically.
    """
    model = case.model
    if not case.verdict_alone or case.certify or case.engine != "auto":
        return None
    if model.chain.task != "position" or model.chain.kinds != ("revolute",) * 3:
        return None
    try:
        return _tiled(model, decide_by_tiles(*reduced_map(model), clock.step))
    except (UnableError, RetryableError):
        return None


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
