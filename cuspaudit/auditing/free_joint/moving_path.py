"""A witness path that follows the value of a lock, in floating point.

The first posture and the shape of the path stay; the second posture is followed by
Newton's method, and its place as a function of the lock's value becomes a parabola. The
other way points go along, each by its share of the path's length. Nothing is decided
here: what is proposed is proved, or refused, by its certificate.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.proofs.certified_robot import certified_robot
from cuspaudit.auditing.search.lift import close
from cuspaudit.certificate import Limits
from cuspaudit.certificate.model import Lock, LockCertificate, Posture
from cuspaudit.errors import RetryableError
from cuspaudit.kinematics.locked.span import Span
from cuspaudit.robot.chain import Angle, Chain, Rotation
from cuspaudit.robot.frames import angle_value, jacobian
from cuspaudit.robot.task import lock

__all__ = ["Locks", "MovingPath", "moving_path"]

Array = NDArray[np.float64]

_NODES = np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
_DIGITS = 12
_STEP = 0.04
_LEAP = 0.2
_SAMPLES = 12


@dataclass(frozen=True, eq=False)
class Locks:
    """A chain with one joint to be locked, and the arms that come of it.

    Attributes:
        chain: with all joints, a virtual one included.
        number: of the locked joint, from 1; it turns.
    """

    chain: Chain
    number: int

    def at(self, value: Angle) -> Chain:
        """The arm that is left at a value of the lock."""
        return lock(self.chain, {self.chain.joints[self.number - 1].name: value})

    def near(self, value: float) -> Chain:
        """The same, for a value in floating point."""
        return self.at(Angle(radians=Fraction(value)))

    def written(self, value: Angle) -> Chain:
        """The same as `at`, with the rotation of the lock standing there at 0 too."""
        held = self.at(Angle(radians=Fraction(1)))
        number, index = self.place
        places = [*(joint.before for joint in held.joints), held.tool]
        motions = list(places[number - 1])
        axis = self.chain.joints[self.number - 1].axis
        motions[index] = Rotation(axis, value)
        if number > len(held.joints):
            return replace(held, tool=tuple(motions))
        joints = list(held.joints)
        joints[number - 1] = replace(joints[number - 1], before=tuple(motions))
        return held.with_joints(joints)

    @property
    def place(self) -> tuple[int, int]:
        """Before which joint of the arm the lock's rotation stands, and its index."""
        return self.number, len(self.chain.joints[self.number - 1].before)


@dataclass(frozen=True, eq=False)
class MovingPath:
    """A path as a function of the lock's value.

    Attributes:
        span: the values that it is meant for.
        path: (m, n) way points in the middle.
        slopes: (m, n) their derivatives, for one rad of the lock.
        bends: (m, n) half their second derivatives.
        sign: of det J.
    """

    span: Span
    path: Array
    slopes: Array
    bends: Array
    sign: int

    def at(self, d: float) -> Array:
        """The way points d rad from the middle."""
        return self.path + d * (self.slopes + d * self.bends)

    def certificate(self, locks: Locks, limits: Limits | None) -> LockCertificate:
        """The certificate that states it, for a little more than the span."""
        middle = locks.written(self.span.middle)
        path = _rows(self.path)
        half = Fraction(self.span.radians / 2 * (1 + 1e-9)).limit_denominator(10**12)
        return LockCertificate(
            **certified_robot(middle),
            limits=limits,
            sign=1 if self.sign > 0 else -1,
            path=path,
            lock=Lock(*locks.place, half + Fraction(1, 10**11)),
            slopes=_rows(self.slopes),
            bends=_rows(self.bends),
        )


def moving_path(
    locks: Locks, span: Span, path: Array, value: float
) -> MovingPath | None:
    """The path moved to ``span``; None where it is lost on the way.

    Args:
        locks: of the arm.
        span: the values of the lock that it is to hold for.
        path: a witness at ``value``, whose ends have one pose.
        value: of the lock, rad; in the span or near it.
    """
    middle, half = angle_value(span.middle), span.radians / 2
    centre = _followed(locks, path, value, middle)
    if centre is None:
        return None
    ends = np.zeros((len(_NODES), path.shape[1]))
    for side in (-1, 1):
        last, at = centre, middle
        for k in np.nonzero(_NODES * side >= 0)[0][::side]:
            target = middle + half * _NODES[k]
            moved = _followed(locks, last, at, target)
            if moved is None:
                return None
            last, at = moved, target
            ends[k] = moved[-1]
    fitted = np.polyfit(_NODES * half, ends, 2) if half else _still(centre)
    bend, slope, place = (np.asarray(row, dtype=np.float64) for row in fitted)
    share = _shares(centre)[:, None]
    way = np.vstack([centre[:-1], place])
    sign = int(np.sign(np.linalg.det(jacobian(locks.near(middle), way[0]))))
    proposed = MovingPath(
        span,
        np.round(way, _DIGITS),
        np.round(share * slope, _DIGITS),
        np.round(share * bend, _DIGITS),
        sign,
    )
    return proposed if _is_hopeful(locks, proposed) else None


def _followed(locks: Locks, path: Array, value: float, target: float) -> Array | None:
    """The path at another value of the lock: its second posture is followed."""
    steps = max(1, int(np.ceil(abs(target - value) / _STEP)))
    for k in range(1, steps + 1):
        chain = locks.near(value + (target - value) * k / steps)
        try:
            moved = close(chain, path)
        except RetryableError:
            return None
        if np.abs(moved[-1] - path[-1]).max() > _LEAP:
            return None
        path = moved
    return path


def _is_hopeful(locks: Locks, proposed: MovingPath) -> bool:
    """Whether det J has one sign at samples of the path, at both ends of the span."""
    half = proposed.span.radians / 2
    middle = angle_value(proposed.span.middle)
    for d in (-half, half):
        chain, way = locks.near(middle + d), proposed.at(d)
        for a, b in pairwise(way):
            for s in np.linspace(0, 1, _SAMPLES):
                det = np.linalg.det(jacobian(chain, a + s * (b - a)))
                if det * proposed.sign <= 0:
                    return False
    return True


def _shares(path: Array) -> Array:
    """The share of the path's length at each way point, 0 to 1."""
    length = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]
    return np.asarray(length / (length[-1] or 1.0))


def _still(path: Array) -> Sequence[Array]:
    none = np.zeros(path.shape[1])
    return none, none, path[-1]


def _rows(points: Array) -> tuple[Posture, ...]:
    return tuple(tuple(Fraction(repr(float(v))) for v in row) for row in points)
