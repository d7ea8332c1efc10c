"""What an arm is when each of its axes may be a little elsewhere.

- *Cuspidal*: a path, chosen for how much play it stands, is proved by its certificate
  for every arm of the box; the largest box follows by bisection, with the box at which
  this proof ends.
- *Noncuspidal, three joints*: the certificate of all pairs of postures, likewise.
- *Noncuspidal by a structure*: play breaks the relations that it rests on, and no
  proof for every arm can be had. Arms of the box are sampled (`nearby_arms`), and what
  is seen is said as what it is.

All is about the numbers of the file, not the snapped ones.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.proofs.pairs_certificate import pairs_certificate
from cuspaudit.auditing.proofs.structure_certificate import structure_certificate
from cuspaudit.auditing.tolerance.box import LargestBox, ToleranceBox, largest_box, over
from cuspaudit.auditing.tolerance.nearby_arms import NearbyArms, nearby_arms
from cuspaudit.auditing.tolerance.sensitive_axis import SensitiveAxis, sensitive_axis
from cuspaudit.auditing.tolerance.witnesses import paths_with_room
from cuspaudit.auditing.witness import CertifiedPath
from cuspaudit.certificate import Certificate, PathCertificate, verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.tolerance import AxisTolerance
from cuspaudit.robot.virtual_joint import with_virtual_joint
from cuspaudit.runtime.clock import Clock

__all__ = ["OverTolerance", "largest_tolerance", "over_tolerance"]

_TRIED = 2
_COARSE = 1.3


@dataclass(frozen=True, eq=False)
class OverTolerance:
    """The verdict for every arm of a box, and how large the box may be.

    Attributes:
        box: as asked for.
        verdict: for every arm of the box.
        why: one sentence.
        proved: the largest box that a certificate is proved for, and the smallest for
            which this proof fails; None where it is proved for none.
        certificate: for the box asked for, where it is proved; else for the largest.
        sensitive: the axis and the motion of it that the proof stands least of.
        sampled: arms of the box; None where none were built.
        level: whether ``proved`` is about boxes without tilts.
    """

    box: ToleranceBox
    verdict: Verdict
    why: str
    proved: LargestBox | None = None
    certificate: Certificate | None = None
    sensitive: SensitiveAxis | None = None
    sampled: NearbyArms | None = None
    level: bool = False

    def record(self, certificate: str | None = None) -> dict[str, Any]:
        """The key ``tolerance`` of an audit's JSON."""
        sampled, sensitive = self.sampled, self.sensitive
        return {
            **_numbers(self.box),
            "verdict": self.verdict.value,
            "why": self.why,
            "largest": self._multiple(self.proved.proved if self.proved else None),
            "fails": self._multiple(self.proved.fails if self.proved else None),
            "numbers": [
                {"where": each.number.where, "within": float(each.number.within)}
                for each in self.box.numbers
            ],
            "sensitive": None if sensitive is None else sensitive.record(),
            "sampled": None
            if sampled is None
            else {
                "arms": sampled.arms,
                "cuspidal": sampled.cuspidal,
                "clearance": sampled.clearance,
                "seed": sampled.seed,
            },
            "certificate": certificate,
        }

    def _multiple(self, factor: float | None) -> dict[str, float] | None:
        if not factor or not math.isfinite(factor):
            return None
        box = self.box.times(factor)
        tilt = {"angles": 0.0} if self.level else {}
        return _numbers(box) | {"factor": factor} | tilt


def over_tolerance(
    box: ToleranceBox,
    found: Answer,
    literal: Chain,
    witness: CertifiedPath | None,
    seed: int,
    clock: Clock,
) -> OverTolerance:
    """The verdict over a box of arms.

    Args:
        box: how far the axes may be off.
        found: the answer for the arm itself.
        literal: its chain as the file has it, a virtual joint included.
        witness: of the audit.
        seed: of every random choice.
        clock: of the audit; when its time is up the box is what was proved by then.
    """
    if found.verdict is Verdict.UNDECIDED:
        return OverTolerance(box, Verdict.UNDECIDED, "the arm itself is undecided")
    clock.step("tolerance", always=True)
    if found.verdict is Verdict.CUSPIDAL:
        return _cuspidal(box, literal, witness, seed, clock)
    if literal.task == "position":
        pairs = pairs_certificate(literal)
        if pairs is not None:
            return _by_pairs(box, pairs, clock)
    return _sampled(box, found, literal, seed, clock)


def largest_tolerance(found: Answer, chain: Chain, seed: int) -> float | None:
    """The largest t so that the verdict is proved within t lengths and t rad.

    Args:
        found: the answer for the arm.
        chain: its own, whose numbers the proof is for.
        seed: of every random choice.

    Returns:
        A lower bound by one certificate; None where there is no such proof.
    """
    unit = ToleranceBox(AxisTolerance(Fraction(1, 1000), Fraction(1, 1000)))
    literal, clock = with_virtual_joint(chain), Clock()
    claims: Sequence[tuple[float, Certificate]] = []
    if found.verdict is Verdict.CUSPIDAL:
        claims = paths_with_room(literal, found.witness, unit, seed)[:1]
    elif found.verdict is Verdict.NONCUSPIDAL and literal.task == "position":
        pairs = pairs_certificate(literal)
        claims = [] if pairs is None else [(0.1, pairs)]
    reached = _proved(unit, found.verdict, claims, clock)[0].proved if claims else None
    return None if reached is None else float(unit.times(reached.proved).lengths)


def _cuspidal(
    box: ToleranceBox,
    literal: Chain,
    witness: CertifiedPath | None,
    seed: int,
    clock: Clock,
) -> OverTolerance:
    try:
        paths = paths_with_room(literal, witness, box, seed, clock.step)
    except UnableError as late:
        why = f"cuspidal itself; no path was tried for all arms: {late}"
        return OverTolerance(box, Verdict.UNDECIDED, why)
    if not paths:
        why = "cuspidal itself, but no path of it was met that stands any play"
        return OverTolerance(box, Verdict.UNDECIDED, why)
    result, best = _proved(box, Verdict.CUSPIDAL, paths[:_TRIED], clock)
    if result.proved is not None and isinstance(best, PathCertificate):
        try:
            clock.step("tolerance: the most sensitive axis")
            sensitive = sensitive_axis(best, box.times(result.proved.proved))
        except UnableError:
            sensitive = None
        result = replace(result, sensitive=sensitive)
    return result


def _proved(
    box: ToleranceBox,
    verdict: Verdict,
    claims: Sequence[tuple[float, Certificate]],
    clock: Clock,
) -> tuple[OverTolerance, Certificate | None]:
    """The verdict by certificates, each with the multiple of the box to try first.

    Returns:
        With the verdict the certificate that stands most, without its play.
    """
    best: LargestBox | None = None
    chosen: Certificate | None = None
    for room, certificate in claims:
        try:
            clock.step("tolerance: the largest box")
            coarse = largest_box(certificate, box, room, _COARSE)
            if best is None or coarse.proved > best.proved:
                chosen = certificate
                best = largest_box(certificate, box, coarse.proved or room)
        except UnableError:
            break
    if best is None or chosen is None or best.certificate is None:
        why = f"{verdict.value} itself, and not proved for any box of arms"
        return OverTolerance(box, Verdict.UNDECIDED, why), None
    claim = over(chosen, box)
    if best.proved >= 1 and verify(claim).accepted:
        why = "proved for every arm whose axes are off by no more"
        if box.axes is None:
            why = "proved for every value of the numbers within their bounds"
        return OverTolerance(box, verdict, why, best, claim), chosen
    why = f"{verdict.value} itself, and not proved for every arm of so large a box"
    claim = best.certificate
    return OverTolerance(box, Verdict.UNDECIDED, why, best, claim), chosen


def _by_pairs(box: ToleranceBox, pairs: Certificate, clock: Clock) -> OverTolerance:
    """Noncuspidal by all pairs; where that needs square axes, for lengths alone."""
    whole, _ = _proved(box, Verdict.NONCUSPIDAL, [(1.0, pairs)], clock)
    if whole.proved is not None or not box.lengths or not box.angles:
        return whole
    level = ToleranceBox(AxisTolerance(box.lengths, Fraction(0)), box.numbers)
    lengths, _ = _proved(level, Verdict.NONCUSPIDAL, [(1.0, pairs)], clock)
    if lengths.proved is None:
        return whole
    why = (
        "noncuspidal itself; proved for every arm whose axes are moved by so much and "
        "not tilted, and for no box with tilts, as its proof needs axes 1 and 2 square"
    )
    return replace(lengths, box=box, verdict=Verdict.UNDECIDED, why=why, level=True)


def _sampled(
    box: ToleranceBox, found: Answer, literal: Chain, seed: int, clock: Clock
) -> OverTolerance:
    """Arms of the box, where the verdict rests on exact relations."""
    if literal.task not in ("position", "pose"):
        why = (
            f"noncuspidal itself, as {_relations(found, literal)}, which play breaks; "
            "arms near by have a task of another kind, and none was looked at"
        )
        return OverTolerance(box, Verdict.UNDECIDED, why)
    seen = nearby_arms(literal, box, seed, clock)
    why = f"noncuspidal itself, as {_relations(found, literal)}, which play breaks; "
    if seen.cuspidal:
        why += (
            f"cuspidal by a hair: {seen.cuspidal} of {seen.arms} arms at the edge of "
            "the box have a path"
        )
        if seen.clearance is not None:
            why += f", clearance at most {seen.clearance:.1e} seen"
    else:
        why += f"of {seen.arms} arms at the edge of the box none was seen cuspidal"
    return OverTolerance(box, Verdict.UNDECIDED, why, sampled=seen)


def _relations(found: Answer, literal: Chain) -> str:
    """The relations that a structure rests on, in words; they may be missed by 0."""
    kind = found.reduction.kind if found.reduction else ""
    certificate = structure_certificate(found.model.chain, kind)
    if certificate is None:
        return f"{kind or 'a relation of its axes'} holds exactly"
    return ", ".join(map(str, certificate.relations)) + " exactly"


def _numbers(box: ToleranceBox) -> dict[str, float]:
    return {"lengths": float(box.lengths), "angles": float(box.angles)}
