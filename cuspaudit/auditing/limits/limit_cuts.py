"""How much a joint's range must be cut to make a cuspidal arm noncuspidal.

One joint at a time, its range is scaled about its middle. By monotony the verdict
changes once on the way from the full range to nothing, so bisection brackets the place:
the arm is cuspidal, proved, at ``cuspidal_from`` and at every larger scale, and
noncuspidal, proved, at ``noncuspidal_to`` and at every smaller one. For six joints a
cusp inside the scaled range proves the first; the three joints before a wrist, or boxes
told apart, prove the second, which is left open where they do not.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from cuspaudit.auditing.cusp_witness import find_cusps
from cuspaudit.auditing.limits.joint_limits import has_limits
from cuspaudit.auditing.limits.limits_by_three import WRISTS
from cuspaudit.auditing.limits.pairs_apart import pairs_apart
from cuspaudit.auditing.limits.three_in_box import decide_three
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.auditing.search.cusps import moving_joints
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.theorems.registry import reduction_of
from cuspaudit.robot.chain import Angle, Chain, Joint
from cuspaudit.runtime.clock import Clock

__all__ = ["Cut", "cuts_of", "limit_cuts"]

_STEPS = {3: 5, 6: 4}
_LOOKS = 40
_HALF = Fraction(1, 2)


@dataclass(frozen=True)
class Cut:
    """What scaling the range of one joint does.

    Attributes:
        joint: its name.
        noncuspidal_to: the largest scale at which it was found noncuspidal, or None.
        cuspidal_from: the smallest scale at which it was found cuspidal.
    """

    joint: str
    noncuspidal_to: float | None
    cuspidal_from: float

    def record(self) -> dict[str, Any]:
        """The cut as JSON has it."""
        return {
            "joint": self.joint,
            "noncuspidal_to": self.noncuspidal_to,
            "cuspidal_from": self.cuspidal_from,
        }


def limit_cuts(model: ExactModel, seed: int, clock: Clock) -> list[Cut]:
    """A cut for each limited joint that moves det J, as far as the time reaches.

    Args:
        model: an arm that is cuspidal within its limits.
        seed: of the search for cusps.
        clock: of the audit.
    """
    chain = model.chain
    if chain.task not in ("position", "pose") or not has_limits(chain):
        return []
    return list(_cuts(model, seed, clock))


def cuts_of(
    audit: FinishedAudit, timeout: float | None = None
) -> list[dict[str, Any]] | None:
    """The cuts of an arm that is cuspidal within its limits, as JSON; else None."""
    if audit.within is None or audit.within.verdict is not Verdict.CUSPIDAL:
        return None
    cuts = limit_cuts(audit.answer.model, audit.seed, Clock(timeout))
    return [cut.record() for cut in cuts]


def _cuts(model: ExactModel, seed: int, clock: Clock) -> Iterator[Cut]:
    chain = model.chain
    for k in moving_joints(chain):
        if chain.joints[k].limits is None:
            continue

        def verdict(scale: Fraction, k: int = k) -> Verdict:
            return _verdict(_scaled(model, k, scale), seed, clock)

        try:
            clock.step("limits: how much to cut")
            low, high = _bracket(verdict, _STEPS[len(chain.joints)])
        except (UnableError, RetryableError):
            continue
        proved = None if low is None else float(low)
        yield Cut(chain.joints[k].name, proved, float(high))


def _bracket(
    verdict: Callable[[Fraction], Verdict], steps: int
) -> tuple[Fraction | None, Fraction]:
    """The largest scale found noncuspidal and the smallest found cuspidal."""
    low, proved, high = Fraction(0), None, Fraction(1)
    for _ in range(steps):
        middle = (low + high) / 2
        found = verdict(middle)
        if found is Verdict.CUSPIDAL:
            high = middle
        else:
            low = middle
            if found is Verdict.NONCUSPIDAL:
                proved = middle
    return proved, high


def _verdict(model: ExactModel, seed: int, clock: Clock) -> Verdict:
    if model.chain.task == "position":
        return decide_three(model, clock).verdict
    if next(find_cusps(model.chain, seed), None) is not None:
        return Verdict.CUSPIDAL
    proved = _wrist_is_noncuspidal(model, clock) or pairs_apart(model, _LOOKS)
    return Verdict.NONCUSPIDAL if proved else Verdict.UNDECIDED


def _wrist_is_noncuspidal(model: ExactModel, clock: Clock) -> bool:
    """Whether the three joints before a wrist are noncuspidal within their limits."""
    reduction = reduction_of(model)
    if reduction is None or reduction.regional is None or reduction.kind not in WRISTS:
        return False
    return decide_three(reduction.regional, clock).verdict is Verdict.NONCUSPIDAL


def _scaled(model: ExactModel, k: int, scale: Fraction) -> ExactModel:
    """The model with the range of one joint scaled about its middle, exactly."""
    joints = list(model.chain.joints)
    joints[k] = _shrunk(joints[k], scale)
    chain: Chain = model.chain.with_joints(joints)
    return replace(model, chain=chain)


def _shrunk(joint: Joint, scale: Fraction) -> Joint:
    assert joint.limits is not None, "asked of limited joints"
    low, high = joint.limits
    near, far = (1 + scale) * _HALF, (1 - scale) * _HALF
    if isinstance(low, Angle) and isinstance(high, Angle):
        ends = _mixed(low, high, near, far), _mixed(high, low, near, far)
        return replace(joint, limits=ends)
    assert isinstance(low, Fraction)
    assert isinstance(high, Fraction)
    return replace(joint, limits=(near * low + far * high, near * high + far * low))


def _mixed(a: Angle, b: Angle, near: Fraction, far: Fraction) -> Angle:
    return Angle(
        near * a.half_turns + far * b.half_turns, near * a.radians + far * b.radians
    )
