"""The audit of one robot: decide, certify, cross-check."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.as_written import as_written
from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.auditing.carried import carried
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.crosscheck.compare import CrossCheck, crosscheck
from cuspaudit.auditing.crosscheck.pinocchio_model import is_readable
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.auditing.limits.joint_limits import has_limits
from cuspaudit.auditing.options import Options
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.auditing.structures import (
    JudgedStructure,
    near_structures,
    why_undecided,
)
from cuspaudit.auditing.witness import CertifiedPath
from cuspaudit.certificate.margin import margin_of
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    DegenerateMapError,
    NoAngleError,
    TimeLimitError,
)
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snapping import faithful, snap
from cuspaudit.robot.tolerance import AxisTolerance
from cuspaudit.robot.virtual_joint import with_virtual_joint
from cuspaudit.runtime.clock import Clock, time_limit

if TYPE_CHECKING:
    from cuspaudit.auditing.limits.limits_result import LimitsAnswer
    from cuspaudit.auditing.tolerance.over_tolerance import OverTolerance
    from cuspaudit.robot.chain import Chain

__all__ = ["FinishedAudit", "Options", "audit"]

Found = TypeVar("Found")

_GRACE = 0.5
"""Seconds after the time limit in which what is nearly free may still be found."""

_SEEN = 1e-10
"""The least clearance of a path that the cross-check looks at in floating point."""


def audit(robot: Robot, options: Options | None = None) -> FinishedAudit:
    """Audit ``robot``: verdict, proof, witness and cross-check.

    Raises:
        AssumptionError: a hypothesis fails: no verdict exists by this route.
        CrossCheckError: exact and numeric answers disagree; then there is no verdict.
        InvalidRobotError: Pinocchio cannot read the robot's URDF.
    """
    options = options or Options()
    clock = Clock(options.timeout, options.progress)
    with clock.stage("import"):
        chain, snapped = snap(robot.chain, options.snap)
        case = Case(exact_model(chain), options.seed, options.engine)
    with time_limit(clock.left):
        found = _decide(robot, case, clock)
        with clock.stage("aspects"):
            found = carried(_with_aspects(found, clock))
    with clock.stage("structures"):
        none: tuple[JudgedStructure, ...] = ()
        structures = _in_time(clock, lambda: near_structures(found), none)
    with clock.stage("limits"):
        written = with_virtual_joint(robot.chain)
        with time_limit(None if clock.left is None else clock.left + _GRACE):
            within = _within_limits(found, written, options.seed, clock)
    with clock.stage("literal"):
        with time_limit(clock.left):
            literal = as_written(robot.chain, found, snapped, options.seed, clock)
        why = literal.cusp_sentence
        if literal.verdict is Verdict.UNDECIDED:
            model = exact_model(faithful(robot.chain))
            why = _in_time(clock, lambda: why_undecided(model), None)
    with clock.stage("margin"):
        shown = (literal.is_same_path and literal.witness) or found.witness
        is_late = clock.left == 0.0
        margin = margin_of(shown.certificate) if shown and not is_late else None
    over, allowed = None, options.tolerance or robot.tolerance
    if allowed is not None or robot.loose:
        with clock.stage("tolerance"):
            path = shown or None
            over = _over_tolerance(robot, allowed, found, path, options.seed, clock)
    with clock.stage("crosscheck"):
        clock.step("crosscheck", always=True)
        check = _check(robot, found, literal.witness, options)
    return FinishedAudit(
        robot,
        chain,
        snapped,
        found,
        literal,
        check,
        clock.seconds,
        options.seed,
        options.snap,
        structures,
        why,
        within,
        margin,
        over,
    )


def _within_limits(
    found: Answer, literal: Chain, seed: int, clock: Clock
) -> LimitsAnswer | None:
    """The verdict within limits; an arm without any loads nothing for it."""
    if not has_limits(found.model.chain):
        return None
    from cuspaudit.auditing.limits.within_limits import within_limits

    return within_limits(found, literal, seed, clock)


def _over_tolerance(
    robot: Robot,
    allowed: AxisTolerance | None,
    found: Answer,
    witness: CertifiedPath | None,
    seed: int,
    clock: Clock,
) -> OverTolerance:
    """The verdict over a tolerance; an audit without one loads nothing for it."""
    from cuspaudit.auditing.tolerance.box import box_of
    from cuspaudit.auditing.tolerance.over_tolerance import over_tolerance

    literal = with_virtual_joint(robot.chain)
    box = box_of(literal, allowed, robot.loose)
    with time_limit(clock.left):
        return over_tolerance(box, found, literal, witness, seed, clock)


def _in_time(clock: Clock, work: Callable[[], Found], instead: Found) -> Found:
    """What an extra comes to; ``instead`` when it goes on after the time limit."""
    try:
        with time_limit(None if clock.left is None else clock.left + _GRACE):
            return work()
    except TimeLimitError:
        return instead


def _decide(robot: Robot, case: Case, clock: Clock) -> Answer:
    try:
        return decide(case, clock)
    except NoAngleError as error:
        from cuspaudit.auditing.advice import advice_without_angle  # rarely given

        advice = advice_without_angle(case.model)
        raise NoAngleError(error.joints, robot.file, advice) from None
    except DegenerateMapError:
        from cuspaudit.auditing.advice import advice_on_degeneracy

        said = advice_on_degeneracy(robot, case.model)
        raise DegenerateMapError(f"{robot.file}: {said}") from None


def _with_aspects(found: Answer, clock: Clock) -> Answer:
    """With the aspects on a torus counted by covers, in a third of the time.

    Without a time limit none are made: a cover may take minutes.
    """
    seconds = clock.left
    if found.aspects is not None or not seconds or len(found.model.joints) == 3:
        return found
    clock.step("aspects")
    # one cover for each sign of det J, and as much for what follows
    return replace(found, aspects=count_aspects(found.model, seconds / 3))


def _check(
    robot: Robot, found: Answer, witness: CertifiedPath | None, options: Options
) -> CrossCheck:
    """The comparison with Pinocchio, of both models where they are two.

    The numbers of the file stand for themselves by their invariants, which are shorter.
    A path so near to a singularity that floating point does not see it from there is
    proved in balls, and not compared.
    """
    is_snapped = with_virtual_joint(robot.chain) != found.model.chain
    literal = exact_model(faithful(robot.chain)) if is_snapped else None
    urdf = robot.urdf if robot.urdf and is_readable(robot.urdf) else None
    shown = witness or found.witness
    if shown is not None and shown.clearance is not None:
        shown = shown if shown.clearance > _SEEN else None
    return crosscheck(
        found.model,
        urdf=urdf,
        literal=literal,
        locked=robot.locked,
        path=None if shown is None else list(shown.path),
        path_is_literal=literal is None or witness is not None,
        seed=options.seed,
    )
