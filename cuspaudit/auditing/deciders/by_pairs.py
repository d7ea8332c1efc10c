"""What the pairs of postures say of an arm: a proved witness, or evidence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cuspaudit.auditing.answer import Answer, Reason
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.evidence import PairMaximum, PairRecord
from cuspaudit.auditing.search.aspect_routing import AspectRouting, route_aspects
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.search.pair_maxima import pair_maxima
from cuspaudit.auditing.witness import CertifiedPath, certified
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import jacobian
from cuspaudit.runtime.clock import Clock

__all__ = ["by_pair_maxima"]

_TRIES = 4


def by_pair_maxima(case: Case, clock: Clock) -> Answer | None:
    """CUSPIDAL with a witness proved along a maximum over pairs, or what was met.

    None where the time was up, or floating point failed, before anything was met.
    """
    found, chain = case.so_far, case.model.chain
    if found is None:
        return None
    asked = (Reason.OUT_OF_REACH,) if case.engine == "pairs" else ()
    if not found.is_open_for(Reason.NO_THEOREM, Reason.PAIRS_ASKED, *asked):
        return None
    if "prismatic" in chain.kinds or chain.task not in ("position", "pose"):
        return None
    try:
        record = pair_maxima(case.model, case.seed, clock.step)
        together = record.together > 0
        witness = _proved(case.model, record) if together else None
    except UnableError:
        return None
    if witness is None:
        return found.still_open(f"; {_sentence(record)}", pairs=record)
    return replace(
        found,
        verdict=Verdict.CUSPIDAL,
        why=_sentence(record),
        rests_on=("ball arithmetic",),
        engine="pairs",
        witness=witness,
        undecided=None,
        pairs=record,
    )


def _sentence(record: PairRecord) -> str:
    if not record.pairs:
        return "no pair of postures of one pose and one sign of det J was met"
    return (
        f"{record.pairs} pairs of postures of one pose climbed to {len(record.maxima)} "
        f"maxima of |det J det J'|, of which {record.together} have both ends in one "
        "aspect"
    )


def _proved(model: ExactModel, record: PairRecord) -> CertifiedPath | None:
    """The certified path of the highest maximum that has one."""
    routing = route_aspects(model, record.seed)
    together = [found for found in record.maxima if found.together]
    for maximum in together[:_TRIES]:
        witness = _witness(routing, model.chain, maximum)
        if witness is not None:
            return witness
    return None


def _witness(
    routing: AspectRouting, chain: Chain, maximum: PairMaximum
) -> CertifiedPath | None:
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
