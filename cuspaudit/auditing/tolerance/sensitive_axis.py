"""The one motion, of an axis or of a loose number, that a path stands least of.

Each axis but the first may slide along, or turn about, the three directions of its
frame; a turn about itself moves nothing. One at a time these, and the loose numbers of
a table, are made loose numbers of the certificate. To first order they are compared,
each as a share of what the box allows, and the largest value of the worst is found by
bisection.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from cuspaudit.auditing.tolerance.box import (
    PlacedNumber,
    ToleranceBox,
    largest_box,
    over,
    part,
)
from cuspaudit.certificate import PathCertificate
from cuspaudit.certificate.loose.play_estimate import estimated_room
from cuspaudit.robot.chain import X_AXIS, Y_AXIS, Z_AXIS, Vector
from cuspaudit.robot.tolerance import LooseNumber
from cuspaudit.runtime.clock import check_time

__all__ = ["SensitiveAxis", "sensitive_axis"]

_AXES = {"x": X_AXIS, "y": Y_AXIS, "z": Z_AXIS}
_TINY = 1e-4
_RATIO = 1.1


@dataclass(frozen=True, slots=True)
class SensitiveAxis:
    """A motion of one axis, or one loose number.

    Attributes:
        where: "axis joint_2", or the row and column of a number, "joint_2 a".
        kind: "turn" or "slide".
        direction: "x", "y" or "z" of the frame there.
        largest: the largest value proved for it alone, rad or the unit of length.
    """

    where: str
    kind: Literal["turn", "slide"]
    direction: str
    largest: float

    def record(self) -> dict[str, Any]:
        """As the audit's JSON has it."""
        return {
            "where": self.where,
            "kind": self.kind,
            "direction": self.direction,
            "largest": self.largest,
        }


def sensitive_axis(
    certificate: PathCertificate, box: ToleranceBox
) -> SensitiveAxis | None:
    """The motion that the path stands least of; None where none is proved.

    Args:
        certificate: of the path, without play.
        box: the largest that it is proved for.
    """
    rooms = []
    for single in _singles(certificate, box):
        check_time("tolerance")
        claim = over(certificate, single.times(_TINY))
        assert isinstance(claim, PathCertificate)
        rooms.append((estimated_room(claim), single))
    if not rooms:
        return None
    _, worst = min(rooms, key=lambda pair: pair[0])
    found = largest_box(certificate, worst, 1.0, _RATIO)
    if not found.proved:
        return None
    number = worst.numbers[0].number
    [name] = (name for name, axis in _AXES.items() if axis == number.axis)
    largest = float(part(number.within, found.proved))
    return SensitiveAxis(number.where, number.kind, name, largest)


def _singles(certificate: PathCertificate, box: ToleranceBox) -> Iterator[ToleranceBox]:
    """Boxes of one loose number each."""
    for placed in box.numbers:
        yield ToleranceBox(None, (placed,))
    for link, joint in enumerate(certificate.joints[1:], 1):
        for axis in _AXES.values():
            numbers = []
            if box.lengths:
                slide = LooseNumber(f"axis {joint.name}", "slide", axis, box.lengths)
                numbers.append(slide)
            if box.angles and not _is_along(joint.axis, axis):
                turn = LooseNumber(f"axis {joint.name}", "turn", axis, box.angles)
                numbers.append(turn)
            for number in numbers:
                yield ToleranceBox(
                    None, (PlacedNumber(link, len(joint.before) - 1, number),)
                )


def _is_along(u: Vector, v: Vector) -> bool:
    return all(u[i] * v[j] == u[j] * v[i] for i, j in ((0, 1), (1, 2), (2, 0)))
