"""The ways to a verdict are one list, and each hears of those before it."""

from __future__ import annotations

from dataclasses import replace

import pytest
from short_tables import arm

from cuspaudit.auditing.answer import Answer, Reason, undecided
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.decide import decide
from cuspaudit.auditing.deciders.registry import DECIDERS, EXACT, HAIR, Decider
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.library import open_robot
from cuspaudit.runtime.clock import Clock


def test_a_pose_that_proves_an_arm_cuspidal_does_not_end_the_search() -> None:
    """The CRX: the pigeon-hole decides, and a path is still searched and proved."""
    chain = open_robot("fanuc-crx-10ia-l").chain
    found = decide(Case(exact_model(chain)), Clock())
    assert found.verdict is Verdict.CUSPIDAL
    assert found.crowd is not None
    assert found.engine == "search"
    assert found.witness is not None
    assert found.witness.verification.accepted


def test_each_way_hears_of_those_before_it() -> None:
    """A way gets the answer of the last that had one; None leaves it as it was."""
    model = exact_model(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)))
    first = undecided(model, Reason.NO_THEOREM, "a", "because", (), "more")
    heard: list[Answer | None] = []

    def opening(case: Case, clock: Clock) -> Answer | None:
        heard.append(case.so_far)
        return first

    def silent(case: Case, clock: Clock) -> Answer | None:
        heard.append(case.so_far)
        return None

    def last(case: Case, clock: Clock) -> Answer | None:
        heard.append(case.so_far)
        assert case.so_far is not None
        return case.so_far.still_open(", still")

    ways = [Decider("one", opening), Decider("two", silent), Decider("two", last)]
    clock = Clock()
    found = decide(Case(model), clock, ways)
    assert heard == [None, first, first]
    assert found.why == "because, still"
    assert found.undecided == replace(first.undecided, why="because, still")
    assert set(clock.seconds) == {"one", "two", "total"}


@pytest.mark.parametrize("ways", [DECIDERS, HAIR, EXACT])
def test_the_exact_ways_come_first(ways: tuple[Decider, ...]) -> None:
    """No list searches before the exact engines and theorems were asked."""
    assert ways[: len(EXACT)] == EXACT
