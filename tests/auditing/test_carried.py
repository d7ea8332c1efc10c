from __future__ import annotations

from dataclasses import replace

import pytest
from short_tables import arm, degrees, shift

from cuspaudit.auditing.answer import Reason
from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.carried import is_carried
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.decide import answer, decide
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import X_AXIS, Chain, Joint, Rotation
from cuspaudit.robot.robot import Robot
from cuspaudit.runtime.clock import Clock


def scattered() -> Chain:
    """Axes 2 and 3 parallel by turns of 110, -55, -55 deg with moves between them."""
    steps = []
    for turn in (110, -55, -55):
        steps += [Rotation(X_AXIS, degrees(turn)), shift("1/5", 0, 0)]
    joints = (
        Joint("a", "revolute"),
        Joint("b", "revolute", (shift("1/20", 0, 0), Rotation(X_AXIS, degrees(-90)))),
        Joint("c", "revolute", (shift(1, 0, "3/10"), *steps)),
    )
    return Chain("scattered", joints, (shift("9/10", 0, 0),))


def test_a_lost_relation_is_no_verdict() -> None:
    """A model without a relation of its arm decides nothing, and this is named."""
    found = answer(exact_model(scattered()))
    assert found.verdict is Verdict.UNDECIDED
    assert found.undecided is not None
    assert found.undecided.reason is Reason.NO_MODEL
    assert "axes 2 and 3 are parallel" in found.undecided.why


def test_an_audit_writes_that_arm_by_its_invariants() -> None:
    """The same arm, audited, has the verdict of parallel axes, proved."""
    record = audit(Robot("scattered", "scattered.yaml", scattered())).record()
    assert record["verdict"] == "noncuspidal"
    assert record["aspects"] == {"count": 4, "proved": True}
    assert record["robot"]["exact"] is True


@pytest.mark.parametrize("alpha", [35, "99.98"])
def test_counts_of_a_model_beside_the_arm_are_not_proved(alpha: int | str) -> None:
    """35 degrees is no angle of the exact model: its counts are counts, not proofs."""
    found = answer(exact_model(arm((1, "1/5", 2), (0, 1, 0), (-90, alpha, 0), "RRR")))
    counts = (found.aspects, found.postures, found.cusps, found.nodes)
    assert not any(count.proved for count in counts if count is not None)
    if found.verdict is Verdict.NONCUSPIDAL:
        assert not is_carried(found)


def test_a_theorem_of_relations_holds_of_the_arm_itself() -> None:
    """Four joints, yaw and pitch, one of them turned by 35 degrees: still proved."""
    chain = arm((0, 1, 1, 1), (0, "1/5", 0, 0), (90, 0, 0, 0), "RRRR", (0, 35, 0, 0))
    chain = replace(chain, task="position-and-angle")
    found = answer(exact_model(chain))
    assert found.verdict is Verdict.NONCUSPIDAL
    assert is_carried(found)


def test_a_witness_is_of_the_numbers_of_the_chain() -> None:
    """With a twist of 61 degrees the path is proved for 61 degrees, not for a model."""
    chain = arm((1, 2, "3/2"), (0, 1, 0), (-90, 61, 0), "RRR")
    found = decide(Case(exact_model(chain)), Clock())
    assert found.verdict is Verdict.CUSPIDAL
    assert found.witness is not None and found.witness.chain == chain
    assert not found.model.is_exact and is_carried(found)
    assert found.aspects is not None and not found.aspects.proved
