"""Values of joints inside the limits of a certificate.

Limits are open intervals of joint values, ends never identified. A path runs straight
between its way points, and a product of intervals is convex: the path is inside when
its way points are, which are rational numbers and compared as such. Of a true posture
that is known in a box the whole box must be inside.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb

from cuspaudit.certificate.balls import ball_from_fraction
from cuspaudit.certificate.cover import Refusal
from cuspaudit.certificate.model import Certificate, Posture, printable

__all__ = ["check_box_inside", "check_way_points", "within"]


def within(certificate: Certificate) -> str:
    """What a summary adds of a claim within limits."""
    return "" if certificate.limits is None else ", inside the joint limits"


def _check_virtual(certificate: Certificate) -> None:
    """Refuse limits of a joint that no motor makes: the claim is not about it."""
    limits = certificate.limits
    if limits and certificate.task == "position-and-axis" and limits[-1] is not None:
        raise Refusal("the last joint is virtual and cannot have limits: give null")


def check_way_points(certificate: Certificate, path: Sequence[Posture]) -> None:
    """Refuse a way point at or beyond a limit; numbers are compared exactly."""
    if certificate.limits is None:
        return
    _check_virtual(certificate)
    for number, point in enumerate(path, 1):
        for joint, value, pair in zip(
            certificate.joints, point, certificate.limits, strict=True
        ):
            if pair is not None and not pair[0] < value < pair[1]:
                raise Refusal(
                    f"way point {number} is not inside the limits of "
                    f"{printable(joint.name)}"
                )


def check_box_inside(certificate: Certificate, box: Sequence[arb], what: str) -> None:
    """Refuse a box of joint values that is not proved to be inside the limits."""
    if certificate.limits is None:
        return
    _check_virtual(certificate)
    for joint, ball, pair in zip(
        certificate.joints, box, certificate.limits, strict=True
    ):
        if pair is None:
            continue
        low, high = map(ball_from_fraction, pair)
        if not low < ball < high:
            raise Refusal(
                f"{what} is not proved to be inside the limits of "
                f"{printable(joint.name)}"
            )
