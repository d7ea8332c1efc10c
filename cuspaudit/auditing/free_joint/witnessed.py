"""Where a path that moves with the lock proves the arm cuspidal.

The open spans are walked along. A witness of the neighbouring stretch is followed to
the middle of the next one, and only where it is lost, or proves nothing there, another
is searched for. A span for which no path is proved is halved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.free_joint.moving_path import Locks, MovingPath, moving_path
from cuspaudit.auditing.free_joint.stretch import LockWitness, Stretch
from cuspaudit.certificate import Limits, verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.locked.span import Span
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.frames import angle_value
from cuspaudit.runtime.clock import check_time

__all__ = ["Finder", "LockWalk"]

Array = NDArray[np.float64]

Finder = Callable[[Angle], Iterator[Array]]
"""Witness paths of the arm at a value of the lock, the best first; closed."""

_LONGEST = 16.0
_SHORTEST = 0.25
_SEARCHED = 1.0
"""Degrees: the longest span tried, the shortest, the shortest that is searched for."""
_TRIED = 3
_BARREN = 4.0
"""Degrees below which a span with no witness at its middle is left."""


@dataclass(eq=False)
class LockWalk:
    """A walk over the open spans.

    Attributes:
        locks: of the arm.
        find: a search for witnesses.
        limits: for paths within joint limits; None without.
        tell: called with what is under way.
        reason: why no structure decides where the walk goes.
        searches: how many searches were made.
        proofs: how many certificates were tried.
    """

    locks: Locks
    find: Finder
    limits: Limits | None = None
    tell: Callable[[str], None] = lambda step: None
    reason: str = "no structure decides here"
    searches: int = 0
    proofs: int = 0
    _last: LockWitness | None = field(default=None)

    def over(self, span: Span) -> Iterator[Stretch]:
        """The span in stretches: cuspidal by a path, or open."""
        count = max(1, int(np.ceil(span.degrees / _LONGEST)))
        for part in span.parts(count):
            yield from self._cut(part)

    def _cut(self, span: Span) -> Iterator[Stretch]:
        check_time("witnesses")
        self.tell(f"witnesses: at {np.degrees(angle_value(span.middle)):.4g} deg")
        met, witness = self._witness(span)
        if witness is not None:
            self._last = witness
            why = "a path between two postures of one pose moves with the value"
            yield Stretch(span, Verdict.CUSPIDAL, "path", why, witness)
        elif span.degrees < (2 * _SHORTEST if met else 2 * _BARREN):
            why = (
                "a witness was met, and no proof for an interval about it"
                if met
                else f"{self.reason}, and no witness was met"
            )
            yield Stretch(span, Verdict.UNDECIDED, "none", why)
        else:
            for half in span.halves():
                yield from self._cut(half)

    def _witness(self, span: Span) -> tuple[bool, LockWitness | None]:
        """Whether a witness was met at the middle, and one proved for all of it."""
        met, last = False, self._last
        if last is not None:
            moving = moving_path(self.locks, span, last.path, last.value)
            met = moving is not None
            witness = None if moving is None else self._proved(moving)
            if witness is not None:
                return True, witness
        if span.degrees < _SEARCHED:
            return met, None
        self.searches += 1
        for path in islice(self.find(span.middle), _TRIED):
            met = True
            middle = angle_value(span.middle)
            moving = moving_path(self.locks, span, path, middle)
            witness = None if moving is None else self._proved(moving)
            if witness is not None:
                return True, witness
        return met, None

    def _proved(self, moving: MovingPath) -> LockWitness | None:
        self.proofs += 1
        certificate = moving.certificate(self.locks, self.limits)
        verification = verify(certificate)
        if not verification.accepted or verification.smallest is None:
            return None
        middle = angle_value(moving.span.middle)
        return LockWitness(middle, moving.path, certificate, verification.smallest)
