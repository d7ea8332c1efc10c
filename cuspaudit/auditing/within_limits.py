"""The verdict of an arm within its joint limits.

The joint space is a product of circles (joints without limits) and open intervals, and
an arm is cuspidal within limits when two joint vectors of one pose that are different
postures lie in one component of {det J != 0} there. What decides, in the order tried:

- *Monotony.* An inclusion of joint spaces keeps det J, the pose and which postures are
  different: noncuspidal without limits is noncuspidal within any.
- *A cusp inside.* Two such postures lie as near to a cusp as one likes
  (`certificate.cusp_proof`): one inside the limits makes the arm cuspidal within them.
- *The free witness*, where its path stays inside.
- *Three joints*: exactly and completely, by pairs of postures or by sample values
  (`cuspidality.box_decision`, `cuspidality.box_values`).
- *A wrist.* The first three joints (from tip to base, the last three) of an arm that a
  theorem leads to: postures of one pose in one aspect of the arm give two of one place
  in one aspect of the three, all inside their limits, so where those are noncuspidal
  within their limits the arm is within its own. (The other way asks more of a wrist.)

Each is about the model that the verdict is about; a proof for the numbers of the file
is added where there is one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.cusp_witness import CuspWitness, find_cusps, same_cusp
from cuspaudit.auditing.joint_limits import (
    has_limits,
    interval_of,
    rational_limits,
)
from cuspaudit.auditing.search.around_cusp import paths_around, slack_of
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.three_in_box import ThreeInBox, aspects_in_box, decide_three
from cuspaudit.auditing.witness import Witness, certified
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.robot.chain import Chain
from cuspaudit.runtime.clock import Clock, check_time

__all__ = ["FreeWitness", "WithinLimits", "within_limits"]

Array = NDArray[np.float64]

_EXACT = ("FLINT resultants", "FLINT root isolation", "ball arithmetic")
_WRISTS = ("spherical wrist", "spherical shoulder")
_CUSPS = 2
_PATHS = 4


@dataclass(frozen=True)
class FreeWitness:
    """Whether the path that is shown without limits stays inside them.

    Attributes:
        inside: whether it does.
        leaves: the first joint that leaves its limits, and where; None if inside.
    """

    inside: bool
    leaves: str | None


@dataclass(frozen=True, eq=False)
class WithinLimits:
    """The verdict within joint limits, and its grounds.

    Attributes:
        verdict: one of three.
        why: one sentence.
        kind: of the proof: "monotony", "cusp", "witness", "exact", "reduction", "none".
        rests_on: what it rests on.
        joints: name, lower and upper limit of each joint of the robot.
        aspects: components of {det J != 0} within the limits; None if not counted.
        witness: a path inside the limits, proved; for the literal chain if possible.
        cusp: inside the limits, proved.
        slack: how near the path comes to a limit, rad or the unit of length.
        free: of the path that is the witness without limits; None without one.
    """

    verdict: Verdict
    why: str
    kind: str
    rests_on: tuple[str, ...]
    joints: tuple[tuple[str, float | None, float | None], ...]
    aspects: Count | None = None
    witness: Witness | None = None
    cusp: CuspWitness | None = None
    slack: float | None = None
    free: FreeWitness | None = None

    def record(self, certificate: str | None = None) -> dict[str, Any]:
        """The key ``limits`` of an audit's JSON."""
        counted = self.aspects or Count(0, False)
        return {
            "verdict": self.verdict.value,
            "why": self.why,
            "proof": {"kind": self.kind, "rests_on": list(self.rests_on)},
            "joints": [
                {"name": name, "lower": lower, "upper": upper}
                for name, lower, upper in self.joints
            ],
            "aspects": {
                "count": counted.count if self.aspects else None,
                "proved": counted.proved,
            },
            "witness": self._witness(certificate),
            "cuts": None,
            "of_the_free_witness": None
            if self.free is None
            else {"inside": self.free.inside, "leaves": self.free.leaves},
        }

    def _witness(self, certificate: str | None) -> dict[str, Any] | None:
        own = len(self.joints)
        if self.witness is None:
            return None
        path = [[float(v) for v in row[:own]] for row in self.witness.path]
        return {
            "postures": [path[0], path[-1]],
            "path": path,
            "clearance": self.witness.clearance,
            "slack": self.slack,
            "certificate": certificate,
        }


def within_limits(
    found: Answer, literal: Chain, seed: int, clock: Clock
) -> WithinLimits | None:
    """The verdict within the limits of an arm, None where it has none.

    Args:
        found: the answer without limits.
        literal: the chain as the file has it, a virtual joint included.
        seed: of every random choice.
        clock: of the audit.
    """
    chain = found.model.chain
    if not has_limits(chain):
        return None
    joints = tuple(
        (joint.name, *(interval_of(joint) or (None, None)))
        for joint in chain.joints
        if not joint.is_virtual
    )
    nothing = WithinLimits(
        Verdict.UNDECIDED, "", "none", (), joints, free=_free(found.witness)
    )
    nothing = replace(nothing, aspects=aspects_in_box(found.model))
    if found.verdict is Verdict.NONCUSPIDAL:
        return replace(
            nothing,
            verdict=Verdict.NONCUSPIDAL,
            why="noncuspidal without limits, and limits only take motions away",
            kind="monotony",
            rests_on=found.rests_on,
        )
    clock.step("limits", always=True)
    try:
        result = _cuspidal(nothing, found, literal, seed) or _exactly(
            nothing, found, clock
        )
    except (UnableError, RetryableError) as error:
        return replace(nothing, why=str(error))
    return result or replace(nothing, why=_open_sentence(found))


def _cuspidal(
    nothing: WithinLimits, found: Answer, literal: Chain, seed: int
) -> WithinLimits | None:
    """CUSPIDAL by the free witness or by a cusp, with a path where one is proved."""
    chain = found.model.chain
    if found.witness is not None and nothing.free is not None and nothing.free.inside:
        witness = _limited(found.witness.path, chain)
        if witness is not None:
            return _by_path(nothing, found.witness, witness, literal)
    if chain.task not in ("position", "pose"):
        return None
    cusps = [found.cusp] if found.cusp is not None and found.cusp.is_inside else []
    cusps += list(islice(find_cusps(chain, seed), _CUSPS - len(cusps)))
    if not cusps:
        return None
    best = _by_cusp(nothing, same_cusp(cusps[0], literal) or cusps[0])
    for witness in _around(cusps, literal):
        return replace(best, witness=witness, slack=_slack(witness))
    return best


def _by_path(
    nothing: WithinLimits, free: Witness, witness: Witness, literal: Chain
) -> WithinLimits:
    """By a path of the model, shown for the numbers of the file where it is one."""
    witness = _limited(free.path, literal) or witness
    return replace(
        nothing,
        verdict=Verdict.CUSPIDAL,
        why="the path found without limits stays inside them",
        kind="witness",
        rests_on=("ball arithmetic",),
        witness=replace(witness, clearance=free.clearance),
        slack=_slack(witness),
    )


def _slack(witness: Witness) -> float:
    limits = [interval_of(joint) for joint in witness.chain.joints]
    return slack_of(witness.path, limits)


def _by_cusp(nothing: WithinLimits, cusp: CuspWitness) -> WithinLimits:
    at = ", ".join(f"{value:.4g}" for value in cusp.posture)
    return replace(
        nothing,
        verdict=Verdict.CUSPIDAL,
        why=f"the map has a cusp inside the limits, at ({at})",
        kind="cusp",
        rests_on=("ball arithmetic",),
        cusp=cusp,
    )


def _around(cusps: list[CuspWitness], literal: Chain) -> Iterator[Witness]:
    """Proved paths round cusps inside the limits, for the literal chain if possible."""
    for cusp in cusps:
        limits = [interval_of(joint) for joint in cusp.chain.joints]
        for path in islice(paths_around(cusp.chain, cusp.posture, limits), _PATHS):
            for chain in dict.fromkeys((literal, cusp.chain)):
                check_time("limits")
                witness = _limited(path, chain)
                if witness is not None:
                    yield witness


def _limited(path: Array, chain: Chain) -> Witness | None:
    """The path as a witness within the limits of a chain, if it is proved."""
    try:
        closed = close(chain, path)
    except RetryableError:
        return None
    witness = certified(chain, closed, limits=rational_limits(chain))
    return witness if witness.verification.accepted else None


def _exactly(nothing: WithinLimits, found: Answer, clock: Clock) -> WithinLimits | None:
    """What the exact routes for three joints say, of the arm or of its first three."""
    if found.model.chain.task == "position":
        return _of_three(nothing, decide_three(found.model, clock))
    reduction = found.reduction
    if reduction is None or reduction.regional is None:
        return None
    if reduction.kind not in _WRISTS:
        return None
    three = _of_three(nothing, decide_three(reduction.regional, clock))
    if three.verdict is not Verdict.NONCUSPIDAL:
        return None
    why = (
        f"{reduction.kind}: the three joints that place its centre are noncuspidal "
        f"within their limits; {three.why}"
    )
    return replace(three, why=why, kind="reduction", aspects=nothing.aspects)


def _of_three(nothing: WithinLimits, box: ThreeInBox) -> WithinLimits:
    decided = box.verdict is not Verdict.UNDECIDED
    return replace(
        nothing,
        verdict=box.verdict,
        why=box.why,
        kind="exact" if decided else "none",
        rests_on=_EXACT if decided else (),
        aspects=box.aspects,
    )


def _free(witness: Witness | None) -> FreeWitness | None:
    """Where the witness without limits leaves them."""
    if witness is None:
        return None
    for k, joint in enumerate(witness.chain.joints):
        pair = interval_of(joint)
        if pair is None:
            continue
        column = witness.path[:, k]
        for value, limit in ((column.min(), pair[0]), (column.max(), pair[1])):
            outside = value <= limit if limit == pair[0] else value >= limit
            if outside:
                unit = " rad" if joint.kind == "revolute" else ""
                where = f"{joint.name} at {value:.3g}{unit}, limit {limit:.3g}"
                return FreeWitness(False, where)
    return FreeWitness(True, None)


def _open_sentence(found: Answer) -> str:
    tried = "no cusp inside the limits was met by Newton's method from random postures"
    if found.verdict is Verdict.CUSPIDAL:
        return f"{tried}, and the path found without limits leaves them"
    return f"there is no verdict without limits either, and {tried}"
