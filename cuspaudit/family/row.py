"""One member of a family, decided: a row of the table of a sweep."""

from __future__ import annotations

import math
import time
from contextlib import suppress
from typing import Any

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.certify import find_witness
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    CuspauditError,
    InvalidRobotError,
    TimeLimitError,
    UnableError,
)
from cuspaudit.family.expressions import Value
from cuspaudit.family.family import Family, exact_text
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.fixed_motions import is_algebraic
from cuspaudit.robot.robot import COUNTS
from cuspaudit.robot.snapping import faithful
from cuspaudit.runtime.alarm import TimeUp, alarm
from cuspaudit.runtime.clock import Clock

__all__ = ["Row", "decide_member", "failed_member"]

Row = dict[str, Any]


def decide_member(family: Family, index: int, timeout: float | None = None) -> Row:
    """The row of a member; whatever goes wrong with it stands in the row's ``error``.

    The numbers are those of the family, not snapped: what a family says is meant.

    Args:
        family: the family.
        index: of the member.
        timeout: seconds it may take, or None; see `alarm` for where it works.
    """
    row = _parameters(family, index)
    begun = time.perf_counter()
    try:
        with alarm(timeout):
            row |= _decided(family, index)
    except CuspauditError as error:
        row["error"] = _one_line(error)
    except TimeUp:
        assert timeout is not None, "an alarm was set"
        row["error"] = str(TimeLimitError("member", timeout))
    except Exception as error:  # one bad member is a row, not the end of a sweep
        row["error"] = f"internal error: {type(error).__name__}: {_one_line(error)}"
    row["seconds"] = round(time.perf_counter() - begun, 4)
    return row


def failed_member(family: Family, index: int, why: str) -> Row:
    """The row of a member that could not be tried."""
    return _parameters(family, index) | {"error": why, "seconds": 0.0}


def _decided(family: Family, index: int) -> Row:
    chain = family.robot(index).chain
    # an exact model has every relation of the axes that there is
    model = exact_model(chain if is_algebraic(chain) else faithful(chain))
    case = Case(
        model,
        family.seed,
        certify=not model.is_exact,
        counts=_counts_alone(family),
    )
    found = decide(case, Clock())
    counts = {
        "cusps": found.cusps,
        "nodes": found.nodes,
        "aspects": found.aspects,
        "max_postures": found.postures,
    }
    row: Row = {
        "verdict": found.verdict.value,
        "proof": _proof(found),
        "exact": found.model.is_exact,
        "why": found.why if found.undecided else None,
    }
    row |= {
        name: _counted(found, counts[name]) for name in family.record if name in counts
    }
    if "within_limits" in family.record:
        row["within_limits"] = _within_limits(found, model.chain, family.seed)
    if "clearance" in family.record:
        row["clearance"] = _clearance(found, model.chain)
    if "tolerance" in family.record:
        row["tolerance"] = _tolerance(found, model.chain, family.seed)
    return row


def _tolerance(found: Answer, chain: Chain, seed: int) -> float | None:
    """How far, in lengths and in rad, all axes may be off; None where not proved."""
    # loaded only by the families that ask
    from cuspaudit.auditing.tolerance.over_tolerance import largest_tolerance

    return largest_tolerance(found, chain, seed)


def _counts_alone(family: Family) -> frozenset[str] | None:
    """The counts that are recorded; None where the run itself is needed."""
    wanted = frozenset(family.record)
    return wanted if wanted <= set(COUNTS) else None


def _within_limits(found: Answer, chain: Chain, seed: int) -> str | None:
    """The verdict within the limits of a member; None where it has none."""
    # loaded only by the families that ask
    from cuspaudit.auditing.limits.within_limits import within_limits

    within = within_limits(found, chain, seed, Clock())
    return None if within is None else within.verdict.value


def _proof(found: Answer) -> str:
    if found.verdict is Verdict.UNDECIDED:
        return "none"
    if found.witness is not None:
        return "witness"
    return "exact" if found.reduction is None else "reduction"


def _counted(found: Answer, count: Count | None) -> int | None:
    """A count that is proved, or that of a model where ``exact`` says it is one."""
    if count is None:
        return None
    of_model = found.is_exact_run and not found.model.is_exact
    return count.count if count.proved or of_model else None


def _clearance(found: Answer, chain: Chain) -> float | None:
    """The clearance of a certified witness; None where there is none."""
    if found.witness is not None:
        return found.witness.clearance
    if found.verdict is not Verdict.CUSPIDAL or not found.is_exact_run:
        return None
    try:
        return find_witness(found, chain).clearance
    except UnableError:
        return None


def _parameters(family: Family, index: int) -> Row:
    """The numbers of a member; without derived ones where one has no value."""
    values = family.values(index) or {}
    with suppress(InvalidRobotError):
        values = family.known(values)
    row: Row = {"index": index}
    for name, value in values.items():
        row[name] = _float(value)
        row[f"{name}_exact"] = exact_text(value)
    return row


def _float(value: Value) -> float:
    if isinstance(value, Angle):
        return float(value.half_turns) * math.pi + float(value.radians)
    return float(value)


def _one_line(error: BaseException) -> str:
    return " ".join(str(error).split())[:400]
