"""The proof of a structure certificate: the robot is noncuspidal, by a theorem.

1. The theorem's relations are the ones listed, and the theorem is about this task.
2. Each relation holds, exactly, for the numbers of the file (`axes`).
3. At the posture `regular` det J is not 0, in balls: the robot is not singular
   everywhere, which every theorem supposes.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from flint import arb

from cuspaudit.certificate.arm import arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.cover import PRECISIONS, Refusal
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.model import Relation, StructureCertificate
from cuspaudit.certificate.structure.axes import (
    are_level,
    are_parallel,
    are_square,
    meet_in_one_point,
)
from cuspaudit.certificate.structure.theorems import THEOREMS, theorem_misfit

__all__ = ["StructureProof"]


@dataclass(slots=True)
class StructureProof:
    """The steps of the proof, in order; each raises `Refusal` when it fails.

    Attributes:
        certificate: well formed.
        bits: the highest working precision used.
    """

    certificate: StructureCertificate
    bits: int = PRECISIONS[0]
    boxes: int = 0
    radius: float | None = None

    def run(self) -> float:
        """Prove all; return a lower bound of |det J| at the regular posture."""
        misfit = theorem_misfit(self.certificate)
        if misfit is not None:
            raise Refusal(misfit)
        with working_precision(self.bits):
            for relation in self.certificate.relations:
                if not self._holds(relation):
                    raise Refusal(f"it is not proved that {relation}")
        return self._regular()

    def summary(self) -> str:
        """What `run` has proved, in one sentence."""
        certificate = self.certificate
        statement = THEOREMS[certificate.theorem].statement
        relations = ", ".join(map(str, certificate.relations))
        return f"noncuspidal: {relations}; by the theorem {certificate.theorem}: " + (
            statement
        )

    def _holds(self, relation: Relation) -> bool:
        first, *_, last = relation.axes[0], relation.axes[-1]
        match relation.word:
            case "parallel":
                pairs = pairwise(relation.axes)
                return all(are_parallel(self.certificate, *pair) for pair in pairs)
            case "level":
                return are_level(self.certificate, first)
            case "square":
                return are_square(self.certificate, first)
            case "meeting":
                return meet_in_one_point(self.certificate, first, last)

    def _regular(self) -> float:
        for bits in PRECISIONS:
            self.bits = bits
            with working_precision(bits):
                arm = arm_from_certificate(self.certificate, arb)
                q = [ball_from_fraction(value) for value in self.certificate.regular]
                value = jacobian_determinant(arm, q)
                if value is not None and not value.contains(0):
                    return float(abs(value).lower())
        raise Refusal("det J is not proved to differ from 0 at the regular posture")
