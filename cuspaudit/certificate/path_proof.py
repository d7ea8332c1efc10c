"""The proof of a path certificate: the robot is cuspidal.

1. the path runs from the first posture to the second, as exact numbers;
2. next to the second posture lies exactly one true posture q* whose pose is that of
   the first (`krawczyk`), in a box of at most 1e-9 to each side;
3. q* differs from the first posture: for one joint at least, the box less the first
   posture contains no multiple of 2 pi (of 0, for a sliding joint);
4. det J has the claimed sign on every segment of the path (`cover`);
5. it has this sign on the whole box of q*, and with it on the segment from the end of
   the path to q*;
6. with limits, every way point and the whole box of q* are inside (`limits_proof`).

With play (`play`) the same is proved for every robot that it allows: step 2 in a box
with the second posture of each, and 5 for the way to it (`loose_posture`), 3 and 6 for
that box, 4 by `loose_cover`.

From 4 and 5 a path leads from the first posture to q* with det J != 0 all along, from 2
and 3 both are distinct postures of one pose: this is what cuspidal means.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from flint import arb

from cuspaudit.certificate.arm import arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.cover import PRECISIONS, Cover, Refusal
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.krawczyk import (
    LARGEST_RADIUS_EXPONENT,
    true_posture,
)
from cuspaudit.certificate.limits_proof import (
    check_box_inside,
    check_way_points,
    within,
)
from cuspaudit.certificate.loose.play import for_every_robot, without_play
from cuspaudit.certificate.model import PathCertificate, is_loose, printable

if TYPE_CHECKING:
    from cuspaudit.certificate.loose.loose_cover import LooseCover

__all__ = ["PathProof"]


@dataclass(slots=True)
class PathProof:
    """The steps of the proof, in order; each raises `Refusal` when it fails.

    Attributes:
        certificate: well formed.
        cover: the boxes that cover its path.
        radius: half side of the box that holds the true second posture, once known.
        bits: the highest working precision used.
    """

    certificate: PathCertificate
    cover: Cover | LooseCover
    radius: float | None = None
    bits: int = PRECISIONS[0]

    @property
    def boxes(self) -> int:
        """Number of boxes that the path was cut into so far."""
        return self.cover.boxes

    def run(self) -> float:
        """Prove all; return a lower bound of sign det J, rounded down."""
        self._check_ends()
        check_way_points(self.certificate, self.certificate.path)
        at_end = self._end()
        try:
            smallest = min(at_end, self.cover.cover())
        finally:
            self.bits = max(self.bits, self.cover.bits)
        return max(0.0, math.nextafter(float(smallest), -math.inf))

    def summary(self) -> str:
        """What `run` has proved, in one sentence."""
        sign = ">" if self.certificate.sign > 0 else "<"
        count = len(self.certificate.path) - 1
        return (
            f"cuspidal: two distinct postures of {self._place()}, joined by a path "
            f"with det J {sign} 0 ({count} segment{'s' if count > 1 else ''})"
            f"{within(self.certificate)}{for_every_robot(self.certificate)}"
        )

    def _place(self) -> str:
        if self.certificate.task == "position-and-axis":
            virtual = printable(self.certificate.joints[-1].name)
            return f"one position and tool axis (the last joint, {virtual}, is virtual)"
        return "one pose"

    def _check_ends(self) -> None:
        """Step 1."""
        (first, second), path = self.certificate.postures, self.certificate.path
        for posture, point, claim in (
            (first, path[0], "start at the first"),
            (second, path[-1], "end at the second"),
        ):
            for index, (a, b) in enumerate(zip(posture, point, strict=True), 1):
                if a != b:
                    found = f"joint {index} differs"
                    raise Refusal(f"the path does not {claim} posture: {found}")

    def _end(self) -> arb:
        """Steps 2, 3 and 5; return a lower bound of sign det J on the end box."""
        for bits in PRECISIONS:
            self.bits = bits
            try:
                with working_precision(bits):
                    values, height = self._one_end()
                    break
            except Refusal as refusal:
                last = refusal
        else:
            raise last
        if not is_loose(self.certificate):
            return height
        return self._all_ends(values, height)

    def _one_end(self) -> tuple[Sequence[arb], arb]:
        """The box of the second posture of the robot without play, and the bound."""
        arm = arm_from_certificate(without_play(self.certificate), arb)
        first, second = self._postures()
        box = true_posture(arm, first, second)
        if box is None:
            raise Refusal(
                "no true posture of the first posture's pose is proved within "
                f"{2.0**LARGEST_RADIUS_EXPONENT:.1g} of the second posture"
            )
        self.radius = box.radius
        self._check_box(box.values)
        value = jacobian_determinant(arm, box.values)
        signed = arb(0) if value is None else value * self.certificate.sign
        if not signed > 0:
            word = "has the opposite" if signed < 0 else "is not proved to have the"
            raise Refusal(f"det J {word} sign at the second posture")
        return box.values, signed.lower()

    def _all_ends(self, values: Sequence[arb], height: arb) -> arb:
        """The same of every robot that the play allows."""
        from cuspaudit.certificate.loose.loose_arm import loose_arm  # most have no play
        from cuspaudit.certificate.loose.loose_cover import BITS
        from cuspaudit.certificate.loose.loose_posture import second_postures

        with working_precision(BITS):
            first, _ = self._postures()
            box = second_postures(loose_arm(self.certificate), first, values)
            if box is None:
                raise Refusal("a second posture is not proved for every robot")
            self.radius = box.radius
            self._check_box(box.values)
            if not height - box.change > 0:
                raise Refusal(
                    "det J is not proved to have the sign at the second posture of "
                    "every robot"
                )
            return (height - box.change).lower()

    def _postures(self) -> tuple[list[arb], list[arb]]:
        first, second = (
            [ball_from_fraction(value) for value in posture]
            for posture in self.certificate.postures
        )
        return first, second

    def _check_box(self, box: Sequence[arb]) -> None:
        """Step 3, and 6 for the box."""
        first, _ = self._postures()
        if not _differs(self.certificate, first, box):
            raise Refusal("the two postures are the same (modulo 2 pi)")
        check_box_inside(self.certificate, box, "the second posture")


def _differs(
    certificate: PathCertificate, first: Sequence[arb], box: Sequence[arb]
) -> bool:
    """Whether the box is disjoint from the first posture modulo 2 pi (step 3)."""
    turn = 2 * arb.pi()
    for joint, a, b in zip(certificate.joints, first, box, strict=True):
        turns = joint.kind == "revolute"
        if turns and not ((b - a) / turn).contains_integer():
            return True
        if not turns and not (b - a).contains(0):
            return True
    return False
