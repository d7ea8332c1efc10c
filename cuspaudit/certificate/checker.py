"""The proof of a certificate, from the file alone.

`verify` proves in ball arithmetic of python-flint, and with nothing of the code that
searched, what a certificate claims of its robot; each kind has a module that proves it
(`path_proof`, `cusp_proof`, `pairs_proof`, `structure_proof`). A certificate that is
not accepted proves nothing about the robot.
"""

from __future__ import annotations

import time
from dataclasses import asdict, dataclass
from typing import Any, Literal, Protocol

from cuspaudit.certificate.cover import Cover, Refusal
from cuspaudit.certificate.model import (
    Certificate,
    CuspCertificate,
    LockCertificate,
    PairsCertificate,
    PathCertificate,
    StructureCertificate,
    is_loose,
)
from cuspaudit.certificate.well_formed import check_certificate

__all__ = ["KindProof", "Verification", "verify"]


@dataclass(frozen=True, slots=True)
class Verification:
    """What came out of checking a certificate.

    Attributes:
        accepted: whether the claim is proved.
        claim: what the certificate says of its robot.
        reason: one sentence: what was proved, or the first step that failed.
        boxes: number of boxes that the path, or the pairs, were cut into, up to the
            failure; 0 without boxes.
        smallest: proved lower bound of sign det J on the path and on the end box, at
            least a quarter of the true minimum on the path; of a structure, of |det J|
            at the regular posture; of a cusp, of |k . grad(k . grad det J)|; None if
            not accepted.
        radius: half side of the box that holds the true second posture, or the cusp;
            None if that step failed.
        bits: the highest working precision used.
        seconds: wall clock time.
    """

    accepted: bool
    claim: Literal["cuspidal", "noncuspidal"]
    reason: str
    boxes: int
    smallest: float | None
    radius: float | None
    bits: int
    seconds: float

    @property
    def why(self) -> str:
        """The reason, by the name it has in every result."""
        return self.reason

    def to_dict(self) -> dict[str, Any]:
        """What came out, as JSON has it."""
        return asdict(self)


class KindProof(Protocol):
    """The proof of a certificate of one kind.

    Attributes:
        bits: the highest working precision used so far.
    """

    bits: int

    @property
    def boxes(self) -> int:
        """Number of boxes looked at so far."""

    @property
    def radius(self) -> float | None:
        """Half side of the box that holds what is proved to be there, once known."""

    def run(self) -> float:
        """Prove all; return the lower bound that `Verification` calls smallest.

        Raises:
            Refusal: at the first step that fails.
        """

    def summary(self) -> str:
        """What `run` has proved, in one sentence."""


def verify(certificate: Certificate) -> Verification:
    """Prove or refuse ``certificate``.

    Args:
        certificate: as read by `read_certificate`, or built.

    Returns:
        ``accepted`` only with a proof. A refusal names the step, and for the path
        the segment (counted from 1) and the parameter on it.

    Raises:
        InvalidCertificateError: the certificate is not well formed.
    """
    check_certificate(certificate)
    start = time.perf_counter()
    proof = _proof(certificate)
    try:
        _check_claim(certificate)
        smallest, reason = proof.run(), proof.summary()
    except Refusal as refusal:
        smallest, reason = None, str(refusal)
    is_no = isinstance(certificate, StructureCertificate | PairsCertificate)
    return Verification(
        accepted=smallest is not None,
        claim="noncuspidal" if is_no else "cuspidal",
        reason=reason,
        boxes=proof.boxes,
        smallest=smallest,
        radius=proof.radius,
        bits=proof.bits,
        seconds=time.perf_counter() - start,
    )


def _proof(certificate: Certificate) -> KindProof:
    """The proof of this kind; the modules of the others are not loaded."""
    match certificate:
        case PathCertificate():
            from cuspaudit.certificate.path_proof import PathProof

            if not is_loose(certificate):
                return PathProof(certificate, Cover(certificate))
            from cuspaudit.certificate.loose.loose_cover import LooseCover

            return PathProof(certificate, LooseCover(certificate))
        case LockCertificate():
            from cuspaudit.certificate.lock.lock_proof import LockProof

            return LockProof(certificate)
        case CuspCertificate():
            from cuspaudit.certificate.cusp_proof import CuspProof

            return CuspProof(certificate)
        case PairsCertificate():
            from cuspaudit.certificate.pairs.pairs_proof import PairsProof

            return PairsProof(certificate)
        case StructureCertificate():
            from cuspaudit.certificate.structure.structure_proof import StructureProof

            return StructureProof(certificate)
    raise TypeError(f"no kind of certificate: {type(certificate).__name__}")


def _check_claim(certificate: Certificate) -> None:
    """Refuse a claim that goes beyond what is proved here."""
    proved = PathCertificate | CuspCertificate | PairsCertificate
    if is_loose(certificate) and not isinstance(certificate, proved):
        raise Refusal("a claim about more than one robot, which is not checked here")
