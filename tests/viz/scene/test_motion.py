from __future__ import annotations

import numpy as np
import pytest
from drawn_arms import CRX_COUPLE, crx_chain, issac_chain, issac_path, slider_chain

from cuspaudit.errors import InvalidInputError
from cuspaudit.viz import sample_path, sample_postures
from cuspaudit.viz.scene.motion import chain_length


def test_a_path_keeps_its_ends_and_its_steps_are_equal() -> None:
    """Resampling by arc length keeps both ends and makes all steps equally long."""
    shown = sample_path(issac_chain(), [[0, 0, 0], [1, 0, 0], [1, 0, 3]], count=41)
    steps = np.linalg.norm(np.diff(shown.postures, axis=0), axis=1)
    assert shown.postures[0].tolist() == [0, 0, 0]
    assert shown.postures[-1].tolist() == [1, 0, 3]
    assert np.allclose(steps, 0.1)


def test_the_tool_is_home_at_both_ends_and_away_between() -> None:
    """The published path of the ISSAC arm closes up, and det J keeps its sign."""
    chain = issac_chain()
    shown = sample_path(chain, issac_path(chain))
    assert shown.distances[-1] < 1e-9 < 1 < shown.distances.max()
    assert shown.determinants.min() > 1


def test_a_pose_is_compared_with_its_orientation() -> None:
    """Both postures of the CRX couple hold the tool in one place, turned alike."""
    shown = sample_path(crx_chain(), CRX_COUPLE)
    assert shown.distances[-1] < 1e-9
    assert shown.turns[-1] < 1e-6 < shown.turns.max()


def test_det_j_does_not_depend_on_the_unit_but_for_its_power() -> None:
    """In mm det J of a position task with three turning joints is 1000^3 larger."""
    posture = [[0.3, 0.4, 0.5]]
    metres = sample_postures(issac_chain(), posture).determinants[0]
    millimetres = sample_postures(issac_chain(unit="mm"), posture).determinants[0]
    assert millimetres == pytest.approx(1e9 * metres)
    assert chain_length(issac_chain(unit="mm")) == 1000 * chain_length(issac_chain())


def test_single_postures_are_grouped_by_the_sign_of_det_j() -> None:
    """Without aspects given, one colour stands for one sign of det J."""
    shown = sample_postures(slider_chain(), [[0, 0, 100], [1, 5, -400], [2, 0, 50]])
    assert shown.groups == ("det J > 0", "det J < 0", "det J > 0")
    assert not shown.is_path


@pytest.mark.parametrize(
    "path", [[], [[0, 0]], [[0, 0, 0]], [[0, 0, 0], [0, 1, "nan"]]]
)
def test_what_is_no_path_is_refused(path: list[list[float]]) -> None:
    """Too few postures, too few values, or no numbers: an error that says so."""
    with pytest.raises(InvalidInputError, match="Orthogonal 3R"):
        sample_path(issac_chain(), path)


def test_groups_are_one_a_posture() -> None:
    """Groups that do not fit the postures are refused."""
    with pytest.raises(InvalidInputError, match="2 groups for 1 postures"):
        sample_postures(issac_chain(), [[0, 0, 0]], ["1", "2"])
