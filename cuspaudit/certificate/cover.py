"""det J keeps its sign along a path: boxes that cover every segment.

On the straight segment from the way point a to the way point b put q(s) = a + s (b - a)
and f(s) = sign det J(q(s)), 0 <= s <= 1. For a box of parameters |s - c| <= h, Taylor's
theorem with Lagrange's remainder says

    f(c + t)  in  f_0 + f_1 t + ... + f_(N-1) t^(N-1) + r t^N      for |t| <= h,

where f_k are the Taylor coefficients of f at c, and r encloses the N-th coefficient at
every point of the box. Both come out of det J over power series with ball
coefficients: at c + t for the first, at [c - h, c + h] + t for the second. A box on
which this does not prove f > 0 is halved. A segment is covered when each of its boxes
is proved: no parameter between two way points, or between two boxes, is left out.

A box counts as proved when its bound is more than a quarter of f at its centre. So the
smallest bound m and the true minimum M of f on the path satisfy M / 4 < m <= M.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from flint import arb, arb_series

from cuspaudit.certificate.arm import Arm, arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.model import PathCertificate
from cuspaudit.errors import PrecisionError

__all__ = ["MAX_BOXES", "MAX_DEPTH", "PRECISIONS", "TERMS", "Cover", "Refusal"]

PRECISIONS = (128, 256, 512, 1024)
"""Working precisions in bits, in the order in which they are tried."""
TERMS = 6
"""N: a Taylor polynomial has N terms, and a remainder."""
MAX_BOXES = 200_000
"""A path that needs more boxes is refused as not proved."""
MAX_DEPTH = 60
"""A segment is halved at most so often."""
_CLEAR = 16
"""Relative accuracy in bits that a value must have to be worked with."""


class Refusal(Exception):  # noqa: N818 - not an error but the answer no, on its way up
    """A claim of the certificate is false, or could not be proved."""


@dataclass(slots=True)
class Cover:
    """The boxes that cover the path of one certificate.

    Attributes:
        certificate: well formed.
        boxes: number of boxes looked at so far.
        bits: the highest working precision used.
    """

    certificate: PathCertificate
    boxes: int = 0
    bits: int = PRECISIONS[0]
    _arms: dict[int, Arm[arb_series]] = field(default_factory=dict)

    def cover(self) -> arb:
        """Prove that det J has the claimed sign on the whole path.

        Returns:
            The smallest of the bounds of the boxes: 0 < it <= sign det J.

        Raises:
            Refusal: it has not, or this could not be proved within `MAX_BOXES` boxes,
                `MAX_DEPTH` halvings and the last of `PRECISIONS`; the message names
                the segment and the parameter.
        """
        return min(map(self._segment, range(len(self.certificate.path) - 1)))

    def _segment(self, index: int) -> arb:
        for bits in PRECISIONS:
            self.bits = max(self.bits, bits)
            with working_precision(bits, TERMS + 1):
                if bits not in self._arms:
                    self._arms[bits] = arm_from_certificate(self.certificate, _constant)
                try:
                    return self._boxes(_Segment(self.certificate, index, bits), bits)
                except PrecisionError as error:
                    unclear = error
        raise Refusal(str(unclear))

    def _boxes(self, segment: _Segment, bits: int) -> arb:
        """Cover one segment; the stack holds boxes [k, k + 1] / 2^depth."""
        arm, stack, bounds = self._arms[bits], [(0, 0)], []
        while stack:
            k, depth = stack.pop()
            self.boxes += 1
            if self.boxes > MAX_BOXES:
                raise Refusal(f"{segment.name}: not proved with {MAX_BOXES} boxes")
            centre = Fraction(2 * k + 1, 2 << depth)
            bound = segment.bound(arm, centre, arb(2) ** -(depth + 1))
            if bound is not None:
                bounds.append(bound)
            elif depth < MAX_DEPTH:
                stack += [(2 * k + 1, depth + 1), (2 * k, depth + 1)]
            else:
                raise Refusal(
                    f"could not prove that det J keeps its sign near "
                    f"s = {float(centre):.9g} of {segment.name}"
                )
        return min(bounds)


class _Segment:
    """One straight segment, enclosed at one working precision."""

    def __init__(self, certificate: PathCertificate, index: int, bits: int) -> None:
        a, b = certificate.path[index : index + 2]
        self.name = f"segment {index + 1} of {len(certificate.path) - 1}"
        self.sign, self.bits = certificate.sign, bits
        self.start = [ball_from_fraction(x) for x in a]
        self.step = [ball_from_fraction(y - x) for x, y in zip(a, b, strict=True)]

    def bound(self, arm: Arm[arb_series], centre: Fraction, half: arb) -> arb | None:
        """A positive lower bound of f on |s - centre| <= half; None if none is found.

        Raises:
            Refusal: f is negative at the centre.
            PrecisionError: the sign at the centre is not clear at this precision.
        """
        at = self._expansion(arm, ball_from_fraction(centre))
        where = f"s = {float(centre):.9g} of {self.name}"
        if at[0] < 0:
            raise Refusal(f"det J has the opposite sign at {where}")
        if not at[0] > 0 or at[0].rel_accuracy_bits() < _CLEAR:
            raise PrecisionError(f"the sign of det J at {where}", self.bits)
        box = arb(0, half)
        quarter = at[0] / 4
        if not _value(at, box, arb(0)) > quarter:
            return None
        over = self._expansion(arm, ball_from_fraction(centre) + box)
        bound = _value(at, box, over[TERMS]).lower()
        return bound if bound > quarter else None

    def _expansion(self, arm: Arm[arb_series], s: arb) -> Sequence[arb]:
        """Taylor coefficients 0 to N of f at every parameter in the ball ``s``."""
        q = [
            arb_series([a + s * d, d])
            for a, d in zip(self.start, self.step, strict=True)
        ]
        value = jacobian_determinant(arm, q)
        if value is None:
            return [arb(0)] * (TERMS + 1)
        return [value[k] * self.sign for k in range(TERMS + 1)]


def _constant(ball: arb) -> arb_series:
    return arb_series([ball])


def _value(coefficients: Sequence[arb], t: arb, remainder: arb) -> arb:
    """f_0 + ... + f_(N-1) t^(N-1) + r t^N by Horner's rule."""
    value = remainder
    for coefficient in reversed(coefficients[:TERMS]):
        value = value * t + coefficient
    return value
