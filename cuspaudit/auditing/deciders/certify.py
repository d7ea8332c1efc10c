"""The couple of an exact run, proved by the certificate of a path between its ends."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

import numpy as np

from cuspaudit.auditing.answer import Answer, Reason, Undecided
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.search.lift import (
    close,
    lift_position,
    lift_wrist,
    wrist_middle,
    wrist_spread,
)
from cuspaudit.auditing.witness import Array, CertifiedPath, certified
from cuspaudit.cuspidality.surface_path import SurfacePath, propose_paths
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.robot.chain import Chain, reverse
from cuspaudit.robot.frames import jacobian
from cuspaudit.runtime.clock import Clock

__all__ = ["by_couple", "find_witness"]

_TRIES = 8


def by_couple(case: Case, clock: Clock) -> Answer | None:
    """A CUSPIDAL of an exact run with its witness, or UNDECIDED.

    Without a path proved for the numbers of the chain there is no CUSPIDAL.
    """
    found = case.so_far
    if found is None or not case.certify or not found.is_exact_run:
        return None
    if found.verdict is not Verdict.CUSPIDAL:
        return None
    clock.step("certificate", always=True)
    try:
        return replace(found, witness=find_witness(found, case.model.chain))
    except UnableError as limit:
        failure = limit
    why = f"there is a cuspidal couple, but its path resists proof: {failure}"
    settle = "a path farther from singular postures"
    return replace(
        found,
        verdict=Verdict.UNDECIDED,
        why=why,
        rests_on=(),
        undecided=Undecided(Reason.UNCERTIFIED, "certificate", why, (), settle),
    )


def find_witness(answer: Answer, chain: Chain) -> CertifiedPath:
    """A certified witness for the numbers of ``chain``.

    Args:
        answer: a CUSPIDAL answer with the decision that found couples.
        chain: the chain of the answer's model, or one with almost its numbers.

    Raises:
        UnableError: no proposed path could be proved for these numbers.
    """
    reason = "no path was proposed"
    for surface_path, path in islice(_lifted(answer), _TRIES):
        try:
            path = close(chain, path)
        except RetryableError as unlucky:
            reason = str(unlucky)
            continue
        witness = certified(chain, path)
        if witness.verification.accepted:
            clearance = _clearance(answer, surface_path, witness)
            return replace(witness, clearance=clearance)
        reason = witness.verification.reason
    raise UnableError("certificate", f"no path could be proved: {reason}")


def _lifted(answer: Answer) -> Iterator[tuple[SurfacePath, Array]]:
    """Proposed paths of all joints, in chain order."""
    decision = answer.decision or answer.by_pairs
    assert decision is not None, "a cuspidal answer has a decision"
    reduction = answer.reduction
    model = answer.model if reduction is None else reduction.regional
    assert model is not None
    for surface_path in propose_paths(decision):
        path = lift_position(model, surface_path)
        if reduction is None:
            yield surface_path, path
            continue
        chain = answer.model.chain
        try:
            if reduction.is_reversed:
                yield surface_path, lift_wrist(reverse(chain), path)[:, ::-1]
            else:
                yield surface_path, lift_wrist(chain, path)
        except RetryableError:
            continue


def _clearance(
    answer: Answer, surface_path: SurfacePath, witness: CertifiedPath
) -> float | None:
    """The proved smallest over the largest |det J|.

    The determinant is a constant times Delta (times the sine of a wrist); the constant
    is read off at the first posture.
    """
    chain, path = witness.chain, witness.path
    smallest = witness.verification.smallest
    largest = surface_path.largest / surface_path.first
    first = abs(float(np.linalg.det(jacobian(chain, path[0]))))
    if answer.reduction is not None:
        if answer.reduction.is_reversed:
            chain, path = reverse(chain), path[:, ::-1]
        first /= wrist_spread(path[0], wrist_middle(chain, path[0, :3]))
    if not np.isfinite(largest) or smallest is None:
        return None
    return smallest / (first * largest)
