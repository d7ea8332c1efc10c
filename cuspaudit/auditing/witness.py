"""The witness of a cuspidal arm: found in floating point, proved by its certificate."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.certified_robot import certified_robot
from cuspaudit.auditing.search.lift import (
    close,
    lift_position,
    lift_wrist,
    wrist_middle,
    wrist_spread,
)
from cuspaudit.certificate import (
    PathCertificate,
    Verification,
    verify,
)
from cuspaudit.cuspidality.surface_path import SurfacePath, propose_paths
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.robot.chain import Chain, reverse
from cuspaudit.robot.frames import jacobian

__all__ = ["Witness", "certificate_of", "certified", "find_witness"]

Array = NDArray[np.float64]
_TRIES = 8


@dataclass(frozen=True, eq=False)
class Witness:
    """Two postures of one pose, a path between them, and the proof.

    Attributes:
        chain: the chain whose numbers the certificate holds.
        path: (m, n) way points, joint values in chain order; the first and the last
            are the two postures.
        sign: the sign of det J along it.
        clearance: the proved lower bound of |det J| on the path over the largest
            sampled |det J| of the arm; None when that is infinite.
        certificate: what `cuspaudit verify` reads.
        verification: what the checker said; accepted, but for `certified`.
    """

    chain: Chain
    path: Array
    sign: int
    clearance: float | None
    certificate: PathCertificate
    verification: Verification


def find_witness(answer: Answer, chain: Chain) -> Witness:
    """A certified witness for the numbers of ``chain``.

    Args:
        answer: a CUSPIDAL answer with the decision that found couples.
        chain: the literal chain, or the chain of the answer's model.

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


def certified(chain: Chain, path: Array, largest: float | None = None) -> Witness:
    """What the checker says of a closed path; only if it accepts is it a witness.

    Args:
        chain: whose numbers the certificate holds.
        path: as `lift.close` returns it.
        largest: of |det J|, for the clearance; None when it is not known.
    """
    sign = int(np.sign(np.linalg.det(jacobian(chain, path[0]))))
    certificate = certificate_of(chain, sign, path)
    verification = verify(certificate)
    clearance = None
    if largest is not None and verification.smallest is not None:
        clearance = verification.smallest / largest
    return Witness(chain, path, sign, clearance, certificate, verification)


def certificate_of(chain: Chain, sign: int, path: Array) -> PathCertificate:
    """The certificate that states: this path of this chain keeps ``sign`` of det J."""
    points = tuple(tuple(Fraction(repr(float(v))) for v in row) for row in path)
    return PathCertificate(
        **certified_robot(chain),
        sign=1 if sign > 0 else -1,
        postures=(points[0], points[-1]),
        path=points,
    )


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
    answer: Answer, surface_path: SurfacePath, witness: Witness
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
