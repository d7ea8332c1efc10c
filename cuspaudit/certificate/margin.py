"""How far a witness path stays from singular postures: a proved bound, in joint angle.

**Bound.** Cut the path into straight pieces and let T > 0. Let m <= |det J| on a piece
and G >= |grad det J| on the box of postures whose joints differ from those of the piece
by at most T. If q lies within T of a point p of the piece, the segment from p to q
stays in that box, so

    |det J(q)| >= |det J(p)| - G T >= m - G T.

When this is positive for every piece of a cover of the path, no posture within T of the
path is singular. With the centre c of a piece and c + h, c - h its ends, m is
|det J(c)| less the largest |D det J . h| on the piece. Joints on which det J does not
depend (the first, the last, a virtual one) are left out of boxes, lengths and
distances: a distance over fewer joints is smaller, so what is proved with it holds with
all.

det J and its partial derivatives are enclosed in ball arithmetic, the derivatives by
power series in one joint at a time over the whole box. T is guessed from points of
the path: G of a width is a G of every smaller width, so that m / G is allowed where it
is smaller; and it is lowered until a cover is found. A comparison of balls is true
only when it is proved.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from flint import arb, arb_series

from cuspaudit.certificate.arm import Arm, arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.model import PathCertificate

__all__ = ["margin_of"]

_BITS = 64
_SAMPLES = 9
"""Points of each segment from which the margin is guessed."""
_WIDEST = Fraction(1, 2)
_ROUNDS = 3
"""How often a width at a point is refined."""
_TRIES = 12
_MOST_PIECES = 600

Point = tuple[Fraction, ...]


def margin_of(certificate: PathCertificate) -> float | None:
    """A margin of the path, in rad; None for arms that slide, or where none is proved.

    Args:
        certificate: an accepted one, well formed.

    Guarantee: every posture nearer than that to a point of the path is nonsingular,
    for the numbers of the certificate.
    """
    if any(joint.kind != "revolute" for joint in certificate.joints):
        return None
    with working_precision(_BITS, 2):
        tube = _Tube(certificate)
        margin = tube.guess() * Fraction(9, 10)
        for _ in range(_TRIES):
            if margin > 0 and tube.is_regular(margin):
                return float(margin) * (1 - 2.0**-40)  # not above, though rounded
            margin = margin * Fraction(3, 4)
    return None


class _Tube:
    """The neighbourhood of a path, as wide as is asked."""

    def __init__(self, certificate: PathCertificate) -> None:
        self._arm: Arm[arb_series] = arm_from_certificate(
            certificate, lambda ball: arb_series([ball])
        )
        self._segments = list(pairwise(certificate.path))
        start = [ball_from_fraction(x) for x in certificate.path[0]]
        everywhere = [x + arb(0, 4) for x in start]
        partial = (self._partial(everywhere, k) for k in range(len(start)))
        #: the joints on which det J may depend
        self._joints = [k for k, slope in enumerate(partial) if slope is not None]

    def guess(self) -> Fraction:
        """A width that points of the path allow."""
        width = _WIDEST
        for a, b in self._segments:
            ends = list(zip(a, b, strict=True))
            for i in range(_SAMPLES):
                part = Fraction(i, _SAMPLES - 1)
                width = self._allowed(tuple(x + (y - x) * part for x, y in ends), width)
        return width

    def is_regular(self, width: Fraction) -> bool:
        """Whether every posture within ``width`` of the path is proved nonsingular."""
        waiting, seen = list(self._segments), 0
        while waiting:
            a, b = waiting.pop()
            seen += 1
            if self._is_regular_about(a, b, width):
                continue
            middle = tuple((x + y) / 2 for x, y in zip(a, b, strict=True))
            if seen >= _MOST_PIECES:
                return False
            waiting += [(a, middle), (middle, b)]
        return True

    def _allowed(self, point: Point, widest: Fraction) -> Fraction:
        """A large width up to ``widest`` that the bound allows about a point."""
        low, high = Fraction(0), widest
        for _ in range(_ROUNDS):
            height, slope = self._height_and_slope(point, point, high)
            if height > slope * ball_from_fraction(high):
                return high
            allowed = float((height / slope).mid())
            if math.isfinite(allowed):  # else det J is not bounded so far about it
                low = max(low, Fraction(allowed))
            high = (low + high) / 2
        return low

    def _is_regular_about(self, a: Point, b: Point, width: Fraction) -> bool:
        """Whether the bound proves all within ``width`` of the piece from a to b."""
        height, slope = self._height_and_slope(a, b, width)
        return bool(height > slope * ball_from_fraction(width))

    def _height_and_slope(self, a: Point, b: Point, width: Fraction) -> tuple[arb, arb]:
        """The m of the piece from a to b, and G within ``width`` of it."""
        ends = list(zip(a, b, strict=True))
        centre = [ball_from_fraction((x + y) / 2) for x, y in ends]
        halves = [ball_from_fraction((y - x) / 2) for x, y in ends]
        reach = ball_from_fraction(width)
        box = [
            x + arb(0, (abs(half) + reach).upper())
            for x, half in zip(centre, halves, strict=True)
        ]
        slopes = (self._partial(box, k) for k in self._joints)
        slope = _norm([value for value in slopes if value is not None])
        return self._least(centre, halves), slope

    def _least(self, centre: Sequence[arb], halves: Sequence[arb]) -> arb:
        """A lower bound of |det J| on a piece, from its centre and its half."""
        value = jacobian_determinant(self._arm, [arb_series([x]) for x in centre])
        if value is None:
            return arb(0)
        least = abs(value[0]).lower()
        if not any(halves):
            return least
        piece = [
            arb_series([x + arb(0, abs(half).upper()), half])
            for x, half in zip(centre, halves, strict=True)
        ]
        along = jacobian_determinant(self._arm, piece)
        return least if along is None else (least - abs(along[1])).lower()

    def _partial(self, box: Sequence[arb], joint: int) -> arb | None:
        """The derivative of det J by one joint over a box; None if it is exactly 0."""
        q = [arb_series([x, 1 if k == joint else 0]) for k, x in enumerate(box)]
        value = jacobian_determinant(self._arm, q)
        return None if value is None or value[1] == 0 else value[1]


def _norm(vector: Sequence[arb]) -> arb:
    """An upper bound of the Euclidean norm."""
    # a square of a ball round 0 may reach below 0, where there is no root
    return sum((abs(x).upper() ** 2 for x in vector), arb(0)).sqrt().upper()
