"""The certificate of pairs of a noncuspidal arm of three joints.

Where over a value of joint 3 det J has one sign for all values of joint 2, no path of
the other sign passes. Such values come in intervals, found in floating point: the
middle of each is written down. Whether they part the aspects, the checker says.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import groupby

import numpy as np

from cuspaudit.auditing.proofs.certified_robot import certified_robot, regular_posture
from cuspaudit.certificate import PairsCertificate, verify
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import jacobian

__all__ = ["pairs_certificate"]

_STEPS = 720
"""Values of joint 3 that are looked at: one each half degree."""


def pairs_certificate(chain: Chain) -> PairsCertificate | None:
    """A proved certificate that ``chain`` is noncuspidal, or None.

    Args:
        chain: of three joints, task "position".
    """
    if "prismatic" in chain.kinds:
        return None
    certificate = PairsCertificate(
        **certified_robot(chain),
        parting=tuple(_parting(chain)),
        regular=regular_posture(chain),
    )
    return certificate if verify(certificate).accepted else None


def _parting(chain: Chain) -> Iterator[Fraction]:
    """The middle of every interval of joint 3 over which det J has one sign only."""
    values = [2 * math.pi * k / _STEPS for k in range(_STEPS)]
    signs = [_only_sign(chain, value) for value in values]
    start = next((k for k in range(_STEPS) if signs[k] != signs[k - 1]), 0)
    turned = [(start + k) % _STEPS for k in range(_STEPS)]
    for sign, run in groupby(turned, lambda k: signs[k]):
        if sign:
            indices = list(run)
            middle = values[indices[len(indices) // 2]]
            yield Fraction(f"{middle:.3f}")


def _only_sign(chain: Chain, third: float) -> int:
    """The one sign of det J = P c2 + Q s2 + S over a value of joint 3, else 0."""
    zero, half, quarter = (
        float(np.linalg.det(jacobian(chain, [0.0, second, third])))
        for second in (0.0, math.pi, math.pi / 2)
    )
    middle = (zero + half) / 2
    swing = math.hypot((zero - half) / 2, quarter - middle)
    return int(np.sign(middle)) if abs(middle) > 1.01 * swing else 0
