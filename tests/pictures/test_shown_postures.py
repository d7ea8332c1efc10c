from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.pictures.postures import shown_postures
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.snapping import snap
from cuspaudit.viz import sample_postures

APART = (
    *("ur5", "puma-560", "kuka-kr-6-r900", "abb-irb-120", "anthropomorphic-offset"),
    *("adept-cobra-600", "rawr-orion-5"),
)


@cache
def answered(name: str) -> Answer:
    """The exact answer for a robot of the library."""
    return answer(exact_model(snap(open_robot(name).chain)[0]))


@pytest.mark.parametrize("name", APART)
def test_the_postures_hold_the_tool_in_one_place(name: str) -> None:
    """All postures reach one pose (one position for few joints), none is singular."""
    result = answered(name)
    shown = shown_postures(result)
    tips = np.array([frames(result.model.chain, list(q))[-1] for q in shown.postures])
    held = tips if result.model.chain.task == "pose" else tips[:, :3, 3]
    assert np.abs(held - held[0]).max() < 1e-9
    drawn = sample_postures(result.model.chain, shown.postures)
    assert np.abs(drawn.determinants).min() > 1e-3 * np.abs(drawn.determinants).max()


@pytest.mark.parametrize("name", APART)
def test_a_noncuspidal_arm_has_no_two_postures_in_an_aspect(name: str) -> None:
    """As many colours as postures, as many postures as are proved to be possible."""
    result = answered(name)
    shown = shown_postures(result)
    assert shown.aspects is not None
    assert len(set(shown.aspects)) == len(shown.postures)
    assert result.verdict.value == "noncuspidal"
    most = result.postures or result.aspects
    assert most is not None
    assert len(shown.postures) == most.count


@pytest.mark.parametrize("name", APART)
def test_an_aspect_has_one_sign_of_det_j(name: str) -> None:
    """Half of the postures are on either side: the map has degree 0."""
    result = answered(name)
    drawn = sample_postures(result.model.chain, shown_postures(result).postures)
    assert np.sign(drawn.determinants).sum() == 0


def test_postures_of_a_cuspidal_arm_share_aspects() -> None:
    """Of the twelve postures of a cobot's pose six lie in each of its two aspects."""
    shown = shown_postures(answered("fanuc-crx-10ia-l"))
    assert shown.aspects is not None
    assert list(shown.aspects) == ["aspect 1"] * 6 + ["aspect 2"] * 6


def test_where_aspects_are_not_known_none_is_named() -> None:
    """No structure tells the aspects of this arm: only the sign of det J is shown."""
    result = answered("raghavan-roth")
    shown = shown_postures(result)
    assert shown.aspects is None
    signs = np.sign(sample_postures(result.model.chain, shown.postures).determinants)
    assert signs.tolist() == sorted(signs.tolist(), reverse=True)
    assert len(signs) > 2
