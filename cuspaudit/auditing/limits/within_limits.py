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
  within their limits the arm is within its own. The other way asks more of a wrist: a
  path of the three is lifted to all six where one is met that the wrist can follow.
- *Pairs apart*, for small boxes of six joints (`auditing.limits.pairs_apart`).
- *A search* for a path inside the limits of six joints (`search.box_search`).

Each is about the model that the verdict is about; a proof for the numbers of the file
is added where there is one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain as chain_of
from itertools import islice

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.cusp_witness import CuspWitness, find_cusps, same_cusp
from cuspaudit.auditing.limits.joint_limits import has_limits, interval_of
from cuspaudit.auditing.limits.limits_by_three import box_of, by_three, with_path
from cuspaudit.auditing.limits.limits_result import FreeWitness, LimitsAnswer
from cuspaudit.auditing.limits.limits_witness import (
    first_proved,
    limited,
    paths_of_cusps,
    shown,
)
from cuspaudit.auditing.limits.pairs_apart import pairs_apart
from cuspaudit.auditing.limits.three_in_box import aspects_in_box
from cuspaudit.auditing.search.box_search import paths_inside
from cuspaudit.auditing.witness import CertifiedPath
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.robot.chain import Chain
from cuspaudit.runtime.clock import Clock

__all__ = ["within_limits"]

_CUSPS = 2
_TRIES = 12


def within_limits(
    found: Answer, literal: Chain, seed: int, clock: Clock
) -> LimitsAnswer | None:
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
    nothing = LimitsAnswer(
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
        result = _cuspidal(nothing, found, literal, seed) or by_three(
            nothing, found, literal, clock
        )
        if result is None or result.verdict is Verdict.UNDECIDED:
            open_ = result or replace(nothing, why=_open_sentence(found))
            return _of_six(open_, found, literal, seed)
        if result.verdict is Verdict.CUSPIDAL and result.witness is None:
            return _to_look_at(result, found, literal, seed, clock)
    except (UnableError, RetryableError) as error:
        return replace(nothing, why=str(error))
    return result


def _of_six(
    open_: LimitsAnswer, found: Answer, literal: Chain, seed: int
) -> LimitsAnswer:
    """Six joints: that no pairs of postures are in one aspect, or a path searched."""
    if found.model.chain.task != "pose":
        return open_
    apart = pairs_apart(found.model)
    if apart is not None:
        return replace(
            open_,
            verdict=Verdict.NONCUSPIDAL,
            why=apart.sentence(),
            kind="apart",
            rests_on=("ball arithmetic",),
        )
    witness = _searched(found, literal, seed)
    if witness is None:
        why = f"{open_.why}; a search inside the limits met no path that was proved"
        return replace(open_, why=why)
    return shown(
        replace(
            open_,
            verdict=Verdict.CUSPIDAL,
            why="a search inside the limits met a path between postures of one pose",
            kind="witness",
            rests_on=("ball arithmetic",),
        ),
        witness,
    )


def _searched(found: Answer, literal: Chain, seed: int) -> CertifiedPath | None:
    """A path that a search inside the limits of six joints meets."""
    chain = found.model.chain
    limits = [interval_of(joint) for joint in chain.joints]
    paths = islice(paths_inside(chain, limits, seed), _TRIES)
    return first_proved(paths, (literal, chain))


def _to_look_at(
    result: LimitsAnswer, found: Answer, literal: Chain, seed: int, clock: Clock
) -> LimitsAnswer:
    """A CUSPIDAL by a cusp alone, with a path to look at where one is met."""
    if result.kind != "cusp":
        return result
    try:
        box = box_of(found, clock)
        if box is not None:
            result = with_path(result, found, box, literal)
        if result.witness is None and found.model.chain.task == "pose":
            result = shown(result, _searched(found, literal, seed))
    except (UnableError, RetryableError):
        pass
    return result


def _cuspidal(
    nothing: LimitsAnswer, found: Answer, literal: Chain, seed: int
) -> LimitsAnswer | None:
    """CUSPIDAL by the free witness or by a cusp, with a path where one is proved."""
    chain = found.model.chain
    if found.witness is not None and nothing.free is not None and nothing.free.inside:
        witness = limited(found.witness.path, chain)
        if witness is not None:
            return _by_path(nothing, found.witness, witness, literal)
    if chain.task not in ("position", "pose"):
        return None
    cusps = list(islice(_cusps(found, seed), 1))
    if not cusps:
        return None
    best = _by_cusp(nothing, same_cusp(cusps[0], literal) or cusps[0])
    paths = paths_of_cusps(chain_of(cusps, islice(_cusps(found, seed), 1, _CUSPS)))
    return shown(best, first_proved(paths, (literal, chain)))


def _cusps(found: Answer, seed: int) -> Iterator[CuspWitness]:
    """Cusps inside the limits, the one that the answer has first; searched late."""
    own = found.cusp
    if own is not None and own.is_inside:
        yield own
    for cusp in find_cusps(found.model.chain, seed):
        if own is None or cusp.posture != own.posture:
            yield cusp


def _by_path(
    nothing: LimitsAnswer, free: CertifiedPath, witness: CertifiedPath, literal: Chain
) -> LimitsAnswer:
    """By a path of the model, shown for the numbers of the file where it is one."""
    witness = limited(free.path, literal) or witness
    result = replace(
        nothing,
        verdict=Verdict.CUSPIDAL,
        why="the path found without limits stays inside them",
        kind="witness",
        rests_on=("ball arithmetic",),
    )
    return shown(result, replace(witness, clearance=free.clearance))


def _by_cusp(nothing: LimitsAnswer, cusp: CuspWitness) -> LimitsAnswer:
    at = ", ".join(f"{value:.4g}" for value in cusp.posture)
    return replace(
        nothing,
        verdict=Verdict.CUSPIDAL,
        why=f"the map has a cusp inside the limits, at ({at})",
        kind="cusp",
        rests_on=("ball arithmetic",),
        cusp=cusp,
    )


def _free(witness: CertifiedPath | None) -> FreeWitness | None:
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
