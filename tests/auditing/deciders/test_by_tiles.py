"""Tiles of pairs come in where sample values did not come to an end."""

from __future__ import annotations

from dataclasses import replace

from short_tables import arm

from cuspaudit.auditing.answer import stopped
from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.by_tiles import by_tiles
from cuspaudit.auditing.options import Options
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import TimeLimitError
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.robot.library import open_robot
from cuspaudit.runtime.clock import Clock, time_limit

NONCUSPIDAL = (("2.59", "1.36", "1.59"), (0, "0.7", 0), (90, 90, 0))
CUSPIDAL = ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))


def test_a_noncuspidal_arm_is_decided_after_the_time() -> None:
    """Where the time limit ended the sample values, tiles have half a second."""
    case = _stopped(exact_model(arm(*NONCUSPIDAL)))
    with time_limit(0.0):
        found = by_tiles(case, Clock(0.0))
    assert found is not None
    assert (found.verdict, found.engine) == (Verdict.NONCUSPIDAL, "tiles")
    assert found.aspects is not None
    assert (found.aspects.count, found.aspects.proved) == (4, True)


def test_a_couple_without_a_path_is_no_answer_where_one_is_asked() -> None:
    """A CUSPIDAL with a certificate is left to the ways that give one."""
    case = _stopped(exact_model(arm(*CUSPIDAL)))
    assert by_tiles(case, Clock()) is None
    alone = by_tiles(replace(case, certify=False), Clock())
    assert alone is not None
    assert alone.verdict is Verdict.CUSPIDAL


def test_an_audit_without_time_still_tells_a_noncuspidal_arm() -> None:
    """The regional arm of a PUMA has parallel neighbours; no limit is too short."""
    found = audit(open_robot("puma-560"), Options(timeout=0.0))
    assert found.verdict is Verdict.UNDECIDED  # the theorem on wrists is not begun
    found = audit(open_robot("puma-560-arm"), Options(timeout=0.0))
    assert found.verdict is Verdict.NONCUSPIDAL


def _stopped(model: ExactModel) -> Case:
    error = TimeLimitError("sample_points", 0.0)
    return Case(model, so_far=stopped(model, error))
