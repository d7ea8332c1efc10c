"""The least move of one axis that makes it parallel, square or meet the one before.

In a link the axis before stays, and the next one moves by a shift and a tilt about its
place. What is least is the larger of shift over reach and angle of the tilt. A move
that is a shift alone, or no more tilt than the angle asks for, is preferred to a
mixture unless that is nearer by more than a twentieth: it is what a drawing would say.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cuspaudit.kinematics.nearest.links import Link, Vector

__all__ = ["PREFERRED", "Move", "meeting", "nearer", "parallel", "square_and_meeting"]

PREFERRED = 1.05
"""How many times as far a plain move may be as a mixture, and still be preferred."""
_NOTHING = 1e-14
_BISECTIONS = 50


@dataclass(frozen=True, eq=False)
class Move:
    """A link whose next axis has moved.

    Attributes:
        length: how far its place moved, in the chain's unit.
        angle: by how much it turned, in rad.
        link: the link with it.
    """

    length: float
    angle: float
    link: Link

    def size(self, reach: float) -> float:
        """The larger of length over reach and angle."""
        return max(self.length / reach, self.angle)


def parallel(link: Link) -> Move:
    """Tilt the next axis until it is parallel to the axis, or opposite to it."""
    u, w = link.axis, link.next
    sign = 1.0 if u @ w > 0 else -1.0
    angle = _angle_between(u, sign * w)
    return Move(0.0, angle, link.with_step(link.step, sign * u))


def meeting(link: Link, reach: float) -> Move:
    """Move the next axis until it lies in one plane with the axis.

    Let delta be the angle, seen along the axis, from the next axis to its place. The
    distance of the two lines is r sin(delta), r that of the place from the axis. A tilt
    by epsilon turns the next axis nearer by at most the angle t with
    sin(epsilon) = sin(alpha) sin(t), alpha the angle of the axes: it is the height of a
    right spherical triangle. Then a shift by r sin(delta - t) is left.
    """
    sine = float(np.linalg.norm(np.cross(link.axis, link.next)))
    return _turned_and_shifted(
        link,
        reach,
        tilt=lambda t: math.asin(min(1.0, sine * math.sin(t))),
        slope=lambda t: _slope(link, t),
    )


def square_and_meeting(link: Link, reach: float) -> Move:
    """Move the next axis until it meets the axis at a right angle.

    As for `meeting`, but the next axis ends across the axis: a turn by t is then a tilt
    by epsilon with cos(epsilon) = sin(alpha) cos(t).
    """
    sine = float(np.linalg.norm(np.cross(link.axis, link.next)))
    cosine = float(link.axis @ link.next)
    return _turned_and_shifted(
        link,
        reach,
        # of which this is the form without a loss of digits where epsilon is small
        tilt=lambda t: math.atan2(
            math.hypot(cosine, sine * math.sin(t)), sine * math.cos(t)
        ),
        slope=lambda t: 0.0,
    )


def nearer(plain: list[Move], mixture: Move, reach: float) -> Move:
    """The nearest of the plain moves, unless the mixture is nearer by a twentieth."""
    best = min(plain, key=lambda move: move.size(reach))
    much = best.size(reach) > PREFERRED * mixture.size(reach)
    return mixture if much else best


def _turned_and_shifted(
    link: Link,
    reach: float,
    tilt: Callable[[float], float],
    slope: Callable[[float], float],
) -> Move:
    """Turn the next axis by some t about the axis, and shift it the rest of the way.

    Args:
        link: the link.
        reach: of the arm.
        tilt: the angle between the next axis and where a turn by t takes it.
        slope: its cosine with the axis after that turn.
    """
    u = link.axis
    out = link.step - (link.step @ u) * u
    side = link.next - (link.next @ u) * u
    radius = float(np.linalg.norm(out))
    if radius < _NOTHING * reach:
        out, radius = side, 0.0
    if float(np.linalg.norm(side)) < _NOTHING:
        side = out
    if float(np.linalg.norm(side)) < _NOTHING:
        side = np.cross(u, np.eye(3)[int(np.argmin(np.abs(u)))])
        out = side
    if out @ side < 0:
        out = -out
    turn = math.atan2(float(u @ np.cross(side, out)), float(side @ out))
    whole = abs(turn)

    def left(t: float) -> float:
        return radius * math.sin(whole - t)

    def moved(t: float) -> Move:
        towards = _rotated(u, side / np.linalg.norm(side), math.copysign(t, turn))
        cosine = slope(t)
        following = cosine * u + math.sqrt(max(0.0, 1 - cosine * cosine)) * towards
        normal = np.cross(u, towards)
        shift = -(link.step @ normal) * normal
        return Move(
            float(np.linalg.norm(shift)),
            tilt(t),
            link.with_step(link.step + shift, following),
        )

    plain = [moved(0.0), moved(whole)]
    if reach * tilt(0.0) >= left(0.0):
        return plain[0]
    low, high = 0.0, whole
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        if reach * tilt(middle) < left(middle):
            low = middle
        else:
            high = middle
    return nearer(plain, moved(high), reach)


def _slope(link: Link, t: float) -> float:
    """The cosine of the angle of the axes after the least tilt that turns by t."""
    cosine = float(link.axis @ link.next)
    across = float(np.linalg.norm(np.cross(link.axis, link.next))) * math.cos(t)
    return cosine / math.hypot(cosine, across)


def _angle_between(a: Vector, b: Vector) -> float:
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b))


def _rotated(axis: Vector, vector: Vector, angle: float) -> Vector:
    """A vector across ``axis``, turned about it."""
    turned = math.cos(angle) * vector + math.sin(angle) * np.cross(axis, vector)
    return np.asarray(turned, dtype=np.float64)
