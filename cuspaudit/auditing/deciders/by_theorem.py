"""Four, five or six joints: a theorem decides, or leads to three [mathematics 6.1]."""

from __future__ import annotations

from dataclasses import replace

from cuspaudit.auditing.answer import Answer, Reason, stopped, undecided
from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.by_tiles import by_tiles
from cuspaudit.auditing.deciders.three_joints import by_all_pairs, by_sample_values
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, RetryableError, UnableError
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.theorems.registry import looked_for, reduction_of
from cuspaudit.kinematics.theorems.theorem import Reduction
from cuspaudit.runtime.clock import Clock

__all__ = ["by_theorem"]


def by_theorem(case: Case, clock: Clock) -> Answer | None:
    """The answer of the first theorem whose hypotheses hold exactly.

    Five joints with a tool axis are six with a virtual one. With the engine "pairs"
    only a theorem that leads to three joints is used: they are decided by their pairs.

    Raises:
        DegenerateMapError: det J vanishes identically.
        NoAngleError: four joints whose axes share no direction.
    """
    if case.model.chain.task == "position":
        return None
    try:
        found = _settled(case, clock)
    except (UnableError, RetryableError) as error:
        found = stopped(case.model, error)
    if case.engine == "pairs" and found.by_pairs is None:
        return _not_asked(case.model)
    return found


def _settled(case: Case, clock: Clock) -> Answer:
    model = case.model
    clock.step("reductions")
    if model.chain.task == "position-and-angle":
        _check_regular(model)
    reduction = _named(model, reduction_of(model))
    if reduction is None:
        _check_regular(model)
        return undecided(
            model,
            Reason.NO_THEOREM,
            "reductions",
            "none of the structures that decide a six-joint arm holds exactly",
            looked_for(model.chain.task),
            f"a witness path, or a theorem on arms {_letters(model)}",
            count_aspects(model),
        )
    if reduction.regional is None:
        return _noncuspidal(model, reduction)
    return _of_six(model, reduction, _of_three(case, reduction.regional, clock))


def _letters(model: ExactModel) -> str:
    """The kinds of the joints, such as PRRRRR."""
    return "".join("P" if kind == "prismatic" else "R" for kind in model.chain.kinds)


def _of_three(case: Case, regional: ExactModel, clock: Clock) -> Answer:
    """The answer for the arm of three joints, by the ways that are for it."""
    case = replace(case, model=regional, so_far=None)
    found = by_sample_values(case, clock)
    found = by_all_pairs(replace(case, so_far=found), clock) or found
    found = by_tiles(replace(case, so_far=found), clock) or found
    assert found is not None, "sample values have an answer"
    return found


def _of_six(model: ExactModel, reduction: Reduction, regional: Answer) -> Answer:
    """What the answer for three joints says of six."""
    if regional.undecided is not None:
        return replace(regional, model=model, aspects=None)
    aspects, postures = _twice(regional.aspects), _twice(regional.postures)
    if regional.verdict is Verdict.CUSPIDAL and not reduction.is_equivalent:
        why = f"{reduction.why}, but they are cuspidal: the theorem says no more"
        settle = "a witness path"
        tried = looked_for(model.chain.task)
        return undecided(
            *(model, Reason.NO_THEOREM, "reductions", why, tried, settle, aspects)
        )
    return replace(
        regional,
        model=model,
        why=f"{reduction.why}; {regional.why}",
        rests_on=("exact tests of the hypotheses", *regional.rests_on),
        reduction=reduction,
        aspects=aspects,
        postures=postures if reduction.is_full else None,
    )


def _twice(regional: Count | None) -> Count | None:
    """The number for the six-joint arm: its wrist has two sides."""
    return replace(regional, count=2 * regional.count) if regional else None


def _check_regular(model: ExactModel) -> None:
    if jacobian_determinant(model) == 0:
        raise DegenerateMapError("det J vanishes at every posture")


def _noncuspidal(model: ExactModel, reduction: Reduction) -> Answer:
    """The answer of a theorem that needs no smaller arm."""
    aspects, postures = reduction.aspects, reduction.postures
    return Answer(
        model,
        Verdict.NONCUSPIDAL,
        reduction.why,
        ("exact tests of the hypotheses",),
        reduction=reduction,
        aspects=Count(aspects, True) if aspects else count_aspects(model),
        postures=Count(postures, True) if postures else None,
    )


def _named(model: ExactModel, reduction: Reduction | None) -> Reduction | None:
    """The reduction, saying which axis no joint of the robot turns about."""
    if reduction is None or not model.chain.joints[-1].is_virtual:
        return reduction
    number = len(model.joints)
    why = f"with the tool axis as axis {number} (a virtual joint), {reduction.why}"
    return replace(reduction, why=why)


def _not_asked(model: ExactModel) -> Answer:
    """The answer before the pairs of an arm have been looked at."""
    _check_regular(model)
    return undecided(
        model,
        Reason.PAIRS_ASKED,
        "pairs",
        "pairs prove no arm noncuspidal that does not reduce to three joints",
        (),
        "another engine, or a proof that no maximum over pairs was missed",
        count_aspects(model),
    )
