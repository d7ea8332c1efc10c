"""From pairs of postures to a certified witness, or to evidence."""

from __future__ import annotations

import json
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from short_tables import arm, ask, with_wrist

import cuspaudit
from cuspaudit.auditing.answer import Answer, Reason, undecided
from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.by_pairs import by_pair_maxima
from cuspaudit.auditing.deciders.decide import answer, decide
from cuspaudit.auditing.deciders.registry import DECIDERS
from cuspaudit.certificate import verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.snapping import snap
from cuspaudit.runtime.clock import Clock

FILE = Path(cuspaudit.__file__).parent / "auditing" / "schema.json"
SCHEMA = json.loads(FILE.read_text())


def chain_of(name: str) -> Chain:
    """The snapped chain of a robot of the library."""
    return snap(open_robot(name).chain)[0]


def case_of(chain: Chain, so_far: Answer | None = None) -> Case:
    """A case of which nothing is known, and pairs were asked for."""
    model = exact_model(chain)
    unknown = undecided(model, Reason.PAIRS_ASKED, "pairs", "test", (), "pairs")
    return Case(model, so_far=so_far or unknown)


@pytest.mark.parametrize(
    "name",
    ["chablat-2022-3r", pytest.param("ufactory-xarm6", marks=pytest.mark.slow)],
)
def test_a_maximum_within_an_aspect_leads_to_a_witness(name: str) -> None:
    """Both ends in one aspect: the widest way between them is certified."""
    chain = chain_of(name)
    found = by_pair_maxima(case_of(chain), Clock())
    assert found is not None
    witness = found.witness
    assert found.verdict is Verdict.CUSPIDAL
    assert found.engine == "pairs"
    assert found.undecided is None
    assert witness is not None
    assert verify(witness.certificate).accepted
    ends = frames(chain, witness.path[0])[-1], frames(chain, witness.path[-1])[-1]
    rows = slice(0, 4) if chain.task == "pose" else slice(3, 4)
    assert np.abs((ends[0] - ends[1])[:3, rows]).max() < 1e-8
    assert witness.clearance is not None
    assert 0 < witness.clearance < 1


@pytest.mark.parametrize("name", ["puma-560-arm", "baili-2004-wt1"])
def test_a_noncuspidal_arm_stays_undecided(name: str) -> None:
    """Evidence is no proof: the verdict is undecided, and says what was met."""
    chain = chain_of(name)
    assert ask(chain).verdict is Verdict.NONCUSPIDAL
    found = by_pair_maxima(case_of(chain), Clock())
    assert found is not None
    assert found.witness is None
    assert found.verdict is Verdict.UNDECIDED
    assert found.undecided is not None
    assert found.pairs is not None
    assert found.pairs.together == 0
    assert found.pairs.missed in (0.0, None)


def test_only_what_is_undecided_is_looked_at() -> None:
    """A decided arm, and one with a sliding joint, need no pairs."""
    chain = chain_of("chablat-2022-3r")
    assert by_pair_maxima(case_of(chain, ask(chain)), Clock()) is None
    sliding = arm((1, 2, 1), (0, 1, 0), (90, 60, 0), "RRP")
    assert by_pair_maxima(case_of(sliding), Clock()) is None


def test_an_arm_without_rank_is_refused() -> None:
    """A determinant that vanishes everywhere leaves no pair to look at."""
    flat = arm((1,) * 6, (0,) * 6, (0,) * 6)
    with pytest.raises(DegenerateMapError):
        answer(exact_model(flat), engine="pairs")


def test_a_late_search_says_nothing() -> None:
    """A time that is up before the first round leaves what was known."""

    def late(step: str) -> None:
        raise UnableError(step, "the time limit has passed")

    chain = chain_of("puma-560-arm")
    assert by_pair_maxima(case_of(chain), Clock(progress=late)) is None


@pytest.mark.slow
def test_an_undecided_audit_shows_its_pairs(monkeypatch: pytest.MonkeyPatch) -> None:
    """A stiff wrist, its cusps left out: no witness is met, the evidence is told."""
    monkeypatch.setattr(
        *(import_module("cuspaudit.auditing.audit"), "decide"),
        lambda case, clock, ways=DECIDERS: decide(
            case, clock, [way for way in ways if way.stage != "cusp"]
        ),
    )
    chain = with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)), (3, 4))
    record = audit(replace(open_robot("ur5"), chain=chain, urdf=None)).record()
    jsonschema.validate(json.loads(json.dumps(record)), SCHEMA)
    assert record["verdict"] == "undecided"
    pairs = record["undecided"]["pairs"]
    assert pairs["together"] == 0
    assert 0 < pairs["missed"] <= 1
    assert f"{len(pairs['maxima'])} maxima" in record["proof"]["why"]
