"""`--engine routing` confirms a verdict by a second route; `--engine pairs` decides."""

from __future__ import annotations

import dataclasses
import json
from importlib import import_module
from pathlib import Path

import jsonschema
import pytest
from short_tables import arm, ask, with_wrist

import cuspaudit
from cuspaudit.auditing.audit import Options, audit
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import CrossCheckError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.library import open_robot

FILE = Path(cuspaudit.__file__).parent / "auditing" / "schema.json"
SCHEMA = json.loads(FILE.read_text())
ROUTING = Options(engine="routing")
module = import_module("cuspaudit.cuspidality.decision")


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
    [("chablat-2022-3r", "cuspidal"), ("baili-2004-wt8", "noncuspidal")],
)
def test_pairs_decide_three_joints(name: str, verdict: str) -> None:
    """With --engine pairs the verdict is proved, and Algorithm 1 was not run."""
    found = audit(open_robot(name), Options(engine="pairs"))
    record = found.record()
    jsonschema.validate(json.loads(json.dumps(record)), SCHEMA)
    assert record["verdict"] == record["models"]["literal"] == verdict
    assert record["proof"]["engine"] == "pairs"
    assert record["proof"]["kind"] == {"cuspidal": "witness"}.get(verdict, "exact")
    assert record["aspects"] == audit(open_robot(name)).record()["aspects"]
    assert found.answer.decision is None
    if verdict == "cuspidal":
        assert record["witness"]["clearance"] > 0.1


def test_pairs_decide_under_a_wrist() -> None:
    """PUMA 560 by the pairs of its first three joints."""
    record = audit(open_robot("puma-560"), Options(engine="pairs")).record()
    assert record["verdict"] == "noncuspidal"
    assert record["proof"]["engine"] == "pairs"
    assert record["proof"]["reduction"] == "spherical wrist"
    assert record["aspects"] == {"count": 8, "proved": True}


def test_pairs_need_a_second_joint_that_turns() -> None:
    """Where the second joint slides the pairs leave the arm undecided, and say why."""
    chain = arm((1, 2, 1), (0, 1, 0), (60, 45, 0), "RPR")
    found = answer(exact_model(chain), engine="pairs")
    assert found.verdict is Verdict.UNDECIDED
    assert found.undecided is not None
    assert found.undecided.step == "pairs"


def test_pairs_decide_where_sample_values_are_unable() -> None:
    """A spherical shoulder: no coordinate tells postures apart, axes 1 and 2 meet."""
    chain = arm((0, "7/2", "19/5"), (0, 0, "7/10"), (90, 90, 0))
    found = ask(chain)
    assert found.verdict is Verdict.NONCUSPIDAL
    assert found.decision is None
    assert found.by_pairs is not None
    wrist = ask(with_wrist(chain))
    assert wrist.verdict is Verdict.NONCUSPIDAL
    assert wrist.aspects is not None
    assert found.aspects is not None
    assert wrist.aspects.count == 2 * found.aspects.count
