from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from slides_table import arms

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.auditing.search.cusps import TaskMap
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.search.mixed_joints import search_mixed
from cuspaudit.auditing.witness import certified
from cuspaudit.errors import UnableError
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.robot import Robot

#: of `slides_table.arms(20, seed=0)`, cuspidal ones with one slide and with two
CUSPIDAL = {"RRRRPR": 3, "RPRRRR": 4, "RRRRPP": 6}


def drawn(kinds: str) -> Chain:
    """A random arm with these joints."""
    number = CUSPIDAL[kinds]
    found, _, chain = list(arms(number + 1, seed=0))[number]
    assert found == kinds
    return chain


@pytest.mark.parametrize("kinds", CUSPIDAL)
def test_a_path_of_an_arm_with_slides_is_met_and_proved(kinds: str) -> None:
    """The search proposes paths, of which the checker accepts one."""
    chain = drawn(kinds)
    found = search_mixed(chain, seed=0, most=32)
    assert found.record.joined == len(found.proposals) or found.record.joined > 4
    proved = [
        certified(chain, close(chain, p.path)).verification for p in found.proposals
    ]
    assert any(result.accepted for result in proved)
    for proposal in found.proposals:
        ends = [frames(chain, q)[-1] for q in proposal.path[[0, -1]]]
        assert np.abs(ends[0] - ends[1]).max() < 1e-8
        assert proposal.clearance == pytest.approx(proposal.height / found.largest)


def test_the_audit_shows_a_path_of_an_arm_with_slides() -> None:
    """The verdict by a cusp gets a path, without clearance: |det J| is unbounded."""
    answer = audit(Robot("arm", "arm", drawn("RRRRPP")), Options(timeout=20)).answer
    assert answer.verdict.value == "cuspidal"
    assert answer.witness is not None
    assert answer.witness.verification.accepted
    assert answer.witness.clearance is None


def test_heights_are_those_of_the_jacobian() -> None:
    """Det J in units of the arm's size, times that size, is that of the Jacobian."""
    chain = drawn("RRRRPP")
    found = search_mixed(chain, seed=1, most=8)
    path = found.proposals[0].path
    share = np.linspace(0, 1, 300)[:, None]
    points = np.vstack([a + share * (b - a) for a, b in pairwise(path)])
    heights = [abs(np.linalg.det(jacobian(chain, q))) for q in points]
    assert min(heights) == pytest.approx(found.proposals[0].height, rel=0.05)


@pytest.mark.slow
def test_an_arm_of_one_posture_a_sign_has_no_path() -> None:
    """The Stanford arm is noncuspidal: nothing that is met for it is proved."""
    chain = open_robot("stanford-arm").chain
    found = search_mixed(chain, seed=0, most=16)
    assert found.record.pairs > 0
    proved = [
        certified(chain, close(chain, p.path)).verification for p in found.proposals
    ]
    assert not any(result.accepted for result in proved)


def test_the_tip_of_a_map_is_that_of_the_chain() -> None:
    """Frames of many postures at once, slides in the chain's unit."""
    chain = drawn("RPRRRR")
    values = np.random.default_rng(0).uniform(-2, 2, (9, 6))
    placed = TaskMap(chain).placed(values)
    expected = [frames(chain, q)[-1] for q in values]
    assert np.abs(placed - expected).max() < 1e-12


def test_the_time_limit_ends_a_search() -> None:
    """What stopped it stands in the record."""

    def stop(step: str) -> None:
        raise UnableError("search", "the time is up")

    found = search_mixed(drawn("RRRRPR"), progress=stop)
    assert found.record.stopped is not None
    assert found.record.poses == 0
    assert found.record.joined == 0
