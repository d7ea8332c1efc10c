"""What is known when the time is up is kept, and the rest is undecided."""

from __future__ import annotations

import time

import pytest

from cuspaudit.runtime.clock import time_is_up, time_limit
from cuspaudit.toolpath.asked import joint_vector
from cuspaudit.toolpath.following.strand import followed
from cuspaudit.toolpath.postures import list_postures
from cuspaudit.toolpath.record import exit_code
from cuspaudit.toolpath.same_aspect import same_aspect
from cuspaudit.toolpath.trace import trace_path
from tests.toolpath.traced_arms import crx, mirror, places

PATH = places(["2.5", "0", "0.37"], ["1.2", "0", "0.37"], ["1.2", "0", "2.2"])


def test_a_trace_without_time_decides_nothing() -> None:
    """Every run is undecided, the exit code 3, and the remarks say why."""
    trace = trace_path(mirror(), PATH, timeout=0.0)
    assert [run for run in trace.runs if run.proved] == []
    assert not trace.births_complete and exit_code(trace) == 3
    assert any("time was up" in remark for remark in trace.remarks)


def test_time_that_is_up_on_the_way_keeps_what_came_before(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of two runs followed before, one dies and is proved; later ones are undecided."""
    whole = trace_path(mirror(), PATH)
    count = 0

    def counted(*args: object) -> object:
        nonlocal count
        count += 1
        if count == 3:
            time.sleep(1.0)
        return followed(*args)  # type: ignore[arg-type]

    monkeypatch.setattr("cuspaudit.toolpath.following.strands.followed", counted)
    trace = trace_path(mirror(), PATH, timeout=0.9)
    known = [run.proved for run in trace.runs]
    assert True in known and False in known
    for run, other in zip(trace.runs, whole.runs, strict=True):
        if run.proved:
            assert (run.end, run.at) == (other.end, other.at)


def test_postures_without_time_may_not_be_all() -> None:
    """The list is what floating point finds, not complete, and its aspects untold."""
    pose = PATH.poses[0]
    found = list_postures(mirror(), pose, timeout=0.0)
    assert not found.complete and "time limit" in found.why
    assert found.aspects is None


def test_same_without_time_is_open_unless_signs_tell() -> None:
    """Opposite signs cost nothing; the straight way is not tried any more."""
    arm = crx()
    chain = arm.robot_chain
    ends = [
        joint_vector(text, chain, "--from")
        for text in ("0.1,0.2,0.3,0.4,0.5,0.6", "0.2,0.2,0.3,0.4,0.5,0.6")
    ]
    assert same_aspect(arm, ends[0], ends[1]).answer == "same"
    found = same_aspect(arm, ends[0], ends[1], timeout=0.0)
    assert found.answer == "open" and "within 0 s" in found.why


def test_a_loop_asks_whether_the_time_is_up() -> None:
    """Only a limit in force can be up."""
    assert not time_is_up()
    with time_limit(0.0):
        assert time_is_up()
    with time_limit(60.0):
        assert not time_is_up()
