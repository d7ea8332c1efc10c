"""Paths inside limits, proved: through the cells of three joints, and for a wrist."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from short_tables import arm, degrees, with_wrist

from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.auditing.limits.limits_witness import first_proved, paths_of_cells, slack
from cuspaudit.auditing.limits.three_in_box import decide_three
from cuspaudit.auditing.limits.within_limits import within_limits
from cuspaudit.auditing.search.lift_inside import centred, lift_wrist_inside
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain, reverse
from cuspaudit.runtime.clock import Clock

ISSAC = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
SIX = with_wrist(ISSAC)
BOX = ((-20, 20), (-170, -30), (-40, 170))
WRISTS = {
    "a quarter turn of joint 5": ((-180, 180), (0, 90), (-91, 91)),
    "the other": ((-180, 180), (-90, 0), (-91, 91)),
    "short ranges": ((-60, 60), (20, 60), (-30, 30)),
}


def limited(chain: Chain, limits: tuple[tuple[int, int] | None, ...]) -> Chain:
    """The chain with limits in degrees."""
    joints = [
        replace(j, limits=None if p is None else (degrees(p[0]), degrees(p[1])))
        for j, p in zip(chain.joints, limits, strict=True)
    ]
    return chain.with_joints(joints)


def check(chain: Chain) -> None:
    """A path of the three joints is followed by the wrist, proved within limits."""
    found = answer(exact_model(chain))
    assert found.reduction is not None
    assert found.reduction.regional is not None
    box = decide_three(found.reduction.regional, Clock())
    assert box.verdict is Verdict.CUSPIDAL
    witness = first_proved(paths_of_cells(found, box), (chain,))
    assert witness is not None
    assert witness.certificate.limits is not None
    assert slack(witness) > 0.01


@pytest.mark.parametrize(
    "name",
    [
        "short ranges",
        *(pytest.param(n, marks=pytest.mark.slow) for n in list(WRISTS)[:2]),
    ],
)
def test_a_wrist_follows_inside_its_own_limits(name: str) -> None:
    """T5, the other way: where the wrist has room it follows the three joints."""
    check(limited(SIX, (*BOX, *WRISTS[name])))


@pytest.mark.slow
def test_a_shoulder_is_a_wrist_seen_from_the_tip() -> None:
    """The same arm from tip to base, with its limits."""
    check(reverse(limited(SIX, (*BOX, *WRISTS["a quarter turn of joint 5"]))))


@pytest.mark.slow
def test_a_wrist_that_cannot_turn_follows_nothing() -> None:
    """Joint 5 within one degree: no wrist brings the hand back."""
    chain = limited(SIX, (*BOX, (-1, 1), (40, 41), (-1, 1)))
    found = answer(exact_model(chain))
    assert found.reduction is not None
    assert found.reduction.regional is not None
    box = decide_three(found.reduction.regional, Clock())
    assert list(paths_of_cells(found, box)) == []


def test_a_cusp_that_no_path_goes_round_leads_to_cells() -> None:
    """Joint 1 within one degree: the exact route gives the path that is shown."""
    chain = limited(ISSAC, ((-1, 1), None, None))
    found = within_limits(answer(exact_model(chain)), chain, 0, Clock())
    assert found is not None
    assert found.kind == "cusp"
    assert found.witness is not None
    assert found.witness.certificate.limits is not None
    assert max(abs(found.witness.path[:, 0])) < math.radians(1)


def test_a_path_of_another_chain_proves_nothing() -> None:
    """A path proved for the file's numbers alone is none of the model's."""
    chain = limited(ISSAC, ((-1, 1), None, None))
    found = within_limits(answer(exact_model(chain)), chain, 0, Clock())
    assert found is not None
    assert found.witness is not None
    path, small = found.witness.path, limited(ISSAC, ((-1, 1), (0, 1), (0, 1)))
    assert first_proved([path], (small, chain)) is not None
    shown = first_proved([path], (ISSAC, chain))
    assert shown is not None
    assert shown.chain == ISSAC
    assert first_proved([path], (chain, small)) is None


def test_an_end_joint_goes_from_one_side_of_its_middle_to_the_other() -> None:
    """Only the difference of its end values counts, so the room is shared."""
    path = np.array([[0.0, 1.0], [1.0, 2.0]])
    moved = centred(path, 0, [(2.0, 6.0), None])
    assert moved[:, 0].tolist() == [3.5, 4.5]
    assert centred(path, 0, [None, None]) is path


def test_where_no_wrist_is_met_the_search_says_so() -> None:
    """Without a path there is an error to catch, and no wrong path."""
    limits = [None, None, None, (-0.01, 0.01), (0.7, 0.71), (-0.01, 0.01)]
    regional = np.array([[0.0, -1.5, 0.5], [0.4, -1.0, 1.8]])
    with pytest.raises(RetryableError, match="no wrist"):
        lift_wrist_inside(SIX, regional, limits)


@pytest.mark.slow
def test_a_wrist_shows_a_path_of_its_three_joints() -> None:
    """Six joints, a cusp that no path goes round in a short range of joint 1."""
    chain = limited(SIX, ((-1, 1), None, None, None, None, None))
    found = within_limits(answer(exact_model(chain)), chain, 0, Clock())
    assert found is not None
    assert found.kind == "cusp"
    assert found.witness is not None
    assert max(abs(found.witness.path[:, 0])) < math.radians(1)
