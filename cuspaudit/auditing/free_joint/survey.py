"""Which joint of an arm with one to spare is to be locked: each tried at one value.

The structures of every value come first; where they leave the circle open, the arm is
decided with the joint locked in the middle of its range.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from cuspaudit.auditing.carried import is_carried
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.auditing.free_joint.free_joint import lockable
from cuspaudit.auditing.free_joint.moving_path import Locks
from cuspaudit.auditing.free_joint.structured import by_structure
from cuspaudit.auditing.options import Options
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    AssumptionError,
    DegenerateMapError,
    TimeLimitError,
    UnableError,
)
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.locked.locked_arm import locked_arm
from cuspaudit.kinematics.locked.regular_over import is_singular_everywhere
from cuspaudit.kinematics.locked.span import WHOLE_CIRCLE, Span
from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snapping import snap
from cuspaudit.robot.task import lock
from cuspaudit.robot.virtual_joint import with_virtual_joint
from cuspaudit.runtime.clock import Clock, time_limit

__all__ = ["LockChoice", "survey"]

_ALL = 359.9
_ASIDE = Angle(Fraction(1, 6))


@dataclass(frozen=True)
class LockChoice:
    """What the arm is when one joint is locked.

    Attributes:
        joint: its name.
        verdict: at ``value``; of all values where that is None.
        value: of the lock, rad or a length; None where a structure decides at all
            values but single ones.
        degrees: of the circle that a structure makes noncuspidal.
        why: one sentence.
    """

    joint: str
    verdict: Verdict
    value: float | None
    degrees: float
    why: str


def survey(robot: Robot, options: Options | None = None) -> Iterator[LockChoice]:
    """What each joint gives, base to tip, one after the other.

    Args:
        robot: with one joint more than its task has dimensions.
        options: of the audits; the engine is not asked.
    """
    options = options or Options()
    clock = Clock(options.timeout, options.progress)
    chain = snap(robot.chain, options.snap)[0]
    if not lockable(robot):
        return
    for number, joint in enumerate(chain.joints, 1):
        clock.tell(f"locks: {joint.name}")
        choose = _choice if joint.kind == "revolute" else _slide
        with time_limit(clock.left):
            yield choose(chain, number, options.seed, clock)


def _slide(chain: Chain, number: int, seed: int, clock: Clock) -> LockChoice:
    """What the arm is with a slide locked at 0."""
    name = chain.joints[number - 1].name
    held = with_virtual_joint(lock(chain, {name: Fraction(0)}))
    try:
        found = decide(Case(exact_model(held), seed), clock)
    except (AssumptionError, UnableError, TimeLimitError) as error:
        return LockChoice(name, Verdict.UNDECIDED, 0.0, 0.0, str(error))
    verdict = found.verdict if is_carried(found) else Verdict.UNDECIDED
    said = f"a slide, locked at 0: {found.why}"
    return LockChoice(name, verdict, 0.0, 0.0, said)


def _choice(chain: Chain, number: int, seed: int, clock: Clock) -> LockChoice:
    name, value = chain.joints[number - 1].name, _middle(chain, number)
    at, degrees = angle_value(value), 0.0
    try:
        held = locked_arm(chain, number)
        if is_singular_everywhere(held):
            why = "det J vanishes at every posture, whatever the value"
            return LockChoice(name, Verdict.UNDECIDED, None, 0.0, why)
        parts = by_structure(held, WHOLE_CIRCLE)
        proved = [each for each in parts if each.verdict is Verdict.NONCUSPIDAL]
        degrees = sum(each.span.degrees for each in proved)
        if degrees > _ALL:
            return LockChoice(name, Verdict.NONCUSPIDAL, None, degrees, proved[0].why)
        locks = Locks(with_virtual_joint(chain), number)
        try:
            found = decide(Case(exact_model(locks.at(value)), seed), clock)
        except DegenerateMapError:  # a single value, as det J is not 0 at all values
            value = value + _ASIDE
            at = angle_value(value)
            found = decide(Case(exact_model(locks.at(value)), seed), clock)
    except (AssumptionError, UnableError, TimeLimitError) as error:
        return LockChoice(name, Verdict.UNDECIDED, at, degrees, str(error))
    if not is_carried(found):
        why = f"for a model within 1e-12 of the numbers: {found.why}"
        return LockChoice(name, Verdict.UNDECIDED, at, degrees, why)
    why = f"locked at {math.degrees(at):.4g} deg: {found.why}"
    return LockChoice(name, found.verdict, at, degrees, why)


def _middle(chain: Chain, number: int) -> Angle:
    """0, or the middle of a range that does not hold 0."""
    limits = chain.joints[number - 1].limits
    if limits is None:
        return Angle()
    low, high = (
        end if isinstance(end, Angle) else Angle(radians=end) for end in limits
    )
    if angle_value(low) <= 0 <= angle_value(high):
        return Angle()
    return Span(low, high).middle
