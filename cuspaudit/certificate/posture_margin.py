"""How far a posture is from every singular one: a proved bound, in joint angle.

**Bound.** Let h = det J, p the posture, T > 0, and H >= |D^2 h| on the box of postures
whose joints differ from p's by at most T. For |q - p| = t <= T the segment lies in that
box, so by Taylor

    |h(q)| >= |h(p)| - |grad h(p)| t - H t^2 / 2 >= |h(p)| - |grad h(p)| T - H T^2 / 2.

Where this is positive no posture within T of p is singular. The Frobenius norm of the
matrix of second derivatives is an H; its entries are enclosed over the box by power
series of degree two along e_i and e_i + e_j. Joints on which h does not depend are left
out: a distance over fewer joints is smaller. T is found by halving; each comparison of
balls is true only when it is proved.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import combinations

from flint import arb, arb_series

from cuspaudit.certificate.arm import Arm, arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.model import PathCertificate

__all__ = ["posture_margin"]

_BITS = 64
_WIDEST = 1.5
_HALVINGS = 8


def posture_margin(certificate: PathCertificate) -> float | None:
    """A margin of the first posture, in rad; None for arms that slide, or without one.

    Args:
        certificate: well formed; its claim is not looked at.

    Guarantee: every posture nearer than that to the first one is nonsingular, Euclidean
    over the joints, for the numbers of the certificate.
    """
    if any(joint.kind != "revolute" for joint in certificate.joints):
        return None
    with working_precision(_BITS, 3):
        about = _About(certificate)
        low, high = 0.0, _WIDEST
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if about.is_regular(middle) else (low, middle)
    return low or None


class _About:
    """The neighbourhood of a posture, as wide as is asked."""

    def __init__(self, certificate: PathCertificate) -> None:
        self._arm: Arm[arb_series] = arm_from_certificate(
            certificate, lambda ball: arb_series([ball])
        )
        self._at = [ball_from_fraction(x) for x in certificate.postures[0]]
        everywhere = [x + arb(0, 4) for x in self._at]
        every = range(len(self._at))
        #: the joints on which det J may depend
        self._joints = [
            k for k in every if not self._term(everywhere, (k,), 1).is_zero()
        ]
        self._height = abs(self._term(self._at, (), 0)).lower()
        self._slope = _norm(self._term(self._at, (k,), 1) for k in self._joints)

    def is_regular(self, width: float) -> bool:
        """Whether the bound proves every posture within ``width`` nonsingular."""
        box = [
            x + arb(0, width) if k in self._joints else x
            for k, x in enumerate(self._at)
        ]
        own = {k: 2 * self._term(box, (k,), 2) for k in self._joints}
        mixed = [
            self._term(box, pair, 2) - (own[pair[0]] + own[pair[1]]) / 2
            for pair in combinations(self._joints, 2)
        ]
        bend = _norm([*own.values(), *mixed, *mixed])
        t = arb(width)
        return bool(self._height > self._slope * t + bend * t * t / 2)

    def _term(self, box: Sequence[arb], along: Sequence[int], degree: int) -> arb:
        """A coefficient of det J along the sum of unit vectors, over a box."""
        q = [arb_series([x, 1 if k in along else 0]) for k, x in enumerate(box)]
        value = jacobian_determinant(self._arm, q)
        return arb(0) if value is None else value[degree]


def _norm(entries: Iterable[arb]) -> arb:
    """An upper bound of the Euclidean norm; infinite where an entry is not known."""
    total = sum((abs(x).upper() ** 2 for x in entries), arb(0)).sqrt().upper()
    return total if total.is_finite() else arb(math.inf)
