from __future__ import annotations

import json
from fractions import Fraction
from importlib import import_module
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from flint import fmpq

import cuspaudit
from cuspaudit.algebra.ring import rational
from cuspaudit.auditing.answer import Reason
from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.by_pigeonhole import (
    by_pigeonhole,
    crowded_aspects,
    crowded_pose,
    postures_by_aspect,
)
from cuspaudit.auditing.deciders.decide import answer, decide
from cuspaudit.auditing.deciders.registry import DECIDERS, EXACT, Decider
from cuspaudit.auditing.proofs.proof_record import proof_record
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.library import open_robot
from cuspaudit.runtime.clock import Clock

module = import_module("cuspaudit.auditing.audit")
SCHEMA = Path(cuspaudit.__file__).parent / "auditing" / "schema.json"


def model_of(name: str) -> ExactModel:
    """The exact model of a robot of the library."""
    return exact_model(open_robot(name).chain)


def poses(count: int, seed: int) -> list[tuple[fmpq, ...]]:
    """Rational postures, one a pose."""
    numbers = np.random.default_rng(seed).integers(-30, 31, (count, 6))
    return [tuple(fmpq(int(x), 13) for x in row) for row in numbers]


@pytest.mark.parametrize("name", ["fanuc-crx-10ia-l", "abb-gofa-5", "ufactory-xarm6"])
def test_cobots_crowd_an_aspect(name: str) -> None:
    """More than two postures of one pose in two aspects: cuspidal, without a path."""
    model = model_of(name)
    count = count_aspects(model)
    assert count is not None
    for tangents in poses(6, 1):
        found = postures_by_aspect(model, tangents)
        sizes = sorted(len(here) for here in found.values())
        # over a regular value as many postures have det J > 0 as < 0
        assert len(set(sizes)) == 1
        if sum(sizes) > count.count:
            assert crowded_aspects(found)
            return
    pytest.fail("no pose with more than two postures")


def test_the_published_pose_of_the_jaco() -> None:
    """Its 12 postures lie in two aspects, six in each [Salunkhe 2023].

    Twists within 1e-4 rad, the posture within 1e-3: the exact numbers are then short.
    """
    model = exact_model(open_robot("kinova-jaco-gen2").chain, Fraction(1, 10**4))
    zeros = model.zeros
    given = np.array([3.0675, 1.0545, 1.309, 2.4283, -1.2305, -2.3002]) + zeros
    tangents = [Fraction(x).limit_denominator(1000) for x in np.tan(given / 2)]
    found = postures_by_aspect(model, [rational(t) for t in tangents])
    assert [len(here) for here in found.values()] == [6, 6]


def test_no_aspect_of_a_ur5_holds_two_postures_of_a_pose() -> None:
    """The eight signs tell the postures apart: the theorem of the UR pattern."""
    model, most = model_of("ur5"), 0
    for tangents in poses(4, 2):
        found = postures_by_aspect(model, tangents)
        assert crowded_aspects(found) == {}
        most = max(most, len(found))
    assert most >= 4
    assert crowded_pose(model) is None


def test_unproved_aspects_are_no_ground() -> None:
    """Without a count of aspects nothing is said."""
    with pytest.raises(UnableError):
        postures_by_aspect(model_of("hyperplane-6r"), poses(1, 0)[0])


def test_a_crowded_aspect_decides_where_no_path_is_proved(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """CUSPIDAL, exact, with the pose and two postures named, and no certificate."""
    search = DECIDERS[-2:]
    assert [way.stage for way in search] == ["search", "pairs"]
    nothing = [way for way in DECIDERS if way not in search and way.stage != "cusp"]
    monkeypatch.setattr(
        module, "decide", lambda case, clock, ways=nothing: decide(case, clock, ways)
    )
    robot = open_robot("fanuc-crx-10ia-l")
    found = audit(robot)
    record = json.loads(json.dumps(found.record(), allow_nan=False))
    jsonschema.validate(record, json.loads(SCHEMA.read_text()))
    assert (record["verdict"], record["witness"]) == ("cuspidal", None)
    assert (record["proof"]["kind"], record["proof"]["engine"]) == (
        *("exact", "pigeon-hole"),
    )
    assert record["proof"]["rests_on"]
    assert record["models"] == {"literal": "cuspidal", "snapped": "cuspidal"}
    first, second = np.array(record["crowd"]["postures"])
    gap = frames(robot.chain, first)[-1] - frames(robot.chain, second)[-1]
    assert np.abs(gap).max() < 1e-9
    assert np.abs(np.remainder(first - second + 3, 2 * np.pi) - 3).max() > 0.1
    signs = [np.linalg.det(jacobian(robot.chain, q)) > 0 for q in (first, second)]
    assert signs[0] == signs[1]
    written = json.loads(proof_record(found.answer))["crowd"]["postures"]
    aspects = [posture["aspect"] for posture in written]
    most = max(aspects.count(a) for a in aspects)
    assert most == record["crowd"]["in_one_aspect"] > 1


def test_a_model_near_the_arm_is_no_ground() -> None:
    """The JACO's twists of 55 deg are rational points: its model is another arm."""
    ways = (*EXACT, Decider("search", by_pigeonhole))
    for name, verdict in (
        ("kinova-jaco-gen2", Verdict.UNDECIDED),
        ("fanuc-crx-10ia-l", Verdict.CUSPIDAL),
    ):
        model = model_of(name)
        found = decide(Case(model), Clock(), ways)
        assert found.verdict is verdict
        assert (found.crowd is None) == (verdict is Verdict.UNDECIDED)
        assert answer(model).is_open_for(Reason.NO_THEOREM)
