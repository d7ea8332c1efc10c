"""The structures near an audited arm, with the verdict of the arm that has each.

The theorems settle most nearest arms alone: a pattern that is noncuspidal by itself,
and a spherical wrist or shoulder whose three joints have parallel or meeting
neighbours. For the nearest of the others Algorithm 1 is given half a second; the
verdict of the rest is left open. None of it says anything of the robot, unless the
structure holds.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.auditing.proofs.structure_certificate import structure_certificate
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.nearest.nearest_structures import (
    AxisMove,
    NearStructure,
    nearest_structures,
)
from cuspaudit.kinematics.regular import is_regular_somewhere
from cuspaudit.kinematics.theorems.neighbouring_axes import (
    aspects_of_parallel_axes,
    neighbouring_axes,
)
from cuspaudit.kinematics.theorems.registry import reduction_of
from cuspaudit.robot.distance_text import distance_text, structure_words
from cuspaudit.runtime.clock import check_time, seconds_left, time_limit
from cuspaudit.runtime.own_process import run_in_own_process

__all__ = ["JudgedStructure", "near_structures", "why_undecided"]

_SECONDS = 0.5


@dataclass(frozen=True)
class JudgedStructure:
    """A structure that decides, and how far the audited arm is from having it.

    Attributes:
        name: of the structure.
        holds: whether the arm has it exactly.
        length: the largest shift of an axis that a nearest arm with it needs.
        angle: the largest tilt of an axis that it needs, in rad.
        unit: of lengths.
        verdict: of that arm; None where it was not settled.
        aspects: of that arm; None where they are not counted.
        way: how its axes stand.
        moves: the axes that move.
    """

    name: str
    holds: bool
    length: float
    angle: float
    unit: str
    verdict: Verdict | None
    aspects: int | None
    way: str
    moves: tuple[AxisMove, ...]

    def record(self) -> dict[str, Any]:
        """As JSON."""
        verdict = None if self.verdict is None else self.verdict.value
        moves = [asdict(move) for move in self.moves]
        return {**asdict(self), "verdict": verdict, "moves": moves}


def near_structures(found: Answer) -> tuple[JudgedStructure, ...]:
    """The structures near the arm of an answer, nearest first."""
    judged = []
    is_asked = False
    for near in nearest_structures(found.model):
        check_time("structures")
        if near.holds and _is_sure(near):
            judged.append(_structure(near, found.verdict, found.aspects, holds=True))
        elif is_regular_somewhere(near.model):
            if _is_settled(near):
                verdict, aspects = Verdict.NONCUSPIDAL, _aspects(near)
                judged.append(_structure(near, verdict, aspects))
            else:
                decided = None if is_asked else _decided(near)
                is_asked = True
                judged.append(decided or _structure(near, None, _aspects(near)))
    return tuple(judged)


def why_undecided(model: ExactModel) -> str | None:
    """Which settled structure an undecided arm is nearest to; None without any."""
    for near in nearest_structures(model):
        if is_regular_somewhere(near.model) and _is_settled(near):
            away = distance_text(near.length, near.angle, model.chain.unit)
            return f"{away} from {structure_words(near.name)}, noncuspidal"
    return None


def _structure(
    near: NearStructure,
    verdict: Verdict | None,
    aspects: Count | None,
    *,
    holds: bool = False,
) -> JudgedStructure:
    return JudgedStructure(
        near.name,
        holds,
        near.length,
        near.angle,
        near.model.chain.unit,
        verdict,
        aspects.count if aspects and aspects.proved else None,
        near.way,
        near.moves,
    )


def _decided(near: NearStructure) -> JudgedStructure | None:
    """As Algorithm 1 has it, for the three joints; None if that takes too long.

    The numbers of a nearest arm are long, and one call of a kernel with them may take
    many times what is allowed: it is made where it can be ended.
    """
    left = seconds_left()
    seconds = _SECONDS if left is None else min(_SECONDS, left)
    try:
        verdict, aspects = run_in_own_process(
            lambda step: _verdict_and_aspects(near.model, seconds), timeout=seconds
        )
    except UnableError:
        return None
    return None if verdict is None else _structure(near, verdict, aspects)


def _verdict_and_aspects(
    model: ExactModel, seconds: float
) -> tuple[Verdict | None, Count | None]:
    with time_limit(seconds):
        found = answer(model, check_time)
    known = found.verdict is not Verdict.UNDECIDED
    return found.verdict if known else None, found.aspects


def _is_sure(near: NearStructure) -> bool:
    """Whether the arm itself has the structure, and not only a model within 1e-12."""
    if near.model.is_exact:
        return True
    proof = structure_certificate(near.model.chain, near.name)
    return proof is not None and proof.theorem == near.name


def _is_settled(near: NearStructure) -> bool:
    """Whether a theorem alone says that the arm is noncuspidal."""
    regional = near.reduction.regional
    return regional is None or neighbouring_axes(regional) is not None


def _aspects(near: NearStructure) -> Count | None:
    """Counted on the three joints, where the arm has a wrist or shoulder."""
    if len(near.model.joints) == 3:
        return _aspects_of_three(near.model)
    # a triple and a pair may be a wrist and two others
    found = near.reduction if near.reduction.regional else reduction_of(near.model)
    if found is None or found.regional is None:
        known = near.reduction.aspects
        return Count(known, True) if known else count_aspects(near.model)
    regional = _aspects_of_three(found.regional)
    return Count(2 * regional.count, regional.proved) if regional else None


def _aspects_of_three(model: ExactModel) -> Count | None:
    known = None
    if set(model.chain.kinds) == {"revolute"}:
        known = aspects_of_parallel_axes(model)
    return Count(known, True) if known else count_aspects(model)
