"""The witness of a cuspidal arm: found in floating point, proved by its certificate."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.proofs.certified_robot import certified_robot
from cuspaudit.certificate import (
    Limits,
    PathCertificate,
    Verification,
    verify,
)
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import jacobian

__all__ = ["CertifiedPath", "certificate_of", "certified"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class CertifiedPath:
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


def certified(
    chain: Chain,
    path: Array,
    largest: float | None = None,
    limits: Limits | None = None,
) -> CertifiedPath:
    """What the checker says of a closed path; only if it accepts is it a witness.

    Args:
        chain: whose numbers the certificate holds.
        path: as `lift.close` returns it.
        largest: of |det J|, for the clearance; None when it is not known.
        limits: with them the claim is one within them.
    """
    sign = int(np.sign(np.linalg.det(jacobian(chain, path[0]))))
    certificate = certificate_of(chain, sign, path, limits)
    verification = verify(certificate)
    clearance = None
    if largest is not None and verification.smallest is not None:
        clearance = verification.smallest / largest
    return CertifiedPath(chain, path, sign, clearance, certificate, verification)


def certificate_of(
    chain: Chain, sign: int, path: Array, limits: Limits | None = None
) -> PathCertificate:
    """The certificate that states: this path of this chain keeps ``sign`` of det J."""
    points = tuple(tuple(Fraction(repr(float(v))) for v in row) for row in path)
    return PathCertificate(
        **certified_robot(chain),
        limits=limits,
        sign=1 if sign > 0 else -1,
        postures=(points[0], points[-1]),
        path=points,
    )
