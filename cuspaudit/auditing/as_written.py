"""The verdict for the numbers exactly as the file has them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.case import HAIR_POSES, Case
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.auditing.deciders.registry import HAIR
from cuspaudit.auditing.proofs.structure_certificate import structure_certificate
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.witness import CertifiedPath, certified
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import AssumptionError, RetryableError, UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.fixed_motions import is_algebraic
from cuspaudit.robot.snapping import Snapped, faithful
from cuspaudit.robot.virtual_joint import with_virtual_joint
from cuspaudit.runtime.clock import Clock

if TYPE_CHECKING:
    from cuspaudit.auditing.cusp_witness import CuspWitness

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
        cusp: its proof, where it is CUSPIDAL by one and no path was proved.
    """

    verdict: Verdict
    witness: CertifiedPath | None = None
    is_same_path: bool = False
    cusp: CuspWitness | None = None

    @property
    def cusp_sentence(self) -> str | None:
        """Where the cusp is, for a verdict that no path shows; else None."""
        if self.cusp is None or self.witness is not None:
            return None
        at = ", ".join(f"{value:.4g}" for value in self.cusp.posture)
        return f"by a cusp of its map, proved, at ({at})"


def as_written(
    literal: Chain, found: Answer, snapped: Sequence[Snapped], seed: int, clock: Clock
) -> AsWritten:
    """What is known of the literal chain, when its snapped one was decided.

    The path of the snapped chain is tried first. If that is none, another is searched
    where the two differ by more than the noise of doubles, and then a cusp.

    Args:
        literal: the chain as the file has it.
        found: the answer for the snapped one.
        snapped: how they differ.
        seed: of every random choice.
        clock: of the audit.
    """
    literal = with_virtual_joint(literal)
    if literal == found.model.chain:
        proofs = (found.witness, found.cusp)
        decided = found.model.is_exact or any(proof is not None for proof in proofs)
        verdict = found.verdict if decided else _by_structure(literal)
        return AsWritten(verdict, found.witness, True, found.cusp)
    if found.witness is not None:
        same = _on(literal, found.witness)
        if same is not None:
            return AsWritten(Verdict.CUSPIDAL, same, True)
    algebraic = is_algebraic(literal)
    if not algebraic and all(abs(s.difference) < _VISIBLE for s in snapped):
        return _same_cusp(literal, found) or AsWritten(_by_structure(literal))
    try:
        if algebraic:
            return _decided(literal, seed, clock)
        witness = _searched(literal, seed, clock)
    except (UnableError, AssumptionError):
        witness = None
    if witness is not None:
        return AsWritten(Verdict.CUSPIDAL, witness)
    by_cusp = _same_cusp(literal, found)
    verdict = _by_structure(literal) if by_cusp is None else Verdict.CUSPIDAL
    if verdict is Verdict.UNDECIDED:
        by_cusp = _by_cusp(literal, seed)
    return by_cusp or AsWritten(verdict)


def _same_cusp(literal: Chain, found: Answer) -> AsWritten | None:
    """CUSPIDAL by the cusp of the snapped chain, where the literal one has it too."""
    if found.cusp is None:
        return None
    from cuspaudit.auditing.cusp_witness import same_cusp

    cusp = same_cusp(found.cusp, literal)
    return None if cusp is None else AsWritten(Verdict.CUSPIDAL, cusp=cusp)


def _by_cusp(literal: Chain, seed: int) -> AsWritten | None:
    """CUSPIDAL by a cusp that a search meets, inside limits or not."""
    if literal.task not in ("position", "pose"):
        return None
    from cuspaudit.auditing.cusp_witness import find_cusps

    try:
        cusp = next(find_cusps(literal, seed, inside=False), None)
    except UnableError:
        return None
    return None if cusp is None else AsWritten(Verdict.CUSPIDAL, cusp=cusp)


def _decided(literal: Chain, seed: int, clock: Clock) -> AsWritten:
    """The verdict of an exact model of the literal chain."""
    case = Case(exact_model(literal), seed, poses=HAIR_POSES)
    found = decide(case, Clock(clock.left, clock.tell), HAIR)
    return AsWritten(found.verdict, found.witness, cusp=found.cusp)


def _searched(literal: Chain, seed: int, clock: Clock) -> CertifiedPath | None:
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


def _on(chain: Chain, witness: CertifiedPath) -> CertifiedPath | None:
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
