"""The motion of one axis that a proved path stands least of.

Each axis but the first may slide along, or turn about, the three directions of its
frame; a turn about itself moves nothing. One at a time these are made loose numbers of
the certificate. To first order they are compared, each as a share of what the box
allows, and the largest value of the worst is found by bisection.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Literal

from cuspaudit.auditing.tolerance.box import enlarged
from cuspaudit.certificate import Loose, PathCertificate, verify
from cuspaudit.certificate.play_estimate import estimated_room
from cuspaudit.robot.chain import X_AXIS, Y_AXIS, Z_AXIS, Vector
from cuspaudit.robot.tolerance import AxisTolerance
from cuspaudit.runtime.clock import check_time

__all__ = ["SensitiveAxis", "sensitive_axis"]

_AXES = {"x": X_AXIS, "y": Y_AXIS, "z": Z_AXIS}
_TINY = 1e-4
_RATIO = 1.1
_MOST_TRIES = 40

Kind = Literal["turn", "slide"]


@dataclass(frozen=True, slots=True)
class SensitiveAxis:
    """A motion of one axis.

    Attributes:
        joint: name of the joint whose axis moves.
        kind: "turn" or "slide".
        direction: "x", "y" or "z" of the frame of the joint.
        largest: the largest value proved for it alone, rad or the unit of length.
    """

    joint: str
    kind: Kind
    direction: str
    largest: float

    def record(self) -> dict[str, Any]:
        """As the audit's JSON has it."""
        return {
            "joint": self.joint,
            "kind": self.kind,
            "direction": self.direction,
            "largest": self.largest,
        }


def sensitive_axis(
    certificate: PathCertificate, box: AxisTolerance
) -> SensitiveAxis | None:
    """The motion that the path stands least of; None where none is proved.

    Args:
        certificate: proved for a box.
        box: the largest that it is proved for.
    """
    still = replace(certificate, tolerance=None)
    kinds: dict[Kind, Fraction] = {"turn": box.angles, "slide": box.lengths}
    rooms = {}
    for k in range(1, len(still.joints)):
        for kind, allowed in kinds.items():
            for name, axis in _AXES.items() if allowed else ():
                if kind == "turn" and _is_along(still.joints[k].axis, axis):
                    continue  # only the zero of the joint
                check_time("tolerance")
                tiny = enlarged(AxisTolerance(allowed, Fraction(0)), _TINY).lengths
                claim = _loosened(still, k, Loose(kind, axis, tiny))
                rooms[k, kind, name] = estimated_room(claim) * _TINY
    if not rooms:
        return None
    k, kind, name = min(rooms, key=lambda key: rooms[key])
    largest = _largest(still, k, Loose(kind, _AXES[name], kinds[kind]))
    joint = still.joints[k].name
    return SensitiveAxis(joint, kind, name, largest) if largest else None


def _is_along(u: Vector, v: Vector) -> bool:
    return all(u[i] * v[j] == u[j] * v[i] for i, j in ((0, 1), (1, 2), (2, 0)))


def _loosened(certificate: PathCertificate, k: int, loose: Loose) -> PathCertificate:
    """The claim for all values of one number, at the axis of joint k (from 0)."""
    joints = list(certificate.joints)
    joints[k] = replace(joints[k], before=(*joints[k].before, loose))
    return replace(certificate, joints=tuple(joints))


def _largest(certificate: PathCertificate, k: int, loose: Loose) -> float:
    """The largest value that is proved; the one given is, as part of a box."""
    proved, fails, factor = 0.0, float("inf"), 1.0
    for _ in range(_MOST_TRIES):
        if proved and fails / proved < _RATIO:
            break
        check_time("tolerance")
        within = enlarged(AxisTolerance(loose.within, Fraction(0)), factor).lengths
        if verify(_loosened(certificate, k, replace(loose, within=within))).accepted:
            proved = factor
        else:
            fails = factor
        bound = fails if fails < float("inf") else 4 * factor
        factor = (proved * bound) ** 0.5 if proved else factor / 2
    return float(enlarged(AxisTolerance(loose.within, Fraction(0)), proved).lengths)
