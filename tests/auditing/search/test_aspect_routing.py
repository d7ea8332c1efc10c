from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from short_tables import arm

from cuspaudit.auditing.search.aspect_routing import route_aspects
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import jacobian
from cuspaudit.robot.library import open_robot

Array = NDArray[np.float64]

FIRST = np.array([0.3, -0.4, 0.8, 0.2, 0.9, 0.1])
SECOND = np.array([1.1, 2.0, -0.7, 2.9, -0.8, -2.0])


def determinants(chain: Chain, postures: Array) -> Array:
    """Det J in floating point, from the screws."""
    return np.array([np.linalg.det(jacobian(chain, q)) for q in postures])


def test_the_path_of_a_gofa_keeps_away_from_singularities() -> None:
    """Joint zeros are minded: det J by the screws has one sign along the path."""
    chain = open_robot("abb-gofa-5").chain
    routed = route_aspects(exact_model(chain))
    assert routed.joints == (1, 2, 3, 4)
    # half a turn of joint 2 turns the sign of det J
    half = np.pi * np.eye(6)[1]
    ends = [SECOND, SECOND + half]
    paths = [routed.widest_path(FIRST, end) for end in ends]
    same = [determinants(chain, [FIRST, end]).prod() > 0 for end in ends]
    assert sorted(same) == [False, True]
    assert [path is not None for path in paths] == same
    path, end = paths[same.index(True)], ends[same.index(True)]
    assert path is not None
    values = determinants(chain, path.points)
    assert (np.sign(values) == np.sign(values[0])).all()
    assert np.abs(values).min() == pytest.approx(path.level, rel=1e-9)
    assert 0 < routed.clearance(path.level) < 1
    turns = (path.points[-1] - end) / (2 * np.pi)
    assert np.allclose(path.points[0], FIRST)
    assert np.allclose(turns, np.round(turns), atol=1e-9)


def test_a_three_joint_arm_is_routed_on_two_circles() -> None:
    """The ISSAC arm: two aspects by the search, of joints 2 and 3."""
    routed = route_aspects(exact_model(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))))
    assert routed.joints == (1, 2)
    assert routed.routing.number_of_components == 2
    assert routed.aspects is None


def test_a_prismatic_joint_is_refused() -> None:
    """A slide is not on a torus."""
    chain = arm((1, 0, 0), (0, 0, 0), (-90, 0, 0), "RRP")
    with pytest.raises(UnableError, match="prismatic"):
        route_aspects(exact_model(chain))
