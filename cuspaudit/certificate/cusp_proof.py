"""The proof of a cusp certificate: the robot is cuspidal, near one posture.

1. Next to the posture lies a true cusp of the map of the task (`cusp_point`), in a box
   of at most 6e-8 to each side in two joint values; the other values are exact.
2. With limits: the whole box is inside them.

With play (`play`) the arm is computed with in balls that hold every robot that it
allows: each of them has a cusp in the box.

**Theorem.** Then the robot is cuspidal, and within its limits if it has any.

*Proof.* In the coordinates of the cusp, (x^3 + x y, y, ...) has det J = 3 x^2 + y, to
a factor of one sign. The values (0, y, ...) with y < 0 are taken at x = 0 and
x = +-sqrt(-y). At the outer two det J = -2 y > 0, up to the same function; a path from
one to the other round the cusp, through {y > 0}, keeps this sign. They are different
postures of one value, and as near to the cusp as one likes, so inside the limits with
the path. QED.

The field is k = adj(J) e_r, J the screws of the joints in the coordinates of a link in
the middle of the arm (`determinant`) and e_r a unit vector there: k_i is det J with
column i replaced by e_r. The row r is the one that makes k largest. In these
coordinates joint 1 (of a pose task also the last) moves neither h nor k.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from flint import arb, arb_series

from cuspaudit.certificate.arm import Arm, arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.cover import PRECISIONS, Refusal
from cuspaudit.certificate.cusp_point import CuspBox, true_cusp
from cuspaudit.certificate.determinant import (
    determinant_with_column,
    jacobian_determinant,
)
from cuspaudit.certificate.limits_proof import check_box_inside, within
from cuspaudit.certificate.loose.play import for_every_robot
from cuspaudit.certificate.model import CuspCertificate, is_loose, printable

__all__ = ["CuspProof"]

TERMS = 3
"""Power series to the second order."""


@dataclass(frozen=True)
class ArmField:
    """det J of an arm and the field adj(J) e_r.

    Attributes:
        arm: three joints (position task) or six (pose).
        row: r.
    """

    arm: Arm[arb_series]
    row: int

    @property
    def variables(self) -> Sequence[int]:
        """The joints on which both depend, counted from 0."""
        return (1, 2) if len(self.arm.joints) == 3 else (1, 2, 3, 4)

    def determinant(self, q: Sequence[arb_series]) -> arb_series:
        """Det J."""
        value = jacobian_determinant(self.arm, q)
        return arb_series([0]) if value is None else value

    def kernel(self, q: Sequence[arb_series]) -> list[arb_series]:
        """The entries of adj(J) e_r for the joints of ``variables``."""
        found = []
        for joint in self.variables:
            value = determinant_with_column(self.arm, q, joint, self.row)
            found.append(arb_series([0]) if value is None else value)
        return found


@dataclass(slots=True)
class CuspProof:
    """The steps of the proof; each raises `Refusal` when it fails.

    Attributes:
        certificate: well formed.
        radius: half side of the box that holds the cusp, once known.
        bits: the highest working precision used.
    """

    certificate: CuspCertificate
    radius: float | None = None
    bits: int = PRECISIONS[0]
    boxes: int = 0

    def run(self) -> float:
        """Prove all; return a lower bound of |k . grad(k . grad h)|, rounded down."""
        reason = ""
        for self.bits in PRECISIONS:
            with working_precision(self.bits, TERMS):
                arm = arm_from_certificate(self.certificate, _constant)
                point = list(map(ball_from_fraction, self.certificate.posture))
            loose = is_loose(self.certificate)
            field = ArmField(arm, self._row(arm, point))
            found = true_cusp(field, point, self.bits, loose)
            if isinstance(found, CuspBox):
                self.radius = found.radius
                with working_precision(self.bits):
                    check_box_inside(self.certificate, found.values, "the cusp")
                return max(0.0, math.nextafter(float(found.clear), -math.inf))
            reason = found
            if loose:
                break
        raise Refusal(reason)

    def summary(self) -> str:
        """What `run` has proved, in one sentence."""
        near = ", ".join(f"{float(value):.6g}" for value in self.certificate.posture)
        return (
            f"cuspidal: the map of {self._task()} has a cusp at ({near}), and every "
            "neighborhood of a cusp holds two postures of one value in one aspect"
            f"{within(self.certificate)}{for_every_robot(self.certificate)}"
        )

    def _task(self) -> str:
        if self.certificate.task == "position-and-axis":
            virtual = printable(self.certificate.joints[-1].name)
            return f"position and tool axis (the last joint, {virtual}, is virtual)"
        return "the position" if self.certificate.task == "position" else "the pose"

    def _row(self, arm: Arm[arb_series], point: Sequence[arb]) -> int:
        """The row that makes the field largest at the posture."""

        def size(row: int) -> float:
            with working_precision(self.bits, 1):
                k = ArmField(arm, row).kernel([arb_series([x]) for x in point])
                return sum(float(abs(entry[0]).mid()) for entry in k)

        return max(range(len(arm.joints)), key=size)


def _constant(ball: arb) -> arb_series:
    return arb_series([ball])
