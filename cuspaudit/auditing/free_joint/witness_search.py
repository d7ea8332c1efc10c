"""Witnesses of an arm at one value of its lock, by a search and by the deciders."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.auditing.free_joint.moving_path import Locks
from cuspaudit.auditing.free_joint.stretch import Stretch
from cuspaudit.auditing.limits.joint_limits import interval_of
from cuspaudit.auditing.search.around_cusp import is_inside, paths_around
from cuspaudit.auditing.search.cusps import search_cusps
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.search.six_joints import search
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import AssumptionError, RetryableError, UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.frames import angle_value
from cuspaudit.runtime.clock import Clock, seconds_left

__all__ = ["WitnessSearch"]

Array = NDArray[np.float64]

_POSES = 64
_CUSPS = 4
_AROUND = 2


@dataclass(eq=False)
class WitnessSearch:
    """Looks for witnesses at single values.

    Attributes:
        locks: of the arm.
        seed: of every random choice.
        inside: whether paths have to keep within the joint limits.
        seen: what an audit said at single values (rad) that have no witness.
    """

    locks: Locks
    seed: int
    inside: bool
    seen: dict[float, Verdict] = field(default_factory=dict)

    def paths(self, value: Angle) -> Iterator[Array]:
        """Witness paths at a value of the lock, the best first; their ends closed."""
        chain = self.locks.at(value)
        found = 0
        for path in self._proposed(chain):
            try:
                closed = close(chain, path)
            except RetryableError:
                continue
            if not self.inside or is_inside(closed, _limits(chain)):
                found += 1
                yield closed
        if not self.inside and (not found or chain.task == "position"):
            yield from self._decided(chain, angle_value(value))

    def remarked(self, stretch: Stretch) -> Stretch:
        """An open stretch with what was seen at a single value of it."""
        if stretch.verdict is not Verdict.UNDECIDED:
            return stretch
        low, high = map(angle_value, (stretch.span.lower, stretch.span.upper))
        for value, verdict in self.seen.items():
            if low <= value <= high:
                at = f"{verdict.value} at {math.degrees(value):.6g} deg, a single value"
                return replace(stretch, why=f"{stretch.why}; {at}")
        return stretch

    def _proposed(self, chain: Chain) -> Iterator[Array]:
        if self.inside or chain.task == "position":
            limits = _limits(chain) if self.inside else [None] * len(chain.joints)
            most, around = (_CUSPS, _AROUND) if self.inside else (2, 1)
            for cusp in islice(search_cusps(chain, limits, self.seed), most):
                yield from islice(paths_around(chain, cusp.posture, limits), around)
        if chain.task == "pose" and chain.kinds == ("revolute",) * 6:
            for proposal in search(chain, self.seed, most=_POSES).proposals:
                yield proposal.path

    def _decided(self, chain: Chain, value: float) -> Iterator[Array]:
        """The path of a full decision at one value, or its verdict kept."""
        try:
            answer = decide(Case(exact_model(chain), self.seed), Clock(seconds_left()))
        except (UnableError, RetryableError, AssumptionError):
            return
        if answer.witness is not None:
            yield answer.witness.path
        elif answer.verdict is not Verdict.UNDECIDED:
            self.seen[value] = answer.verdict


def _limits(chain: Chain) -> list[tuple[float, float] | None]:
    return [interval_of(joint) for joint in chain.joints]
