"""det J keeps its sign along a path, for every robot that the play allows.

On a piece of a segment, |s - c| <= h, and for play p let f(s, p) = sign det J. Along a
straight way from (c, none) to (s, p), with play that grows in proportion,

    f(s, p)  >=  f(c, none) - h sup |df/ds| - sup |df/dp|,

the suprema over the whole piece and all play (`loose_slopes`). df/ds is the sum of the
slopes by the joint values times the steps of the segment. A piece on which this is not
clearly positive is halved; where it is not at a point alone, halving does not help.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from flint import arb

from cuspaudit.certificate.arm import Arm, arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.cover import MAX_BOXES, MAX_DEPTH, Refusal
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.loose.loose_arm import LooseArm, loose_arm
from cuspaudit.certificate.loose.loose_slopes import slopes_at
from cuspaudit.certificate.loose.play import without_play
from cuspaudit.certificate.model import PathCertificate

__all__ = ["BITS", "LooseCover"]

_CLEAR = 1 / 64
"""A bound is good when it is more than this part of what det J is without play."""
BITS = 64
"""Play is far wider than what is rounded away at this precision."""


@dataclass(slots=True)
class LooseCover:
    """The pieces that cover the path of a certificate with play.

    Attributes:
        certificate: well formed.
        boxes: number of pieces looked at so far.
        bits: the working precision.
    """

    certificate: PathCertificate
    boxes: int = 0
    bits: int = BITS
    _arms: list[tuple[Arm[arb], LooseArm]] = field(default_factory=list)

    def cover(self) -> arb:
        """A lower bound of sign det J on the path, for every robot; it is positive.

        Raises:
            Refusal: naming the segment and its parameter.
        """
        with working_precision(self.bits):
            still = arm_from_certificate(without_play(self.certificate), arb)
            self._arms = [(still, loose_arm(self.certificate))]
            path = self.certificate.path
            return min(
                self._segment(f"segment {k} of {len(path) - 1}", a, b)
                for k, (a, b) in enumerate(pairwise(path), 1)
            )

    def _segment(self, name: str, a: Sequence[Fraction], b: Sequence[Fraction]) -> arb:
        step = [y - x for x, y in zip(a, b, strict=True)]
        stack, bounds = [(0, 0)], []
        while stack:
            k, depth = stack.pop()
            self.boxes += 1
            if self.boxes > MAX_BOXES:
                raise Refusal(f"{name}: not proved with {MAX_BOXES} boxes")
            middle, half = Fraction(2 * k + 1, 2 << depth), Fraction(1, 2 << depth)
            centre = [x + middle * d for x, d in zip(a, step, strict=True)]
            bound = self._bound(centre, [half * d for d in step])
            if bound > 0:
                bounds.append(bound)
                continue
            if (
                depth >= MAX_DEPTH
                or not self._bound(centre, [Fraction(0)] * len(a)) > 0
            ):
                raise Refusal(
                    "could not prove that det J keeps its sign for every robot near "
                    f"s = {float(middle):.9g} of {name}"
                )
            stack += [(2 * k + 1, depth + 1), (2 * k, depth + 1)]
        return min(bounds)

    def _bound(self, centre: Sequence[Fraction], reach: Sequence[Fraction]) -> arb:
        """A lower bound of f on the postures centre + t reach, |t| <= 1."""
        ((still, loose),) = self._arms
        at = [ball_from_fraction(x) for x in centre]
        value = jacobian_determinant(still, at)
        if value is None:
            return arb(0)
        way = [ball_from_fraction(x) for x in reach]
        box = [x + arb(0, abs(d).upper()) for x, d in zip(at, way, strict=True)]
        slopes = slopes_at(loose, box)
        along = sum((x * d for x, d in zip(slopes.by_joint, way, strict=True)), arb(0))
        height = value * self.certificate.sign
        bound = (height - abs(along).upper() - slopes.by_play).lower()
        return bound if bound > height * _CLEAR else arb(0)
