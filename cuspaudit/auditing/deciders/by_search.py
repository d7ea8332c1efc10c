"""A six-joint arm that no theorem decides: its witness, searched for, then proved.

Two postures of one pose in one aspect prove it cuspidal too, without a path.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from cuspaudit.auditing.answer import Answer, Progress
from cuspaudit.auditing.deciders.by_pigeonhole import Crowd, crowded_pose
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.search.six_joints import SearchRecord, search
from cuspaudit.auditing.witness import Witness, certified
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.robot.chain import Chain

__all__ = [
    "HAIR_POSES",
    "Searched",
    "crowd_of",
    "needs_search",
    "search_witness",
    "searched",
    "with_crowd",
]

MOST = 192
HAIR_POSES = 64
"""Random poses for an arm that rounding alone may have made cuspidal."""


@dataclass(frozen=True, eq=False)
class Searched:
    """What a search came to.

    Attributes:
        witness: proved for the numbers of the chain that was searched, or None.
        record: what was tried.
        refused: why the last proposal was refused, "" when there was none.
        largest: the largest |det J| met, in the chain's unit of length cubed.
    """

    witness: Witness | None
    record: SearchRecord
    refused: str
    largest: float


def needs_search(found: Answer) -> bool:
    """Whether no theorem decided this six-joint arm."""
    undecided, chain = found.undecided, found.model.chain
    return (
        undecided is not None
        and undecided.step == "reductions"
        and chain.task == "pose"
        and chain.kinds == ("revolute",) * 6
    )


def crowd_of(
    found: Answer, seed: int = 0, progress: Progress = lambda step: None
) -> Crowd | None:
    """A pose with two postures in one aspect, exactly; None when none was met.

    A model that only comes near the arm is not asked: it would speak of another arm.

    Args:
        found: an answer that `needs_search`.
        seed: of the poses looked at.
        progress: called with the step.
    """
    if not found.model.is_exact:
        return None
    try:
        progress("pigeon-hole")
        return crowded_pose(found.model, seed)
    except UnableError:
        return None


def with_crowd(found: Answer, crowd: Crowd | None) -> Answer:
    """The answer with the pose that proves it; CUSPIDAL by it if it was undecided."""
    if crowd is None:
        return found
    found = replace(found, crowd=crowd)
    if found.verdict is Verdict.CUSPIDAL:
        return found
    return replace(
        found,
        verdict=Verdict.CUSPIDAL,
        why=f"{crowd.sentence()}; no path between them was proved",
        rests_on=crowd.grounds,
        undecided=None,
    )


def searched(
    found: Answer,
    literal: Chain,
    seed: int = 0,
    progress: Progress = lambda step: None,
    most: int = MOST,
) -> tuple[Answer, Witness | None]:
    """CUSPIDAL with a witness proved for the model's numbers, or what was tried.

    Args:
        found: an answer that `needs_search`.
        literal: the chain as the file has it. The witness returned is for it where
            the same path is one, else for the chain of the model.
        seed: of every random choice.
        progress: called with each step; an UnableError it raises ends the search.
        most: random poses to be tried.
    """
    assert found.undecided is not None
    chain = found.model.chain
    result = search_witness(chain, seed, progress, most)
    if result.witness is None:
        why = f"{found.undecided.why}, and no witness was met in a search"
        reason = replace(found.undecided, why=why, search=result.record)
        postures = _postures(result.record)
        return replace(found, why=why, postures=postures, undecided=reason), None
    why = f"a search met it in {result.record.poses} random poses"
    witness = result.witness
    if chain != literal:
        other = _same_path(witness, literal, result.largest)
        witness = other or witness
        why += ", and proved it for the snapped numbers" if other else ""
    cuspidal = replace(
        found,
        verdict=Verdict.CUSPIDAL,
        why=why,
        postures=_postures(result.record),
        undecided=None,
        search=result.record,
    )
    return cuspidal, witness


def search_witness(
    chain: Chain,
    seed: int = 0,
    progress: Progress = lambda step: None,
    most: int = MOST,
) -> Searched:
    """Search, and prove the widest path that can be proved.

    Args:
        chain: six revolute joints, task "pose".
        seed: of every random choice.
        progress: called with each step; an UnableError it raises ends the search.
        most: random poses to be tried.
    """
    found = search(chain, seed, progress, most)
    refused, proved = "", list[Witness]()
    for proposal in found.proposals:
        try:
            witness = certified(chain, close(chain, proposal.path), found.largest)
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


def _same_path(witness: Witness, chain: Chain, largest: float) -> Witness | None:
    """The witness for the slightly different numbers of ``chain``, if it is one."""
    try:
        other = certified(chain, close(chain, witness.path), largest)
    except RetryableError:
        return None
    return other if other.verification.accepted else None
