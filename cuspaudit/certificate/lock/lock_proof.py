"""The proof of a lock certificate: cuspidal at every value of a locked joint.

For every value d of the lock, counted from what stands in the file, |d| <= half:

1. near the end of the path at d lies exactly one true posture whose pose is that of the
   path's first point at d (`lock_end`);
2. it differs from that first point, modulo 2 pi;
3. det J has the claimed sign on every segment of the path at d (`lock_cover`), and on
   the whole box of the true posture;
4. with limits, the way points at d and that box are inside.

So at every value two postures of one pose are joined by a path with det J != 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from flint import arb

from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.limits_proof import check_box_inside, within
from cuspaudit.certificate.lock.lock_cover import BITS, LockCover
from cuspaudit.certificate.lock.lock_end import LockEnd
from cuspaudit.certificate.lock.locked_path import moving_point
from cuspaudit.certificate.model import LockCertificate

__all__ = ["LockProof"]


@dataclass(slots=True)
class LockProof:
    """The steps of the proof, in order; each raises `Refusal` when it fails.

    Attributes:
        certificate: well formed.
        cover: the boxes that cover its path.
        end: the second postures.
        bits: the working precision.
    """

    certificate: LockCertificate
    cover: LockCover = field(init=False)
    end: LockEnd = field(init=False)
    bits: int = BITS

    def __post_init__(self) -> None:
        """Begin with nothing covered."""
        self.cover = LockCover(self.certificate)
        self.end = LockEnd(self.certificate)

    @property
    def radius(self) -> float | None:
        """Half side of the largest box that holds a second posture, once known."""
        return self.end.radius or None

    @property
    def boxes(self) -> int:
        """Number of boxes that the path was cut into so far."""
        return self.cover.boxes

    def run(self) -> float:
        """Prove all; return a lower bound of sign det J, rounded down."""
        smallest = min(self.end.prove(), self.cover.cover())
        self._check_inside()
        return max(0.0, math.nextafter(float(smallest), -math.inf))

    def _check_inside(self) -> None:
        """Step 4: balls for all values of the lock, the last one with its box."""
        certificate = self.certificate
        with working_precision(self.bits):
            d = arb(0, ball_from_fraction(certificate.lock.half))
            points = [
                moving_point(certificate, k, d) for k in range(len(certificate.path))
            ]
            side = arb(0, self.end.radius)
            points.append([value + side for value in points[-1]])
            for number, point in enumerate(points, 1):
                check_box_inside(certificate, point, f"way point {number}")

    def summary(self) -> str:
        """What `run` has proved, in one sentence."""
        half = math.degrees(float(self.certificate.lock.half))
        sign = ">" if self.certificate.sign > 0 else "<"
        return (
            f"cuspidal at every value of the locked joint within {half:.4g} deg of the "
            "one in the file: two distinct postures of one pose, joined by a path with "
            f"det J {sign} 0{within(self.certificate)}"
        )
