"""What the pairs of postures say of an arm: a proved witness, or evidence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cuspaudit.auditing.answer import Answer, Progress, Undecided
from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.auditing.search.aspect_routing import AspectRouting, route_aspects
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.search.pair_maxima import PairMaximum, PairRecord, pair_maxima
from cuspaudit.auditing.witness import Witness, certified
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, RetryableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import jacobian_determinant
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import jacobian

__all__ = ["needs_pairs", "not_asked", "searched_pairs"]

_TRIES = 4


def not_asked(model: ExactModel) -> Answer:
    """The answer before the pairs of an arm have been looked at.

    Raises:
        DegenerateMapError: det J vanishes identically.
    """
    if jacobian_determinant(model) == 0:
        raise DegenerateMapError("det J vanishes at every posture")
    why = "pairs prove no arm noncuspidal that does not reduce to three joints"
    settle = "another engine, or a proof that no maximum over pairs was missed"
    reason = Undecided("pairs", why, (), settle)
    aspects = count_aspects(model)
    return Answer(model, Verdict.UNDECIDED, why, aspects=aspects, undecided=reason)


def needs_pairs(found: Answer) -> bool:
    """Whether this arm is undecided, and pairs may tell more."""
    undecided, chain = found.undecided, found.model.chain
    return (
        undecided is not None
        and undecided.step in ("reductions", "pairs")
        and "prismatic" not in chain.kinds
        and chain.task in ("position", "pose")
    )


def searched_pairs(
    found: Answer, literal: Chain, seed: int, progress: Progress
) -> tuple[Answer, Witness | None]:
    """CUSPIDAL with a witness proved along a maximum over pairs, or what was met.

    Args:
        found: an answer that `needs_pairs`.
        literal: the chain as the file has it; the witness is for it, or else for the
            chain of the model.
        seed: of every random choice.
        progress: called with each step; an UnableError it raises ends the search.
    """
    assert found.undecided is not None
    record = pair_maxima(found.model, seed, progress)
    witness = _proved(found.model, literal, record) if record.together else None
    if witness is None:
        why = f"{found.undecided.why}; {_sentence(record)}"
        reason = replace(found.undecided, why=why, pairs=record)
        return replace(found, why=why, undecided=reason), None
    cuspidal = replace(
        found,
        verdict=Verdict.CUSPIDAL,
        why=_sentence(record),
        undecided=None,
        pairs=record,
    )
    return cuspidal, witness


def _sentence(record: PairRecord) -> str:
    if not record.pairs:
        return "no pair of postures of one pose and one sign of det J was met"
    return (
        f"{record.pairs} pairs of postures of one pose climbed to {len(record.maxima)} "
        f"maxima of |det J det J'|, of which {record.together} have both ends in one "
        "aspect"
    )


def _proved(model: ExactModel, literal: Chain, record: PairRecord) -> Witness | None:
    """The certified path of the highest maximum that has one."""
    routing = route_aspects(model, record.seed)
    together = [found for found in record.maxima if found.together]
    for chain in dict.fromkeys((literal, model.chain)):
        for maximum in together[:_TRIES]:
            witness = _witness(routing, chain, maximum)
            if witness is not None:
                return witness
    return None


def _witness(
    routing: AspectRouting, chain: Chain, maximum: PairMaximum
) -> Witness | None:
    first, second = (np.array(end) for end in maximum.postures)
    way = routing.widest_path(first, second)
    if way is None:
        return None
    height = abs(float(routing.routing.function(routing.on_torus(first))))
    unit = abs(float(np.linalg.det(jacobian(chain, first)))) / height
    try:
        path = close(chain, way.points)
    except RetryableError:
        return None
    witness = certified(chain, path, unit * routing.routing.largest)
    return witness if witness.verification.accepted else None
