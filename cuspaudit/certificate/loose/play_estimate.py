"""How much play a path may stand, to first order: which of many paths to try first.

The slopes of det J by play are taken at points of the path, and the spread of the
second postures for next to no play. Nothing is decided here: balls prove it, or do not.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

from flint import arb

from cuspaudit.certificate.arm import Arm, arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.loose.loose_arm import LooseArm, loose_arm
from cuspaudit.certificate.loose.loose_cover import BITS
from cuspaudit.certificate.loose.loose_posture import second_postures
from cuspaudit.certificate.loose.loose_slopes import slopes_at
from cuspaudit.certificate.loose.play import without_play
from cuspaudit.certificate.model import PathCertificate

__all__ = ["estimated_room"]

_STEP = 0.05
_MOST_POINTS = 24
_SHARE = 0.6
"""About this part of what a path stands to first order is proved."""
_SPREAD = 0.05
"""About so far (rad) second postures may lie apart for their proof to go through."""


def estimated_room(certificate: PathCertificate) -> float:
    """About how many times its play a path may be proved for; 0 for not at all.

    Args:
        certificate: well formed, with next to no play.
    """
    with working_precision(BITS):
        arm = loose_arm(certificate)
        still = arm_from_certificate(without_play(certificate), arb)
        heights = [_room_at(still, arm, point) for point in _points(certificate)]
        first, last = (
            [ball_from_fraction(x) for x in row] for row in certificate.postures
        )
        box = second_postures(arm, first, last)
    if box is None or not box.radius:
        return 0.0
    room = _SHARE * min(height * certificate.sign for height in heights)
    return min(room, _SPREAD / box.radius)


def _room_at(still: Arm[arb], arm: LooseArm, point: list[Fraction]) -> float:
    """Det J over the most that it changes by the play of ``arm``."""
    q = [ball_from_fraction(x) for x in point]
    value = jacobian_determinant(still, q)
    height = 0.0 if value is None else float(value.mid())
    return height / max(float(slopes_at(arm, q).by_play), 1e-300)


def _points(certificate: PathCertificate) -> list[list[Fraction]]:
    """Points of the path, near enough to each other."""
    found = []
    for a, b in pairwise(certificate.path):
        length = max(abs(float(y - x)) for x, y in zip(a, b, strict=True))
        count = min(_MOST_POINTS, 2 + int(length / _STEP))
        for k in range(count):
            share = Fraction(k, count - 1)
            found.append([x + share * (y - x) for x, y in zip(a, b, strict=True)])
    return found
