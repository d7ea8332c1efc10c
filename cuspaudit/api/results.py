"""What the functions return: short to look at, whole by ``to_dict``."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.proofs.certificates import certificate_text
from cuspaudit.auditing.proofs.proof_record import proof_record
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.robot.frames import jacobian
from cuspaudit.robot.virtual_joint import without_virtual_joint
from cuspaudit.runtime.writing import write_text

if TYPE_CHECKING:
    from cuspaudit.auditing.record import FinishedAudit
    from cuspaudit.auditing.witness import CertifiedPath
    from cuspaudit.robot.chain import Chain
    from cuspaudit.robot.robot import Robot

__all__ = [
    "Audit",
    "Proof",
    "Structure",
    "SystemAudit",
    "WithinLimits",
    "Witness",
]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Proof:
    """What a verdict rests on.

    Attributes:
        kind: ``witness``, ``cusp``, ``exact``, ``reduction`` or ``none``.
        engine: the route that decided, or None.
        reduction: the theorem that was applied, or None.
        rests_on: what has to be trusted.
    """

    kind: str
    engine: str | None
    reduction: str | None
    rests_on: tuple[str, ...]


@dataclass(frozen=True)
class Structure:
    """A structure whose theorem decides, and how far the robot is from it.

    Attributes:
        name: of the structure.
        holds: whether the robot has it exactly.
        length: the displacement of axes that a nearest arm with it needs, in ``unit``.
        angle: the turn of axes that it needs, in rad.
        unit: of ``length``.
        verdict: of that nearest arm, None where no theorem gives it; it decides
            nothing about this one.
        aspects: of that nearest arm, where they are known.
    """

    name: str
    holds: bool
    length: float | None
    angle: float | None
    unit: str
    verdict: Verdict | None
    aspects: int | None


@dataclass(frozen=True)
class WithinLimits:
    """The verdict within the joint limits.

    Attributes:
        verdict: within them.
        why: one sentence.
        aspects: components of the nonsingular postures within limits, if counted.
        witness: a path that stays inside, where it proves a cuspidal verdict.
    """

    verdict: Verdict
    why: str
    aspects: Count | None
    witness: Witness | None = None


@dataclass(frozen=True, eq=False, repr=False)
class Witness:
    """Two postures of one pose and a path between them without a singularity.

    Attributes:
        path: (n, joints) way points, angles in rad, slides in the robot's unit, with
            straight lines of joint space between them. The first and the last are the
            postures.
        sign: of det J, the same on the whole path.
        clearance: a proved lower bound of |det J| on the path over the largest |det J|
            sampled on the arm's joint space; None where that is infinite.
    """

    path: Array
    sign: int
    clearance: float | None
    _chain: Chain

    @property
    def postures(self) -> Array:
        """(2, joints) the two postures of one pose."""
        return self.path[[0, -1]]

    def determinants(self, n: int = 200) -> Array:
        """(n,) det J at ``n`` places of the path, evenly spaced along its length.

        In floating point, to look at: what proves the sign is the certificate.
        """
        steps = np.linalg.norm(np.diff(self.path, axis=0), axis=1)
        length = np.concatenate([[0.0], np.cumsum(steps)])
        places = np.linspace(0.0, length[-1], n)
        rows = np.column_stack(
            [np.interp(places, length, column) for column in self.path.T]
        )
        return np.array([np.linalg.det(jacobian(self._chain, row)) for row in rows])

    def __repr__(self) -> str:
        return f"<Witness: {len(self.path)} way points, clearance {self.clearance}>"


class Decided:
    """What an audit and a run of Algorithm 1 have in common.

    ``verdict`` compares equal to its word and has no truth value.
    """

    def __init__(self, record: dict[str, Any]) -> None:
        self._record = record

    @property
    def verdict(self) -> Verdict:
        """``cuspidal``, ``noncuspidal`` or ``undecided``; of an arm's snapped model."""
        return Verdict(self._record["verdict"])

    @property
    def why(self) -> str:
        """The reason in one sentence."""
        return str(self._record["proof"]["why"])

    @property
    def proof(self) -> Proof:
        """What the verdict rests on."""
        proof = self._record["proof"]
        return Proof(
            proof["kind"], proof["engine"], proof["reduction"], tuple(proof["rests_on"])
        )

    @property
    def aspects(self) -> Count | None:
        """How many components det J != 0 has, and whether that is proved.

        Of a system, those of V - {Delta = 0}, where they were all found.
        """
        return _count(self._record["aspects"], "count")

    @property
    def postures(self) -> Count | None:
        """The largest number of postures of one pose, and whether that is proved."""
        return _count(self._record["postures"], "max")

    def to_dict(self) -> dict[str, Any]:
        """All that was found as JSON has it, schema ``cuspaudit/audit/2``.

        Of a system its ``robot`` is null.
        """
        return _copy(self._record)


class Audit(Decided):
    """What an audit found."""

    def __init__(self, found: FinishedAudit) -> None:
        super().__init__(found.record())
        self._found = found

    @property
    def robot(self) -> Robot:
        """The robot, as it was loaded."""
        return self._found.robot

    @property
    def literal(self) -> Verdict:
        """The verdict for the numbers exactly as the file has them."""
        return self._found.literal

    @property
    def witness(self) -> Witness | None:
        """The path that proves a cuspidal verdict, where there is one."""
        found = self._found
        return _witness(found.witness, found.shown_chain)

    @property
    def margin(self) -> float | None:
        """Every posture so many rad from the witness path is nonsingular; proved."""
        return self._found.margin

    @property
    def within_limits(self) -> WithinLimits | None:
        """The verdict within the joint limits; None where it was not asked for."""
        found = self._record["limits"]
        if found is None:
            return None
        aspects = _count(found["aspects"], "count")
        within = self._found.within
        inside = None if within is None else within.witness
        chain = self.robot.chain if inside is None else inside.chain
        return WithinLimits(
            Verdict(found["verdict"]),
            found["why"],
            aspects,
            _witness(inside, without_virtual_joint(chain)),
        )

    @property
    def structures(self) -> tuple[Structure, ...]:
        """The structures that would decide, nearest first; empty when not computed."""
        fields = Structure.__dataclass_fields__
        return tuple(
            Structure(
                **{name: entry[name] for name in fields if name != "verdict"},
                verdict=Verdict(entry["verdict"]) if entry["verdict"] else None,
            )
            for entry in self._record["structures"] or ()
        )

    def save_html(self, file: str | os.PathLike[str]) -> None:
        """Write the offline page: the path or the postures, moving, and the proof.

        Raises:
            InvalidInputError: the file cannot be written.
        """
        from cuspaudit.pictures.page import page_text

        write_text(Path(file), page_text(self._record, self._found))

    def save_certificate(self, file: str | os.PathLike[str]) -> None:
        """Write what proves the verdict; `verify` reads it.

        A certificate where there is one, else the record of the exact run or of what
        was tried, which is to be read and not verified.

        Raises:
            InvalidInputError: the file cannot be written.
        """
        text = certificate_text(self._found) or proof_record(self._found.answer)
        write_text(Path(file), text)

    def __repr__(self) -> str:
        counts = (("aspects", self.aspects), ("postures", self.postures))
        more = "".join(f", {n.count} {name}" for name, n in counts if n is not None)
        return f"<Audit of {self.robot.name}: {self.verdict.value}{more}>"


class SystemAudit(Decided):
    """What Algorithm 1 found of a polynomial map."""

    @property
    def path(self) -> Array | None:
        """(m, n) a path between two points of one fiber that misses Delta = 0."""
        witness = self._record["witness"]
        return None if witness is None else np.array(witness["path"])

    def __repr__(self) -> str:
        size = len(self._record["system"]["map"])
        return f"<SystemAudit of a map to R^{size}: {self.verdict.value}>"


def _witness(found: CertifiedPath | None, chain: Chain) -> Witness | None:
    if found is None:
        return None
    path = found.path[:, : len(chain.joints)].copy()
    path.setflags(write=False)
    return Witness(path, found.sign, found.clearance, chain)


def _count(entry: Mapping[str, Any], key: str) -> Count | None:
    number = entry[key]
    return None if number is None else Count(number, entry["proved"])


def _copy(record: dict[str, Any]) -> dict[str, Any]:
    copied: dict[str, Any] = json.loads(json.dumps(record, allow_nan=False))
    return copied
