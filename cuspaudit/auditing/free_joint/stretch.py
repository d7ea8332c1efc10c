"""What is known of the values of a locked joint: stretches, each with its verdict."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cuspaudit.certificate.model import LockCertificate
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.locked.span import Span
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import angle_value

__all__ = ["EXCEPTIONAL", "FreeJoint", "LockWitness", "Stretch", "joined"]

EXCEPTIONAL = 0.01
"""An open stretch of at most so many degrees is a single value, for the verdict."""


@dataclass(frozen=True, eq=False)
class LockWitness:
    """A path between two postures of one pose that moves with the value of the lock.

    Attributes:
        value: the lock's value in the middle, rad.
        path: (m, n) way points there, of the joints that are left, in chain order.
        certificate: what `cuspaudit verify` reads.
        smallest: a lower bound of |det J| on the paths of all values, proved.
    """

    value: float
    path: NDArray[np.float64]
    certificate: LockCertificate
    smallest: float


@dataclass(frozen=True, eq=False)
class Stretch:
    """Values of the lock with one verdict.

    Attributes:
        span: the values.
        verdict: that of the arm at each of them; UNDECIDED where it is open.
        kind: of the proof: "structure", "path", "idle" where the value does not matter,
            or "none".
        why: one sentence.
        witness: of a CUSPIDAL by a path.
    """

    span: Span
    verdict: Verdict
    kind: str
    why: str
    witness: LockWitness | None = None


@dataclass(frozen=True, eq=False)
class FreeJoint:
    """The verdict of an arm as a function of the value at which a joint is locked.

    Attributes:
        chain: with all joints, in the numbers that the verdicts are about.
        number: of the joint that is locked, from 1.
        domain: the values that were asked for.
        stretches: they cover the domain, in order.
        within_limits: whether the verdicts are those within the joint limits.
        is_snapped: whether numbers of the file were taken for others.
        seconds: time of each stage.
        seed: of every random choice.
        stopped: why the work ended early, or None.
    """

    chain: Chain
    number: int
    domain: Span
    stretches: tuple[Stretch, ...]
    within_limits: bool
    is_snapped: bool
    seconds: Mapping[str, float]
    seed: int
    stopped: str | None = None

    @property
    def joint(self) -> str:
        """The name of the joint."""
        return self.chain.joints[self.number - 1].name

    @cached_property
    def degrees(self) -> dict[Verdict, float]:
        """How many degrees of the domain have each verdict."""
        total = dict.fromkeys(Verdict, 0.0)
        for stretch in self.stretches:
            total[stretch.verdict] += stretch.span.degrees
        return total

    @property
    def verdict(self) -> Verdict:
        """NONCUSPIDAL where this is proved at all but single values.

        CUSPIDAL where some interval is proved and each of these is cuspidal. An arm of
        which neither holds is UNDECIDED, also where it is cuspidal at some values and
        noncuspidal at others.
        """
        seen = {
            stretch.verdict for stretch in self.stretches if not _is_single(stretch)
        }
        if seen == {Verdict.NONCUSPIDAL}:
            return Verdict.NONCUSPIDAL
        if Verdict.CUSPIDAL in seen and Verdict.NONCUSPIDAL not in seen:
            return Verdict.CUSPIDAL
        return Verdict.UNDECIDED

    @property
    def why(self) -> str:
        """One sentence."""
        total = self.domain.degrees
        shares = [
            f"{word.value if word is not Verdict.UNDECIDED else 'open'} "
            f"{self.degrees[word]:.4g} deg"
            for word in Verdict
            if self.degrees[word] > 0
        ]
        return f"of {total:.4g} deg of {self.joint}: {', '.join(shares)}"

    def at(self, value: float) -> Stretch | None:
        """The stretch that holds ``value`` (rad), or None outside the domain."""
        for stretch in self.stretches:
            ends = angle_value(stretch.span.lower), angle_value(stretch.span.upper)
            if ends[0] <= value <= ends[1]:
                return stretch
        return None


def joined(stretches: Iterable[Stretch]) -> tuple[Stretch, ...]:
    """The stretches with neighbours made one where nothing tells them apart."""
    return tuple(_joined(stretches))


def _joined(stretches: Iterable[Stretch]) -> Iterator[Stretch]:
    last: Stretch | None = None
    for each in stretches:
        if last is not None and _are_alike(last, each):
            span = Span(last.span.lower, each.span.upper)
            last = Stretch(span, last.verdict, last.kind, last.why)
            continue
        if last is not None:
            yield last
        last = each
    if last is not None:
        yield last


def _are_alike(one: Stretch, other: Stretch) -> bool:
    said = (one.verdict, one.kind, one.why) == (other.verdict, other.kind, other.why)
    return said and one.witness is None and other.witness is None


def _is_single(stretch: Stretch) -> bool:
    is_open = stretch.verdict is Verdict.UNDECIDED
    return is_open and stretch.span.degrees <= EXCEPTIONAL
