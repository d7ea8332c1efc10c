"""An arm audited twice: as it was designed, and as its calibration says it was built.

The design is snapped, as in every audit. A calibration's numbers are measured: they are
taken as they stand, so that no offset that was measured disappears.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.auditing.structures import JudgedStructure
from cuspaudit.robot.calibration import Calibration, calibrated
from cuspaudit.robot.distance_text import distance_text, structure_words
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snap_policy import NO_SNAPPING

__all__ = ["SCHEMA", "CalibratedAudit", "audit_calibrated"]

SCHEMA = "cuspaudit/calibrated/1"


@dataclass(frozen=True, eq=False)
class CalibratedAudit:
    """Both audits.

    Attributes:
        calibration: as its file gives it.
        nominal: of the robot's own numbers.
        built: of the calibrated ones, none of them snapped.
    """

    calibration: Calibration
    nominal: FinishedAudit
    built: FinishedAudit

    @property
    def nearest(self) -> list[tuple[JudgedStructure, JudgedStructure]]:
        """The structures that both have a distance to, the built arm's nearest first.

        As pairs of nominal and built.
        """
        before = {each.name: each for each in self.nominal.structures}
        return [
            (before[each.name], each)
            for each in self.built.structures
            if each.name in before
        ]

    @property
    def why(self) -> str:
        """One sentence: both verdicts, and how far the nearest structure is."""
        first, second = (a.answer.verdict.value for a in (self.nominal, self.built))
        said = f"nominally {first}, as built {second}"
        if not self.nearest:
            return said
        before, now = self.nearest[0]
        return (
            f"{said}; {structure_words(now.name)}, which the nominal arm "
            f"{'has' if before.holds else f'misses by {_distance(before)}'}, is "
            f"{_distance(now)} away"
            + (f": {now.verdict.value}" if now.verdict is not None else "")
        )

    def record(
        self, certificate: str | None = None, limits_certificate: str | None = None
    ) -> dict[str, Any]:
        """As JSON; the verdict is that of the arm as it was built."""
        built = self.built.record(certificate, limits_certificate)
        return {
            "schema": SCHEMA,
            "calibration": self.calibration.file,
            "verdict": built["verdict"],
            "why": self.why,
            "structures": [
                {
                    "name": now.name,
                    "unit": now.unit,
                    "nominal": _side(before),
                    "calibrated": _side(now),
                }
                for before, now in self.nearest
            ],
            "nominal": self.nominal.record(None),
            "calibrated": built,
        }


def audit_calibrated(
    robot: Robot, calibration: Calibration, options: Options | None = None
) -> CalibratedAudit:
    """Audit ``robot`` as designed and as built.

    Args:
        robot: as read, its design.
        calibration: of one such arm.
        options: of both audits; numbers of the calibration are never snapped.

    Raises:
        InvalidRobotError: the calibration is one of another arm.
    """
    options = options or Options()
    built = calibrated(robot, calibration)
    return CalibratedAudit(
        calibration,
        audit(robot, options),
        audit(built, replace(options, snap=NO_SNAPPING)),
    )


def _side(structure: JudgedStructure) -> dict[str, Any]:
    verdict = structure.verdict
    return {
        "holds": structure.holds,
        "length": structure.length,
        "angle": structure.angle,
        "verdict": None if verdict is None else verdict.value,
    }


def _distance(structure: JudgedStructure) -> str:
    return distance_text(structure.length, structure.angle, structure.unit)
