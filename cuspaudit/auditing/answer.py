"""The exact answer for a chain: which theorem or run of Algorithm 1 gives it."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace

from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.auditing.deciders.by_pigeonhole import Crowd
from cuspaudit.auditing.search.pair_maxima import PairRecord
from cuspaudit.auditing.search.six_joints import SearchRecord
from cuspaudit.count import Count
from cuspaudit.cuspidality.decision import Decision, decide
from cuspaudit.cuspidality.pair_decision import PairDecision, decide_pairs
from cuspaudit.cuspidality.surface_decision import SurfaceDecision, decide_surface
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    CrossCheckError,
    DegenerateMapError,
    RetryableError,
    UnableError,
)
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import jacobian_determinant, reduced_map
from cuspaudit.kinematics.theorems.registry import (
    LOOKED_FOR,
    Reduction,
    reduce_four_joints,
    reduce_six_joints,
)
from cuspaudit.surface.cusps import cusps
from cuspaudit.surface.nodes import nodes

__all__ = ["Answer", "Progress", "Undecided", "answer"]

Progress = Callable[[str], None]

_EXACT = ("FLINT resultants", "FLINT root isolation", "exact signs")
_BY_PAIRS = ("FLINT resultants", "FLINT root isolation", "ball arithmetic")


@dataclass(frozen=True)
class Undecided:
    """Why there is no verdict.

    Attributes:
        step: the routine that stopped.
        why: what it could not do.
        looked_for: the structures that were tested and not found.
        would_settle: what would give a verdict.
        search: what a search for a witness tried, if there was one.
        pairs: what the pairs of postures say, if they were looked at.
    """

    step: str
    why: str
    looked_for: tuple[str, ...]
    would_settle: str
    search: SearchRecord | None = None
    pairs: PairRecord | None = None


@dataclass(frozen=True, eq=False)
class Answer:
    """The answer of the exact engine for one exact model.

    Attributes:
        model: what it is about.
        verdict: one of three.
        why: one sentence.
        rests_on: what the verdict rests on.
        reduction: the theorem that was applied, if any.
        decision: the run of Algorithm 1, if there was one.
        by_pairs: the decision by pairs of postures, if that was made instead.
        aspects: of the arm; None when not computed.
        postures: the largest number of postures of a regular pose; None likewise.
        cusps: of the curve of critical values, of a three-joint arm.
        nodes: of the same.
        undecided: set exactly when the verdict is UNDECIDED.
        search: the search that found the witness of a CUSPIDAL answer, if one did.
        pairs: the pairs that led to the witness, if they did.
        crowd: a pose that proves the arm of the model cuspidal, if one was met.
        confirmed: whether the routing gave the same verdict and count of aspects.
    """

    model: ExactModel
    verdict: Verdict
    why: str
    rests_on: tuple[str, ...] = ()
    reduction: Reduction | None = None
    decision: SurfaceDecision | None = None
    by_pairs: PairDecision | None = None
    aspects: Count | None = None
    postures: Count | None = None
    cusps: Count | None = None
    nodes: Count | None = None
    undecided: Undecided | None = None
    search: SearchRecord | None = None
    pairs: PairRecord | None = None
    crowd: Crowd | None = None
    confirmed: bool = False


def answer(
    model: ExactModel, progress: Progress = lambda step: None, engine: str = "auto"
) -> Answer:
    """Decide a chain whose task has as many dimensions as it has joints.

    A three-joint position task runs Algorithm 1 on the reduced map [DESIGN 5], or is
    decided by its pairs of postures where that is unable; a six-joint pose task is
    reduced to one, or settled by a theorem, when it can be [DESIGN 6.1]. Five joints
    with a tool axis are six with a virtual one; four with a position and an angle are
    settled by a theorem. What is out of reach is UNDECIDED.

    Args:
        model: of a chain of three, four or six joints, a virtual one included.
        progress: called with the name of each step before it runs.
        engine: "routing" has the verdict of Algorithm 1 found again by the second
            route to connectivity; without its agreement there is none. "pairs"
            decides three joints by their pairs of postures [DESIGN 6.4].

    Raises:
        AssumptionError: a hypothesis fails for this arm (det J vanishes identically,
            or the tip has no angle).
        CrossCheckError: the two routes disagree.
    """
    three = _by_pairs if engine == "pairs" else _three_joints
    try:
        match model.chain.task:
            case "position":
                found = three(model, progress)
            case "position-and-angle":
                found = _four_joints(model, progress)
            case _:
                found = _six_joints(model, progress, three)
        if engine == "routing" and found.decision is not None:
            return _confirmed(found, found.decision, progress)
        return found
    except UnableError as limit:
        return _undecided(model, limit.step, str(limit), (), "a more general engine")
    except RetryableError as unlucky:
        settle = "more bits, or another chart"
        return _undecided(model, "precision", str(unlucky), (), settle)


def _three_joints(model: ExactModel, progress: Progress) -> Answer:
    variety, mapping = reduced_map(model)
    try:
        decision = decide_surface(variety, mapping, progress)
    except UnableError:
        with suppress(UnableError):
            return _by_pairs(model, progress)
        raise
    progress("cusps and nodes")
    return Answer(
        model,
        decision.verdict,
        _sentence(decision),
        _EXACT,
        decision=decision,
        aspects=Count(decision.aspects, True),
        postures=Count(decision.max_postures, True),
        cusps=cusps(decision.roadmap, mapping, decision.delta),
        nodes=nodes(decision.fibers, decision.roadmap, mapping),
    )


def _by_pairs(model: ExactModel, progress: Progress) -> Answer:
    decision = decide_pairs(*reduced_map(model), progress)
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
    return Answer(
        model,
        decision.verdict,
        why,
        _BY_PAIRS,
        by_pairs=decision,
        aspects=Count(decision.aspects, True),
    )


def _confirmed(found: Answer, surface: SurfaceDecision, progress: Progress) -> Answer:
    """The answer, with the routing's agreement on the arm that decides."""
    regional = found.reduction.regional if found.reduction else found.model
    assert regional is not None, "there was a run of Algorithm 1"
    routed: Decision = decide(*reduced_map(regional), "routing", progress=progress)
    if routed.failure is not None:
        raise routed.failure
    own = (surface.verdict, surface.aspects)
    if (routed.verdict, routed.components) != own:
        raise CrossCheckError(
            f"the roadmap says {own[0].value} with {own[1]} aspects, the routing "
            f"{routed.verdict.value} with {routed.components}; please report this arm"
        )
    rests_on = tuple(dict.fromkeys((*found.rests_on, *routed.rests_on)))
    return replace(found, rests_on=rests_on, confirmed=True)


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


def _four_joints(model: ExactModel, progress: Progress) -> Answer:
    progress("reductions")
    _check_regular(model)
    return _noncuspidal(model, reduce_four_joints(model))


def _six_joints(
    model: ExactModel,
    progress: Progress,
    three: Callable[[ExactModel, Progress], Answer],
) -> Answer:
    progress("reductions")
    reduction = _named(model, reduce_six_joints(model))
    if reduction is None:
        _check_regular(model)
        return _undecided(
            model,
            "reductions",
            "none of the structures that decide a six-joint arm holds exactly",
            LOOKED_FOR,
            "a witness path, or an exact count of the aspects of a general 6R arm",
            aspects=count_aspects(model),
        )
    if reduction.regional is None:
        return _noncuspidal(model, reduction)
    regional = three(reduction.regional, progress)
    aspects, postures = _twice(regional.aspects), _twice(regional.postures)
    if regional.verdict is Verdict.CUSPIDAL and not reduction.is_equivalent:
        why = f"{reduction.why}, and they are: the theorem says no more"
        settle = "a witness path"
        return _undecided(model, "reductions", why, LOOKED_FOR, settle, aspects)
    return Answer(
        model,
        regional.verdict,
        f"{reduction.why}; {regional.why}",
        ("exact tests of the hypotheses", *regional.rests_on),
        reduction,
        regional.decision,
        regional.by_pairs,
        aspects,
        postures if reduction.is_full else None,
        regional.cusps,
        regional.nodes,
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
        reduction,
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


def _undecided(
    model: ExactModel,
    step: str,
    why: str,
    looked_for: tuple[str, ...],
    settle: str,
    aspects: Count | None = None,
) -> Answer:
    reason = Undecided(step, why, looked_for, settle)
    return Answer(model, Verdict.UNDECIDED, why, aspects=aspects, undecided=reason)
