"""The verdict of an arm as a function of the value at which one joint is locked.

Three ways, in this order. *Idle*: a lock of the first joint moves the base alone, one
of the last joint of a pose task the tool alone, and neither changes a verdict: one
decision is that of every value. *Structures* (`structured`): a theorem whose identities
hold at every value. *Paths* (`witnessed`): a witness that moves with the value, proved
for intervals of it. What is left is open.

Within joint limits the values are those in the range of the joint. Noncuspidal without
limits is noncuspidal within any, and a path proves within them where it keeps inside.
"""

from __future__ import annotations

from collections.abc import Iterator

from cuspaudit.auditing.carried import is_carried
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.auditing.free_joint.moving_path import Locks
from cuspaudit.auditing.free_joint.stretch import (
    EXCEPTIONAL,
    FreeJoint,
    Stretch,
    joined,
)
from cuspaudit.auditing.free_joint.structured import by_structure
from cuspaudit.auditing.free_joint.witness_search import WitnessSearch
from cuspaudit.auditing.free_joint.witnessed import LockWalk
from cuspaudit.auditing.limits.joint_limits import rational_limits
from cuspaudit.auditing.limits.within_limits import within_limits
from cuspaudit.auditing.options import Options
from cuspaudit.certificate import Limits
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    DegenerateMapError,
    TimeLimitError,
)
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.locked.locked_arm import LockedArm, locked_arm
from cuspaudit.kinematics.locked.regular_over import is_singular_everywhere
from cuspaudit.kinematics.locked.span import WHOLE_CIRCLE, Span
from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.place import Place, listing, quoted
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snapping import snap
from cuspaudit.robot.task import DIMENSIONS
from cuspaudit.robot.virtual_joint import TOOL_AXES, with_virtual_joint
from cuspaudit.runtime.clock import Clock, time_limit

__all__ = ["free_joint", "lockable"]

_TASKS = ("position", "pose", *TOOL_AXES)
_OF_THE_NUMBERS = ("cusp", "witness", "apart")
"""Proofs within limits that hold for the numbers of a chain, whatever its model."""


def free_joint(
    robot: Robot, joint: str, options: Options | None = None, within: bool = False
) -> FreeJoint:
    """The verdicts of ``robot`` at every value of a joint.

    Args:
        robot: with one joint more than its task has dimensions.
        joint: the name of the joint to be locked; it turns.
        options: of the audits; the engine is not asked.
        within: within the joint limits, and over the range of the joint.

    Raises:
        DegenerateMapError: det J vanishes at every posture, whatever the value.
        InvalidRobotError: no such joint, one that slides, or as many joints as the
            task has dimensions.
    """
    options = options or Options()
    clock = Clock(options.timeout, options.progress)
    number = _number(robot, joint)
    with clock.stage("import"):
        chain, snapped = snap(robot.chain, options.snap)
        domain = _domain(chain, number) if within else WHOLE_CIRCLE
        chain = with_virtual_joint(chain)
        held = locked_arm(chain, number)
    with clock.stage("structures"):
        if is_singular_everywhere(held):
            raise DegenerateMapError(
                f"{robot.file}: det J vanishes at every posture whatever the value of "
                f"{joint}; lock another joint"
            )
    done: list[Stretch] = []
    stopped = None
    with time_limit(clock.left):
        try:
            for stretch in _stretches(held, domain, options.seed, within, clock):
                done.append(stretch)
        except TimeLimitError as late:
            stopped = str(late)
            begun = done[-1].span.upper if done else domain.lower
            rest = Span(begun, domain.upper)
            done.append(Stretch(rest, Verdict.UNDECIDED, "none", stopped))
    return FreeJoint(
        chain,
        number,
        domain,
        joined(done),
        within,
        bool(snapped),
        clock.seconds,
        options.seed,
        stopped,
    )


def lockable(robot: Robot) -> list[str]:
    """The names of the joints that turn, if one of them may be locked; else none."""
    chain = robot.chain
    if chain.task not in _TASKS or len(chain.joints) != DIMENSIONS[chain.task] + 1:
        return []
    return [joint.name for joint in chain.joints if joint.kind == "revolute"]


def _stretches(
    held: LockedArm, domain: Span, seed: int, within: bool, clock: Clock
) -> Iterator[Stretch]:
    idle = _if_idle(held, domain, seed, within, clock)
    if idle is not None:
        yield idle
        return
    locks = Locks(held.whole, held.number)
    clock.step("structures")
    with clock.stage("structures"):
        parts = joined(by_structure(held, domain))
    limits = _limits(locks) if within else None
    search = WitnessSearch(locks, seed, within)
    walk = LockWalk(locks, search.paths, limits, clock.step)
    for part in parts:
        if part.verdict is not Verdict.UNDECIDED or part.span.degrees <= EXCEPTIONAL:
            yield part
            continue
        walk.reason = part.why
        with clock.stage("witnesses"):
            yield from (search.remarked(each) for each in walk.over(part.span))


def _if_idle(
    held: LockedArm, domain: Span, seed: int, within: bool, clock: Clock
) -> Stretch | None:
    """The one verdict, where the value of the lock does not matter."""
    is_last = held.number == len(held.whole.joints) and held.whole.task == "pose"
    if held.number > 1 and not is_last:
        return None
    found = decide(
        Case(exact_model(Locks(held.whole, held.number).at(Angle())), seed), clock
    )
    moved = "tool" if is_last else "base"
    why = f"the value moves the {moved} alone; {found.why}"
    verdict = found.verdict if is_carried(found) else Verdict.UNDECIDED
    if within and verdict is not Verdict.NONCUSPIDAL:
        inside = within_limits(found, found.model.chain, seed, clock)
        if inside is not None:
            why = f"the value moves the {moved} alone; {inside.why}"
            is_proved = found.model.is_exact or inside.kind in _OF_THE_NUMBERS
            verdict = inside.verdict if is_proved else Verdict.UNDECIDED
    kind = "none" if verdict is Verdict.UNDECIDED else "idle"
    return Stretch(domain, verdict, kind, why)


def _limits(locks: Locks) -> Limits:
    """The limits of the joints that are left."""
    return rational_limits(locks.at(Angle()))


def _number(robot: Robot, joint: str) -> int:
    """The number of the joint that is meant, from 1.

    Raises:
        InvalidRobotError: there is none, or it cannot be locked.
    """
    chain, place = robot.chain, Place(robot.file, "--free")
    names = [each.name for each in chain.joints]
    if joint not in names:
        found = f"no joint is named {quoted(joint)}"
        raise place.error(found, f"the joints are {listing(names, most=50)}")
    if chain.task not in _TASKS or len(names) != DIMENSIONS[chain.task] + 1:
        found = f"{len(names)} joints for the task {chain.task}"
        expected = "a joint to spare is needed: 7 for a pose, 4 for a position"
        raise place.error(found, expected)
    number = names.index(joint) + 1
    if chain.joints[number - 1].kind != "revolute":
        found = f"{quoted(joint)} slides"
        raise place.error(found, "name a joint that turns, or lock it by --lock")
    return number


def _domain(chain: Chain, number: int) -> Span:
    """The range of a joint; the whole circle where it has none."""
    limits = chain.joints[number - 1].limits
    if limits is None or limits[0] == limits[1]:
        return WHOLE_CIRCLE
    low, high = (
        end if isinstance(end, Angle) else Angle(radians=end) for end in limits
    )
    return Span(low, high)
