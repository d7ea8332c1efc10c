from __future__ import annotations

import itertools
import time
from contextlib import AbstractContextManager
from types import SimpleNamespace

import pytest

from cuspaudit.auditing.audit import audit
from cuspaudit.errors import TimeLimitError, UnableError
from cuspaudit.robot.library import open_robot
from cuspaudit.runtime import clock as module
from cuspaudit.runtime.clock import Clock, check_time, time_at_least, time_limit


@pytest.fixture
def ticking(monkeypatch: pytest.MonkeyPatch) -> None:
    """A second passes whenever the time is asked."""
    clock = SimpleNamespace(perf_counter=itertools.count().__next__)
    monkeypatch.setattr(module, "time", clock)


@pytest.mark.usefixtures("ticking")
def test_the_stages_add_up_to_the_total(monkeypatch: pytest.MonkeyPatch) -> None:
    """No part of an audit runs outside a stage; a tick passes between two."""
    entered: list[str] = []
    stage = Clock.stage

    def counted(clock: Clock, name: str) -> AbstractContextManager[None]:
        entered.append(name)
        return stage(clock, name)

    monkeypatch.setattr(Clock, "stage", counted)
    seconds = audit(open_robot("chablat-2022-3r")).seconds
    parts = {key: value for key, value in seconds.items() if key != "total"}
    assert set(parts) == set(entered)
    assert all(value >= entered.count(key) for key, value in parts.items())
    assert sum(parts.values()) + len(entered) == seconds["total"]


@pytest.mark.usefixtures("ticking")
def test_a_step_after_the_limit_is_not_begun() -> None:
    """With 3 s, a step at 1 s begins, one at 5 s does not, unless it is made always."""
    begun: list[str] = []
    clock = Clock(3, begun.append)
    clock.step("first")
    assert clock.left == 1
    assert clock.left == 0
    with pytest.raises(UnableError, match="limit of 3 s"):
        clock.step("second")
    clock.step("last", always=True)
    assert begun == ["first", "last"]


def test_a_limit_in_force_stops_what_asks() -> None:
    """``check_time`` raises in the block once the time is over, and never outside."""
    check_time("before")
    with time_limit(0.0), pytest.raises(TimeLimitError, match="here"):
        time.sleep(0.001)
        check_time("here")
    check_time("after")


def test_an_earlier_limit_stays() -> None:
    """A longer limit inside a shorter one, or none, gives no more time."""
    for inner in (10.0, None):
        with time_limit(0.0), time_limit(inner):
            time.sleep(0.001)
            with pytest.raises(TimeLimitError):
                check_time("here")
    with time_limit(10.0):
        with time_limit(0.0), pytest.raises(TimeLimitError):
            time.sleep(0.001)
            check_time("here")
        check_time("here")


def test_what_is_quick_may_put_off_a_limit() -> None:
    """Inside, time is left again; afterwards the limit that has passed is back."""
    with time_limit(0.0):
        with time_at_least(60.0):
            check_time("inside")
        with pytest.raises(TimeLimitError, match="after"):
            check_time("after")
    with time_limit(60.0), time_at_least(0.0):
        check_time("a longer limit stays")
