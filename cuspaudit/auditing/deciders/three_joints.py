"""Three joints with a position: Algorithm 1 on the reduced map, or pairs of postures.

Both are exact and complete where they come to an end.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from cuspaudit.auditing.answer import Answer, Reason, stopped
from cuspaudit.auditing.case import Case
from cuspaudit.count import Count
from cuspaudit.cuspidality.surface_decision import SurfaceDecision, decide_surface
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import CrossCheckError, RetryableError, UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.runtime.clock import Clock
from cuspaudit.surface.cusps import cusps
from cuspaudit.surface.nodes import nodes

if TYPE_CHECKING:
    from cuspaudit.cuspidality.pair_decision import PairDecision

__all__ = ["by_all_pairs", "by_sample_values"]

_EXACT = ("FLINT resultants", "FLINT root isolation", "exact signs")
_BY_PAIRS = ("FLINT resultants", "FLINT root isolation", "ball arithmetic")


def by_sample_values(case: Case, clock: Clock) -> Answer | None:
    """Algorithm 1: postures of a value in every cell, by their aspects [mathematics 5].

    With the engine "routing" the second route to connectivity has to agree; without
    its agreement there is no verdict.

    Raises:
        CrossCheckError: the two routes disagree.
        DegenerateMapError: det J vanishes identically.
    """
    if case.model.chain.task != "position" or case.engine == "pairs":
        return None
    if case.so_far is not None and case.so_far.is_settled:
        return None
    try:
        found, decision = _sampled(case.model, clock)
    except (UnableError, RetryableError) as error:
        return stopped(case.model, error)
    if case.engine != "routing":
        return found
    try:
        return _confirmed(found, decision, clock)
    except (UnableError, RetryableError) as error:
        answer = stopped(case.model, error)
        assert answer.undecided is not None
        reason = replace(answer.undecided, reason=Reason.UNCONFIRMED)
        return replace(answer, undecided=reason)


def _sampled(model: ExactModel, clock: Clock) -> tuple[Answer, SurfaceDecision]:
    variety, mapping = reduced_map(model)
    decision = decide_surface(variety, mapping, clock.step)
    clock.step("cusps and nodes")
    found = Answer(
        model,
        decision.verdict,
        _sentence(decision),
        _EXACT,
        "roadmap",
        decision=decision,
        aspects=Count(decision.aspects, True),
        postures=Count(decision.max_postures, True),
        cusps=cusps(decision.roadmap, mapping, decision.delta),
        nodes=nodes(decision.fibers, decision.roadmap, mapping),
    )
    return found, decision


def _confirmed(found: Answer, surface: SurfaceDecision, clock: Clock) -> Answer:
    """The answer, with the routing's agreement."""
    from cuspaudit.cuspidality.decision import decide

    routed = decide(*reduced_map(found.model), "routing", progress=clock.step)
    if routed.failure is not None:
        raise routed.failure
    own = (surface.verdict, surface.aspects)
    if (routed.verdict, routed.components) != own:
        raise CrossCheckError(
            f"the roadmap says {own[0].value} with {own[1]} aspects, the routing "
            f"{routed.verdict.value} with {routed.components}; please report this arm"
        )
    rests_on = tuple(dict.fromkeys((*found.rests_on, *routed.rests_on)))
    return replace(found, rests_on=rests_on, engine="routing")


def _sentence(decision: SurfaceDecision) -> str:
    count = len(decision.samples)
    if decision.verdict is Verdict.CUSPIDAL:
        return (
            f"of {count} sample values, one in every cell of regular poses, some have "
            "two postures in one aspect"
        )
    return (
        f"the postures of {count} sample values, one in every cell of regular poses, "
        f"lie in different ones of the {decision.aspects} aspects"
    )


def by_all_pairs(case: Case, clock: Clock) -> Answer | None:
    """A pair of postures from every component of pairs [mathematics 6.4].

    Asked by the engine "pairs", and where sample values were out of reach.

    Raises:
        DegenerateMapError: det J vanishes identically.
    """
    if case.model.chain.task != "position":
        return None
    left_open = Reason.OUT_OF_REACH, Reason.TIME_LIMIT
    asked = case.engine == "pairs" and case.so_far is None
    if not asked and (case.so_far is None or not case.so_far.is_open_for(*left_open)):
        return None
    from cuspaudit.cuspidality.pair_decision import decide_pairs

    try:
        return _paired(case.model, decide_pairs(*reduced_map(case.model), clock.step))
    except (UnableError, RetryableError) as error:
        return stopped(case.model, error) if asked else None


def _paired(model: ExactModel, decision: PairDecision) -> Answer:
    count, together = len(decision.pairs), len(decision.couples)
    if decision.sheets is None:
        why = (
            "up to turns and slides of joint 1 one coordinate of the position depends "
            "on one joint alone, which tells the postures of a pose apart"
        )
    else:
        why = (
            f"of {count} pairs of postures of one pose, one in every component of "
            f"pairs that may lie in one aspect, {together or 'none'} "
            f"{'does' if together == 1 else 'do'}"
        )
    aspects = Count(decision.aspects, True)
    return Answer(
        model,
        decision.verdict,
        why,
        _BY_PAIRS,
        "pairs",
        by_pairs=decision,
        aspects=aspects,
    )
