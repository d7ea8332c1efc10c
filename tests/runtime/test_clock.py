from __future__ import annotations

import itertools
from contextlib import AbstractContextManager
from types import SimpleNamespace

import pytest

from cuspaudit.auditing.audit import audit
from cuspaudit.errors import UnableError
from cuspaudit.robot.library import open_robot
from cuspaudit.runtime import clock as module
from cuspaudit.runtime.clock import Clock


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
