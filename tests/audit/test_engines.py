"""`--engine routing`: the second route confirms the verdict, or there is none."""

from __future__ import annotations

import dataclasses
from importlib import import_module

import pytest

from cuspaudit.audit.library import open_robot
from cuspaudit.audit.report import Options, audit
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import CrossCheckError

ROUTING = Options(engine="routing")
module = import_module("cuspaudit.audit.answer")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["chablat-2022-3r", "baili-2004-wt9"])
def test_the_routing_confirms_the_roadmap(name: str) -> None:
    """Both routes give one verdict, and the audit says that the second was asked."""
    found = audit(open_robot(name), ROUTING).record()
    assert found["proof"]["engine"] == "routing"
    assert found["verdict"] == audit(open_robot(name)).record()["verdict"]


def test_a_disagreement_is_no_verdict(monkeypatch: pytest.MonkeyPatch) -> None:
    """When the routes disagree the audit stops and asks for a report."""

    def wrong(*args: object, **kwargs: object) -> object:
        run = module.Decision(*args[:2])
        return dataclasses.replace(run, verdict=Verdict.NONCUSPIDAL, components=2)

    monkeypatch.setattr(module, "decide", wrong)
    with pytest.raises(CrossCheckError, match="please report"):
        audit(open_robot("chablat-2022-3r"), ROUTING)


def test_what_the_routing_cannot_take_is_undecided() -> None:
    """Twists of 30 degrees leave Q: then there is no agreement, and no verdict."""
    found = audit(open_robot("salunkhe-2022-fig20a"), ROUTING)
    assert found.verdict is Verdict.UNDECIDED
    assert found.answer.undecided is not None
    assert found.answer.undecided.step == "atypical_values"


@pytest.mark.parametrize(
    ("name", "verdict"),
    [("chablat-2022-3r", "cuspidal"), ("puma-560-arm", "undecided")],
)
def test_pairs_prove_a_couple_or_give_evidence(name: str, verdict: str) -> None:
    """With --engine pairs a three-joint arm is cuspidal by pairs, or undecided."""
    record = audit(open_robot(name), Options(engine="pairs")).record()
    assert record["verdict"] == verdict
    if verdict == "cuspidal":
        assert record["proof"]["engine"] == "pairs"
        assert record["proof"]["rests_on"] == ["ball arithmetic"]
    else:
        assert record["undecided"]["pairs"]["together"] == 0
