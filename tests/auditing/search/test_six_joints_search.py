"""The search for a witness of a six-joint arm, and its proof."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from short_tables import arm, ask, with_wrist

import cuspaudit
from cuspaudit.auditing.answer import Reason
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.by_search import by_search, search_witness
from cuspaudit.auditing.search.six_joints import PathSearch, search
from cuspaudit.certificate import verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.frames import frames
from cuspaudit.runtime.clock import Clock

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"
UR5 = arm(
    (0, "-0.425", "-0.39225", 0, 0, 0),
    ("0.089159", 0, 0, "0.10915", "0.09465", "0.0823"),
    (90, 0, 0, 90, -90, 0),
)
NONCUSPIDAL_3R = arm((1, ".7", ".3"), (0, ".2", 0), (-90, 90, 0))
CUSPIDAL_3R = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
CUSPIDAL = ("fanuc-crx-10ia-l", "raghavan-roth")


def chain_of(name: str) -> Chain:
    """The chain of a robot file."""
    return read_robot(ROBOTS / f"{name}.yaml").chain


@cache
def looked(name: str) -> PathSearch:
    """A search in the arm of a robot file."""
    return search(chain_of(name), seed=2, most=32)


@pytest.mark.parametrize("name", CUSPIDAL)
def test_the_search_proposes_paths_between_postures_of_one_pose(name: str) -> None:
    """The two ends of every proposal reach one pose and differ modulo 2 pi."""
    found = looked(name)
    assert found.proposals
    for proposal in found.proposals:
        first, last = (frames(chain_of(name), q)[-1] for q in proposal.path[[0, -1]])
        assert np.abs(first - last).max() < 1e-6 * (1 + np.abs(first).max())
        apart = np.remainder(proposal.path[-1] - proposal.path[0] + np.pi, 2 * np.pi)
        assert np.abs(apart - np.pi).max() > 1e-3


@pytest.mark.parametrize("name", CUSPIDAL)
def test_proposals_come_widest_first(name: str) -> None:
    """Before they were made shorter; none is lower than nine tenths of that."""
    found = looked(name)
    assert found.proposals[0].clearance >= 0.9 * found.record.clearance
    assert found.record.clearance <= 1


@pytest.mark.slow
def test_a_search_is_repeated_by_its_seed() -> None:
    """The same seed gives the same paths, another one others."""
    chain = chain_of("raghavan-roth")
    first, again = (search(chain, 7, most=32) for _ in range(2))
    assert first.record == again.record
    assert all(
        np.array_equal(a.path, b.path)
        for a, b in zip(first.proposals, again.proposals, strict=True)
    )
    assert search(chain, 8, most=32).record != first.record


@pytest.mark.slow
def test_a_searched_arm_is_cuspidal_with_its_certificate() -> None:
    """The JACO Gen2: UNDECIDED by the theorems, CUSPIDAL by a witness that verifies."""
    chain = chain_of("kinova-jaco-gen2")
    before = ask(chain)
    assert before.is_open_for(Reason.NO_THEOREM)
    after = by_search(Case(exact_model(chain), so_far=before), Clock())
    assert after is not None
    witness = after.witness
    assert after.verdict is Verdict.CUSPIDAL
    assert after.engine == "search"
    assert after.undecided is None
    assert witness is not None
    assert verify(witness.certificate).accepted
    assert witness.clearance is not None
    assert 0.001 < witness.clearance < 1


@pytest.mark.parametrize(
    "chain",
    [UR5, with_wrist(NONCUSPIDAL_3R), with_wrist(NONCUSPIDAL_3R, (-60, 90))],
    ids=["UR5", "wrist", "skew wrist"],
)
def test_a_noncuspidal_arm_has_no_witness(chain: Chain) -> None:
    """UR5, and wrists on a noncuspidal 3R arm: whatever is proposed is refused."""
    result = search_witness(chain, most=32)
    assert result.witness is None
    assert result.record.poses == 32
    assert result.record.pairs > 0


@pytest.mark.slow
def test_a_skew_wrist_on_a_cuspidal_arm_has_a_witness() -> None:
    """No theorem speaks of it; the certificate does."""
    result = search_witness(with_wrist(CUSPIDAL_3R, (-60, 90)), most=32)
    assert result.witness is not None
    assert result.witness.verification.accepted


def test_a_search_ends_when_time_is_up() -> None:
    """An UnableError of the progress is kept in the record, not raised."""

    def late(step: str) -> None:
        raise UnableError(step, "the time limit has passed")

    record = search(UR5, progress=late).record
    assert record.poses == 0
    assert record.stopped is not None
    assert "time limit" in record.stopped


def test_decided_arms_are_not_searched() -> None:
    """A theorem is enough, and three joints have Algorithm 1."""
    for chain in (UR5, CUSPIDAL_3R):
        found = ask(chain)
        assert not found.is_open_for(Reason.NO_THEOREM)
        case = Case(exact_model(chain), so_far=found)
        assert by_search(case, Clock()) is None
