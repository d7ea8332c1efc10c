"""The proof of a certificate, from the file alone.

`verify` proves in ball arithmetic of python-flint, and with nothing of the code that
searched, what a certificate claims of its robot; each kind has a module that proves it
(`path_proof`). A certificate that is not accepted proves nothing about the robot.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Literal

from cuspaudit.certificate.cover import Cover, Refusal
from cuspaudit.certificate.model import (
    Certificate,
    PathCertificate,
    check_certificate,
)
from cuspaudit.certificate.path_proof import PathProof

__all__ = ["Verification", "verify"]


@dataclass(frozen=True, slots=True)
class Verification:
    """What came out of checking a certificate.

    Attributes:
        accepted: whether the claim is proved.
        claim: what the certificate says of its robot.
        reason: one sentence: what was proved, or the first step that failed.
        boxes: number of boxes that the path was cut into, up to the failure.
        smallest: proved lower bound of sign det J on the path and on the end box, at
            least a quarter of the true minimum on the path; None if not accepted.
        radius: half side of the box that holds the true second posture; None if that
            step failed.
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
    match certificate:
        case PathCertificate():
            return _path(certificate)
        case _:
            raise TypeError(f"no kind of certificate: {type(certificate).__name__}")


def _path(certificate: PathCertificate) -> Verification:
    proof = PathProof(certificate, Cover(certificate))
    start = time.perf_counter()
    try:
        _check_claim(certificate)
        smallest, reason = proof.run(), proof.summary()
    except Refusal as refusal:
        smallest, reason = None, str(refusal)
    return Verification(
        accepted=smallest is not None,
        claim="cuspidal",
        reason=reason,
        boxes=proof.cover.boxes,
        smallest=smallest,
        radius=proof.radius,
        bits=max(proof.bits, proof.cover.bits),
        seconds=time.perf_counter() - start,
    )


def _check_claim(certificate: Certificate) -> None:
    """Refuse a claim that goes beyond what is proved here."""
    if certificate.limits is not None:
        raise Refusal("a claim within limits, which this version does not check")
    if certificate.tolerance is not None:
        raise Refusal("a claim over a tolerance, which this version does not check")
