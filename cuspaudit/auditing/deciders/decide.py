"""One arm decided: the ways to a verdict, one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.carried import carried, refused
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.registry import DECIDERS, EXACT, Decider
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.runtime.clock import Clock, Progress

__all__ = ["answer", "decide"]


def decide(case: Case, clock: Clock, ways: Sequence[Decider] = DECIDERS) -> Answer:
    """What the ways come to, each told what those before it came to.

    What no way decides is UNDECIDED, and so is an arm whose model has not the
    relations of its chain.

    Args:
        case: the arm, and how it is asked.
        clock: counts the time of each way for its stage, and keeps the limit.
        ways: those to try, in this order.

    Raises:
        AssumptionError: a hypothesis fails for this arm (det J vanishes identically,
            or the tip has no angle).
        CrossCheckError: two routes disagree.
    """
    without_model = refused(case.model)
    if without_model is not None:
        return without_model
    for way in ways:
        with clock.stage(way.stage):
            case = replace(case, so_far=way.decide(case, clock) or case.so_far)
    assert case.so_far is not None, "each task has a way that answers"
    return carried(case.so_far)


def answer(
    model: ExactModel, progress: Progress = lambda step: None, engine: str = "auto"
) -> Answer:
    """What exact engines and theorems say of an arm; no path is proved.

    Args:
        model: of a chain of three, four or six joints, a virtual one included.
        progress: called with the name of each step before it runs.
        engine: "routing" has the verdict of Algorithm 1 found again by the second
            route to connectivity; without its agreement there is none. "pairs"
            decides three joints by their pairs of postures [mathematics 6.4].

    Raises:
        AssumptionError: a hypothesis fails for this arm (det J vanishes identically,
            or the tip has no angle).
        CrossCheckError: the two routes disagree.
    """
    case = Case(model, engine=engine, certify=False)
    return decide(case, Clock(progress=progress), EXACT)
