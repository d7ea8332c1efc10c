"""A six-joint arm that no theorem decides: its witness, searched for, then proved."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import islice

from cuspaudit.auditing.answer import Answer, Reason
from cuspaudit.auditing.case import MOST_POSES, Case
from cuspaudit.auditing.cusp_witness import CuspWitness
from cuspaudit.auditing.evidence import SearchRecord
from cuspaudit.auditing.search.around_cusp import paths_around
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.search.mixed_joints import search_mixed
from cuspaudit.auditing.search.six_joints import search
from cuspaudit.auditing.witness import CertifiedPath, certified
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError
from cuspaudit.robot.chain import Chain
from cuspaudit.runtime.clock import Clock, Progress

__all__ = ["Searched", "by_search", "search_witness"]

_ROUND = 12


@dataclass(frozen=True, eq=False)
class Searched:
    """What a search came to.

    Attributes:
        witness: proved for the numbers of the chain that was searched, or None.
        record: what was tried.
        refused: why the last proposal was refused, "" when there was none.
        largest: the largest |det J| met, in the chain's unit of length cubed.
    """

    witness: CertifiedPath | None
    record: SearchRecord
    refused: str
    largest: float


def by_search(case: Case, clock: Clock) -> Answer | None:
    """CUSPIDAL with a witness proved for the model's numbers, or what was tried."""
    found, chain = case.so_far, case.model.chain
    if found is None or not found.is_open_for(Reason.NO_THEOREM):
        return None
    if chain.task != "pose":
        return None
    result = search_witness(chain, case.seed, clock.step, case.poses)
    record, witness = result.record, result.witness
    postures = found.more_postures(_postures(record))
    if witness is None and found.cusp is not None:
        return _by_cusp(found, found.cusp, record)
    if witness is None:
        why = ", and no witness was met in a search"
        return found.still_open(why, search=record, postures=postures)
    why = f"a search met it in {record.poses} random poses"
    return replace(
        found,
        verdict=Verdict.CUSPIDAL,
        why=why,
        rests_on=("ball arithmetic",),
        engine="search",
        witness=witness,
        postures=postures,
        undecided=None,
        search=record,
    )


def _by_cusp(found: Answer, cusp: CuspWitness, record: SearchRecord) -> Answer:
    """The answer by a cusp, with a path round it where one is proved."""
    found = replace(
        found, search=record, postures=found.more_postures(_postures(record))
    )
    free = [None] * len(cusp.posture)
    for path in islice(paths_around(cusp.chain, cusp.posture, free), _ROUND):
        witness = certified(cusp.chain, path)
        if witness.verification.accepted:
            at = ", ".join(f"{value:.4g}" for value in cusp.posture)
            why = f"the map of its task has a cusp, at ({at}); a path leads round it"
            return replace(found, why=why, witness=witness)
    return found


def search_witness(
    chain: Chain,
    seed: int = 0,
    progress: Progress = lambda step: None,
    most: int = MOST_POSES,
) -> Searched:
    """Search, and prove the widest path that can be proved.

    Args:
        chain: six joints, task "pose".
        seed: of every random choice.
        progress: called with each step; an UnableError it raises ends the search.
        most: random poses to be tried.
    """
    slides = "prismatic" in chain.kinds
    found = (search_mixed if slides else search)(chain, seed, progress, most)
    # with slides |det J| may have no largest value
    largest = None if slides else found.largest
    refused, proved = "", list[CertifiedPath]()
    for proposal in found.proposals:
        try:
            witness = certified(chain, close(chain, proposal.path), largest)
        except RetryableError as unlucky:
            refused = str(unlucky)
            continue
        if witness.verification.accepted:
            proved.append(witness)
        else:
            refused = witness.verification.reason
    best = max(proved, key=lambda witness: witness.clearance or 0.0, default=None)
    return Searched(best, found.record, refused, found.largest)


def _postures(record: SearchRecord) -> Count | None:
    """The most postures that a pose was seen to have."""
    seen = [int(number) for number in record.postures]
    return Count(max(seen), False) if seen else None
