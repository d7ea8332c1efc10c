"""The verdict for the numbers exactly as the file has them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.case import HAIR_POSES, Case
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.auditing.deciders.registry import HAIR
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.structure_certificate import structure_certificate
from cuspaudit.auditing.witness import Witness, certified
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import AssumptionError, RetryableError, UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.fixed_motions import is_algebraic
from cuspaudit.robot.snapping import Snapped, faithful
from cuspaudit.robot.virtual_joint import with_virtual_joint
from cuspaudit.runtime.clock import Clock

__all__ = ["AsWritten", "as_written"]

_VISIBLE = 1e-9
"""m and rad: below this no path is wide enough for its certificate."""


@dataclass(frozen=True, eq=False)
class AsWritten:
    """The verdict for a literal chain.

    Attributes:
        verdict: CUSPIDAL with a certificate for its numbers; without one either verdict
            only where their model is exact, or NONCUSPIDAL where the relations of a
            theorem are proved for them.
        witness: its proof, where it is CUSPIDAL by one.
        is_same_path: whether that is the path of the snapped chain.
    """

    verdict: Verdict
    witness: Witness | None = None
    is_same_path: bool = False


def as_written(
    literal: Chain, found: Answer, snapped: Sequence[Snapped], seed: int, clock: Clock
) -> AsWritten:
    """What is known of the literal chain, when its snapped one was decided.

    The path of the snapped chain is tried first. If that is none, another is searched
    where the two differ by more than the noise of doubles.

    Args:
        literal: the chain as the file has it.
        found: the answer for the snapped one.
        snapped: how they differ.
        seed: of every random choice.
        clock: of the audit.
    """
    literal = with_virtual_joint(literal)
    if literal == found.model.chain:
        decided = found.witness is not None or found.model.is_exact
        verdict = found.verdict if decided else _by_structure(literal)
        return AsWritten(verdict, found.witness, True)
    if found.witness is not None:
        same = _on(literal, found.witness)
        if same is not None:
            return AsWritten(Verdict.CUSPIDAL, same, True)
    algebraic = is_algebraic(literal)
    if not algebraic and all(abs(s.difference) < _VISIBLE for s in snapped):
        return AsWritten(_by_structure(literal))
    try:
        if algebraic:
            return _decided(literal, seed, clock)
        witness = _searched(literal, seed, clock)
    except (UnableError, AssumptionError):
        witness = None
    if witness is None:
        return AsWritten(_by_structure(literal))
    return AsWritten(Verdict.CUSPIDAL, witness)


def _decided(literal: Chain, seed: int, clock: Clock) -> AsWritten:
    """The verdict of an exact model of the literal chain."""
    case = Case(exact_model(literal), seed, poses=HAIR_POSES)
    found = decide(case, Clock(clock.left, clock.tell), HAIR)
    return AsWritten(found.verdict, found.witness)


def _searched(literal: Chain, seed: int, clock: Clock) -> Witness | None:
    """A path of the literal chain, searched: of six joints from random poses.

    Of three it is that of a couple of the arm written by its invariants, whose numbers
    are shorter and almost the same.
    """
    if literal.task == "pose" and "prismatic" not in literal.kinds:
        # loaded where it is asked for: most files need no search of their own
        from cuspaudit.auditing.deciders.by_search import search_witness

        return search_witness(literal, seed, clock.step, HAIR_POSES).witness
    case = Case(exact_model(with_virtual_joint(faithful(literal))), seed)
    found = decide(case, Clock(clock.left, clock.tell), HAIR)
    return _on(literal, found.witness) if found.witness is not None else None


def _by_structure(chain: Chain) -> Verdict:
    """NONCUSPIDAL where the relations of a theorem are proved for these numbers."""
    proved = structure_certificate(chain) is not None
    return Verdict.NONCUSPIDAL if proved else Verdict.UNDECIDED


def _on(chain: Chain, witness: Witness) -> Witness | None:
    """The witness for the slightly different numbers of ``chain``, if it is one."""
    if witness.chain == chain:
        return witness
    largest = None
    smallest = witness.verification.smallest
    if witness.clearance and smallest is not None:
        largest = smallest / witness.clearance
    try:
        other = certified(chain, close(chain, witness.path), largest)
    except RetryableError:
        return None
    return other if other.verification.accepted else None
