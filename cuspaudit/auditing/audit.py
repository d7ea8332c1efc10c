"""The audit of one robot: decide, certify, cross-check."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from cuspaudit.auditing.answer import Answer, Undecided, answer
from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.auditing.crosscheck.compare import CrossCheck, crosscheck
from cuspaudit.auditing.crosscheck.pinocchio_model import is_readable
from cuspaudit.auditing.deciders.by_pairs import needs_pairs, not_asked, searched_pairs
from cuspaudit.auditing.deciders.by_search import (
    HAIR_POSES,
    crowd_of,
    needs_search,
    searched,
    with_crowd,
)
from cuspaudit.auditing.options import Clock, Options
from cuspaudit.auditing.record import Audit
from cuspaudit.auditing.witness import Witness, find_witness
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    AssumptionError,
    DegenerateMapError,
    NoAngleError,
    UnableError,
)
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.neighbors import coincide, parallel
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snapping import Snapped, snap
from cuspaudit.robot.virtual_joint import with_virtual_joint, without_virtual_joint

__all__ = ["Audit", "Options", "audit"]


def audit(robot: Robot, options: Options | None = None) -> Audit:
    """Audit ``robot``: verdict, proof, witness and cross-check.

    Raises:
        AssumptionError: a hypothesis fails: no verdict exists by this route.
        CrossCheckError: exact and numeric answers disagree; then there is no verdict.
        InvalidRobotError: Pinocchio cannot read the robot's URDF.
    """
    options = options or Options()
    clock = Clock(options)
    with clock.stage("import"):
        chain, snapped = snap(robot.chain, options.snap)
        model, literal = exact_model(chain), with_virtual_joint(robot.chain)
    with clock.stage("decide"):
        found = _decide(robot, model, clock)
    with clock.stage("certify"):
        found, witness = _certify(found, literal, clock)
    crowd = None
    with clock.stage("search"):
        if needs_search(found):
            crowd = crowd_of(found, options.seed, clock.step)
            found, witness = searched(found, literal, options.seed, clock.step)
    with clock.stage("pairs"):
        if needs_pairs(found):
            found, witness = _by_pairs(found, literal, clock)
    found = with_crowd(found, crowd)
    with clock.stage("aspects"):
        found = _with_aspects(found, clock)
    with clock.stage("literal"):
        verdict, proof = _literal(literal, found, witness, options.seed, clock)
    with clock.stage("crosscheck"):
        clock.step("crosscheck", always=True)
        check = _check(robot, found, snapped, witness, options)
    return Audit(
        robot,
        chain,
        snapped,
        found,
        found.verdict,
        witness,
        verdict,
        check,
        clock.seconds,
        options.seed,
        options.snap,
        proof,
    )


def _decide(robot: Robot, model: ExactModel, clock: Clock) -> Answer:
    try:
        found = answer(model, clock.step, clock.engine)
        by_pairs = found.by_pairs is not None or model.chain.task == "position"
        return found if by_pairs or clock.engine != "pairs" else not_asked(model)
    except NoAngleError as error:
        raise NoAngleError(error.joints, robot.file) from None
    except DegenerateMapError as error:
        chain = without_virtual_joint(model.chain)
        raise DegenerateMapError(
            f"{robot.file}: {error}, so {chain.tip} never moves with the full freedom "
            f"of the task {chain.task}; {_remedy(model)}"
        ) from None


def _remedy(model: ExactModel) -> str:
    """What to ask instead of a task in which det J vanishes everywhere."""
    *_, last, tool = model.chain.joints
    if tool.is_virtual and parallel(model, 5) and coincide(model, 5):
        return (
            f"{last.name} turns about the tool axis itself: choose another axis of the "
            f"tip, or lock it (--lock {last.name}=0), which leaves position-and-angle"
        )
    return "choose another tip (--tip), task or joint to lock"


def _by_pairs(
    found: Answer, literal: Chain, clock: Clock
) -> tuple[Answer, Witness | None]:
    """What the pairs of postures add, as far as the time reaches."""
    try:
        return searched_pairs(found, literal, clock.seed, clock.step)
    except UnableError:
        return found, None


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


def _certify(
    found: Answer, literal: Chain, clock: Clock
) -> tuple[Answer, Witness | None]:
    """A witness for the literal numbers, or for the model's if those resist.

    Without a proved path there is no CUSPIDAL: the answer is then UNDECIDED.
    """
    if found.verdict is not Verdict.CUSPIDAL:
        return found, None
    clock.step("certificate", always=True)
    failure: UnableError | None = None
    for chain in dict.fromkeys((literal, found.model.chain)):
        try:
            return found, find_witness(found, chain)
        except UnableError as limit:
            failure = limit
    why = f"there is a cuspidal couple, but its path resists proof: {failure}"
    reason = Undecided("certificate", why, (), "a path farther from singular postures")
    undecided = replace(
        found, verdict=Verdict.UNDECIDED, why=why, rests_on=(), undecided=reason
    )
    return undecided, None


def _literal(
    literal: Chain, found: Answer, witness: Witness | None, seed: int, clock: Clock
) -> tuple[Verdict, Witness | None]:
    """The verdict for the numbers exactly as the file has them, and its own witness.

    CUSPIDAL with a certificate for them; without one either verdict only if their
    model is exact: what holds within 1e-12 rad of them may hold for the model alone.
    """
    if witness is not None and witness.chain == literal:
        return Verdict.CUSPIDAL, None
    proof = None
    try:
        same = literal == found.model.chain
        other = found if same else answer(exact_model(literal), clock.step)
        if other.verdict is Verdict.CUSPIDAL and other.decision is not None:
            proof = find_witness(other, literal)
        elif needs_search(other) and not same:
            other, proof = searched(other, literal, seed, clock.step, HAIR_POSES)
    except (UnableError, AssumptionError):
        return Verdict.UNDECIDED, None
    if proof is None and not other.model.is_exact:
        return Verdict.UNDECIDED, None
    return other.verdict, proof


def _check(
    robot: Robot,
    found: Answer,
    snapped: Sequence[Snapped],
    witness: Witness | None,
    options: Options,
) -> CrossCheck:
    literal = exact_model(robot.chain) if snapped else None
    urdf = robot.urdf if robot.urdf and is_readable(robot.urdf) else None
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
