"""What is known of an arm: a verdict and its grounds, or why there is none."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from typing import TYPE_CHECKING, Any

from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, TimeLimitError, UnableError

if TYPE_CHECKING:
    from cuspaudit.auditing.cusp_witness import CuspWitness
    from cuspaudit.auditing.evidence import Crowd, PairRecord, SearchRecord
    from cuspaudit.auditing.witness import CertifiedPath
    from cuspaudit.cuspidality.pair_decision import PairDecision
    from cuspaudit.cuspidality.surface_decision import SurfaceDecision
    from cuspaudit.cuspidality.tile_decision import TileDecision
    from cuspaudit.kinematics.exact_model import ExactModel
    from cuspaudit.kinematics.theorems.theorem import Reduction

__all__ = ["Answer", "Reason", "Undecided", "stopped", "undecided"]


class Reason(Enum):
    """Why there is no verdict, for the ways that come next."""

    NO_THEOREM = "no theorem"
    """No theorem speaks of the arm: a search may still meet a witness."""
    PAIRS_ASKED = "pairs asked"
    """Only the pairs of postures were asked for, and they prove nothing here yet."""
    OUT_OF_REACH = "out of reach"
    """A routine met a limit of its own."""
    TIME_LIMIT = "time limit"
    """The time was up."""
    PRECISION = "precision"
    """Two numbers were not told apart."""
    UNCONFIRMED = "unconfirmed"
    """The second route, which was asked for, came to no end."""
    NO_MODEL = "no model"
    """The exact model has lost a relation of the axes, or has one too many."""
    UNCERTIFIED = "uncertified"
    """There is a cuspidal couple, and its path resists proof."""


@dataclass(frozen=True)
class Undecided:
    """Why there is no verdict.

    Attributes:
        reason: which kind of reason it is.
        step: the routine that stopped.
        why: what it could not do.
        looked_for: the structures that were tested and not found.
        would_settle: what would give a verdict.
    """

    reason: Reason
    step: str
    why: str
    looked_for: tuple[str, ...]
    would_settle: str


@dataclass(frozen=True, eq=False)
class Answer:
    """The answer for one exact model.

    Attributes:
        model: what it is about.
        verdict: one of three.
        why: one sentence.
        rests_on: what the verdict rests on.
        engine: the way that gave the verdict, or a couple without a certificate:
            "roadmap", "routing", "pairs", "tiles", "search", "cusp" or "pigeon-hole";
            None for a theorem alone, and where no way came so far.
        reduction: the theorem that was applied, if any.
        decision: the run of Algorithm 1, if there was one.
        by_pairs: the decision by pairs of postures, if that was made instead.
        by_tiles: the decision by tiles of pairs, where the verdict alone was asked for.
        witness: the proved path, where a way gave one.
        aspects: of the arm; None when not computed.
        postures: the largest number of postures of a regular pose; None likewise.
        cusps: of the curve of critical values, of a three-joint arm.
        nodes: of the same.
        undecided: set exactly when the verdict is UNDECIDED.
        search: what a search for a witness tried, if there was one.
        pairs: what the pairs of postures said, if they were looked at.
        crowd: a pose that proves the arm of the model cuspidal, if one was met.
        cusp: a posture that proves it, if one was met.
    """

    model: ExactModel
    verdict: Verdict
    why: str
    rests_on: tuple[str, ...] = ()
    engine: str | None = None
    reduction: Reduction | None = None
    decision: SurfaceDecision | None = None
    by_pairs: PairDecision | None = None
    by_tiles: TileDecision | None = None
    witness: CertifiedPath | None = None
    aspects: Count | None = None
    postures: Count | None = None
    cusps: Count | None = None
    nodes: Count | None = None
    undecided: Undecided | None = None
    search: SearchRecord | None = None
    pairs: PairRecord | None = None
    crowd: Crowd | None = None
    cusp: CuspWitness | None = None

    @property
    def is_exact_run(self) -> bool:
        """Whether Algorithm 1 or the pairs of postures decided, completely."""
        return any(
            run is not None for run in (self.decision, self.by_pairs, self.by_tiles)
        )

    @property
    def is_settled(self) -> bool:
        """Whether no further way is to be tried.

        A CUSPIDAL by one pose or one point is not: a path is still looked for.
        """
        match self.verdict:
            case Verdict.CUSPIDAL:
                return self.witness is not None or self.is_exact_run
            case Verdict.UNDECIDED:
                return False
        return True

    def is_open_for(self, *reasons: Reason) -> bool:
        """Whether a way that such reasons leave open may add something.

        It may where there is no verdict for one of them, and where a CUSPIDAL that a
        way gave has no path yet.
        """
        if self.undecided is None:
            return not self.is_settled
        return self.undecided.reason in reasons

    def still_open(self, why: str, **evidence: Any) -> Answer:
        """The same answer with more evidence, and with what it says against a verdict.

        Args:
            why: appended to the reason where there is no verdict.
            evidence: fields of the answer.
        """
        if self.undecided is None:
            return replace(self, **evidence)
        why = f"{self.undecided.why}{why}"
        reason = replace(self.undecided, why=why)
        return replace(self, why=why, undecided=reason, **evidence)

    def more_postures(self, seen: Count | None) -> Count | None:
        """The number of postures when some pose was seen to have so many."""
        known = self.postures
        if seen is None or (known is not None and known.proved):
            return known
        return seen if known is None or seen.count > known.count else known


def undecided(
    model: ExactModel,
    reason: Reason,
    step: str,
    why: str,
    looked_for: tuple[str, ...],
    settle: str,
    aspects: Count | None = None,
) -> Answer:
    """An answer without a verdict."""
    found = Undecided(reason, step, why, looked_for, settle)
    return Answer(model, Verdict.UNDECIDED, why, aspects=aspects, undecided=found)


def stopped(model: ExactModel, error: UnableError | RetryableError) -> Answer:
    """The answer where a routine gave up."""
    if isinstance(error, RetryableError):
        settle = "more bits, or another chart"
        reason, step = Reason.PRECISION, "precision"
    else:
        late = isinstance(error, TimeLimitError)
        settle = "more time (--timeout)" if late else "a more general engine"
        step = error.step
        reason = Reason.TIME_LIMIT if late else Reason.OUT_OF_REACH
    return undecided(model, reason, step, str(error), (), settle)
