"""What is known of an arm within its joint limits, and how the record says it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from cuspaudit.auditing.cusp_witness import CuspWitness
from cuspaudit.auditing.witness import CertifiedPath
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict

__all__ = ["FreeWitness", "LimitsAnswer"]


@dataclass(frozen=True)
class FreeWitness:
    """Whether the path that is shown without limits stays inside them.

    Attributes:
        inside: whether it does.
        leaves: the first joint that leaves its limits, and where; None if inside.
    """

    inside: bool
    leaves: str | None


@dataclass(frozen=True, eq=False)
class LimitsAnswer:
    """The verdict within joint limits, and its grounds.

    Attributes:
        verdict: one of three.
        why: one sentence.
        kind: of the proof: "monotony", "cusp", "witness", "exact", "reduction",
            "apart", "none".
        rests_on: what it rests on.
        joints: name, lower and upper limit of each joint of the robot.
        aspects: components of {det J != 0} within the limits; None if not counted.
        witness: a path inside the limits, proved; for the literal chain if possible.
        cusp: inside the limits, proved.
        slack: how near the path comes to a limit, rad or the unit of length.
        free: of the path that is the witness without limits; None without one.
    """

    verdict: Verdict
    why: str
    kind: str
    rests_on: tuple[str, ...]
    joints: tuple[tuple[str, float | None, float | None], ...]
    aspects: Count | None = None
    witness: CertifiedPath | None = None
    cusp: CuspWitness | None = None
    slack: float | None = None
    free: FreeWitness | None = None

    def record(self, certificate: str | None = None) -> dict[str, Any]:
        """The key ``limits`` of an audit's JSON."""
        counted = self.aspects or Count(0, False)
        return {
            "verdict": self.verdict.value,
            "why": self.why,
            "proof": {"kind": self.kind, "rests_on": list(self.rests_on)},
            "joints": [
                {"name": name, "lower": lower, "upper": upper}
                for name, lower, upper in self.joints
            ],
            "aspects": {
                "count": counted.count if self.aspects else None,
                "proved": counted.proved,
            },
            "witness": self._witness(certificate),
            "cuts": None,
            "of_the_free_witness": None
            if self.free is None
            else {"inside": self.free.inside, "leaves": self.free.leaves},
        }

    def _witness(self, certificate: str | None) -> dict[str, Any] | None:
        own = len(self.joints)
        if self.witness is None:
            return None
        path = [[float(v) for v in row[:own]] for row in self.witness.path]
        return {
            "postures": [path[0], path[-1]],
            "path": path,
            "clearance": self.witness.clearance,
            "slack": self.slack,
            "certificate": certificate,
        }
