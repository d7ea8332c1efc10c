"""The audit of one robot: decide, certify, cross-check."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from cuspaudit.auditing.advice import advice_on_degeneracy, advice_without_angle
from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.auditing.case import HAIR_POSES, Case
from cuspaudit.auditing.crosscheck.compare import CrossCheck, crosscheck
from cuspaudit.auditing.crosscheck.pinocchio_model import is_readable
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.auditing.deciders.registry import HAIR
from cuspaudit.auditing.options import Options
from cuspaudit.auditing.record import Audit
from cuspaudit.auditing.structure_certificate import structure_certificate
from cuspaudit.auditing.structures import near_structures, why_undecided
from cuspaudit.auditing.within_limits import within_limits
from cuspaudit.auditing.witness import Witness
from cuspaudit.certificate.margin import margin_of
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    AssumptionError,
    DegenerateMapError,
    NoAngleError,
    UnableError,
)
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snapping import Snapped, snap
from cuspaudit.robot.virtual_joint import with_virtual_joint
from cuspaudit.runtime.clock import Clock, time_limit

__all__ = ["Audit", "Options", "audit"]


def audit(robot: Robot, options: Options | None = None) -> Audit:
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
        literal = with_virtual_joint(robot.chain)
        case = Case(exact_model(chain), literal, options.seed, options.engine)
    with time_limit(clock.left):
        found = _decide(robot, case, clock)
        with clock.stage("aspects"):
            found = _with_aspects(found, clock)
    with clock.stage("margin"):
        margin = margin_of(found.witness.certificate) if found.witness else None
    with clock.stage("structures"):
        structures = near_structures(found)
    with clock.stage("limits"):
        within = within_limits(found, literal, options.seed, clock)
    with clock.stage("literal"):
        with time_limit(clock.left):
            verdict, proof = _literal(replace(case, so_far=found), clock)
        why = None
        if verdict is Verdict.UNDECIDED:
            why = why_undecided(exact_model(literal))
    with clock.stage("crosscheck"):
        clock.step("crosscheck", always=True)
        check = _check(robot, found, snapped, options)
    return Audit(
        robot,
        chain,
        snapped,
        found,
        verdict,
        check,
        clock.seconds,
        options.seed,
        options.snap,
        proof,
        structures,
        why,
        within,
        margin,
    )


def _decide(robot: Robot, case: Case, clock: Clock) -> Answer:
    try:
        return decide(case, clock)
    except NoAngleError as error:
        advice = advice_without_angle(case.model)
        raise NoAngleError(error.joints, robot.file, advice) from None
    except DegenerateMapError:
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


def _literal(case: Case, clock: Clock) -> tuple[Verdict, Witness | None]:
    """The verdict for the numbers exactly as the file has them, and its own witness.

    CUSPIDAL with a certificate for them; without one either verdict only if their
    model is exact: what holds within 1e-12 rad of them may hold for the model alone.
    Else NONCUSPIDAL with a structure certificate for them.

    Args:
        case: the arm, with the answer for its model.
        clock: of the audit.
    """
    found, literal = case.so_far, case.literal
    assert found is not None, "the model was decided"
    if found.witness is not None and found.witness.chain == literal:
        return Verdict.CUSPIDAL, None
    if literal != found.model.chain:
        try:
            other = Case(exact_model(literal), literal, case.seed, poses=HAIR_POSES)
            found = decide(other, Clock(clock.left, clock.tell), HAIR)
        except (UnableError, AssumptionError):
            return _by_structure(literal), None
    if found.witness is None and not found.model.is_exact:
        return _by_structure(literal), None
    return found.verdict, found.witness


def _by_structure(chain: Chain) -> Verdict:
    """NONCUSPIDAL where the relations of a theorem are proved for these numbers."""
    proved = structure_certificate(chain) is not None
    return Verdict.NONCUSPIDAL if proved else Verdict.UNDECIDED


def _check(
    robot: Robot,
    found: Answer,
    snapped: Sequence[Snapped],
    options: Options,
) -> CrossCheck:
    literal = exact_model(robot.chain) if snapped else None
    urdf = robot.urdf if robot.urdf and is_readable(robot.urdf) else None
    witness = found.witness
    return crosscheck(
        found.model,
        urdf=urdf,
        literal=literal,
        locked=robot.locked,
        path=None if witness is None else list(witness.path),
        path_is_literal=literal is None
        or (witness is not None and witness.chain == literal.chain),
        seed=options.seed,
    )
