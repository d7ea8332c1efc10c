"""Cusps met in floating point, and paths round them."""

from __future__ import annotations

import numpy as np
import pytest
from short_tables import arm

from cuspaudit.auditing.search.around_cusp import paths_around, slack_of
from cuspaudit.auditing.search.cusps import TaskMap, search_cusps
from cuspaudit.robot.frames import frames, jacobian

THREE = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
SLIDE = arm((1, 2, "3/2"), (0, 1, 0), (-60, 90, 0), "PRR")
SIX = arm(
    (0, "27/50", 0, 0, 0, 0),
    (0, 0, 0, "27/50", "3/20", "4/25"),
    (-90, 180, -90, 90, -90, 180),
)
ARMS = {"three": THREE, "slide": SLIDE, "six": SIX}


@pytest.mark.parametrize("name", ARMS)
def test_the_map_is_that_of_the_frames(name: str) -> None:
    """The signed least singular value has the sign of det J, and vanishes with it."""
    chain = ARMS[name]
    map_ = TaskMap(chain)
    for q in np.random.default_rng(3).uniform(-2, 2, (20, len(chain.joints))):
        value = map_.conditions(q[None])[0][0, 0]
        matrix = jacobian(chain, q)
        matrix[:3] *= np.where(map_.turns, 1 / map_.size, 1.0)
        assert abs(value) == pytest.approx(np.linalg.svd(matrix)[1][-1])
        assert np.sign(value) == np.sign(np.linalg.det(matrix))


@pytest.mark.parametrize("name", ARMS)
def test_the_second_condition_is_a_derivative(name: str) -> None:
    """G is the derivative of f along the kernel, up to the sign."""
    chain, step = ARMS[name], 1e-6
    map_ = TaskMap(chain)
    for q in np.random.default_rng(4).uniform(-2, 2, (10, len(chain.joints))):
        _, g, _, k, _ = map_.decomposed(q[None])
        ends = np.array([q - step * k[0], q + step * k[0]])
        low, high = map_.conditions(ends)[0][:, 0]
        assert abs(g[0]) == pytest.approx(abs(high - low) / (2 * step), abs=1e-7)


def test_all_four_cusps_of_the_issac_arm_are_met() -> None:
    """The paper's arm has four, and the search ends at these only."""
    found = search_cusps(THREE, [None] * 3)
    places = {tuple(np.round(np.exp(1j * np.array(c.posture[1:])), 6)) for c in found}
    assert len(places) == 4


def test_limits_are_kept() -> None:
    """No posture outside; a small box around none has none."""
    limits = [None, (1.0, 3.0), (0.0, 2.0)]
    found = search_cusps(THREE, limits)
    assert found
    assert all(cusp.slack > 0 for cusp in found)
    assert search_cusps(THREE, [None, (-0.3, 0.3), (-0.3, 0.3)]) == []


@pytest.mark.parametrize("name", ["three", "six"])
def test_a_path_round_a_cusp_joins_two_postures_of_one_pose(name: str) -> None:
    """Different ends, one pose, inside the limits, one sign of det J at way points."""
    chain = ARMS[name]
    limits = [(-3.1, 3.1)] * len(chain.joints)
    paths = (
        path
        for cusp in search_cusps(chain, limits)
        for path in paths_around(chain, cusp.posture, limits)
    )
    path = next(paths)
    first, last = (frames(chain, q)[-1] for q in (path[0], path[-1]))
    part = (first - last)[:3, 3:] if name == "three" else first - last
    assert np.abs(part).max() < 1e-9
    assert np.abs(path[0] - path[-1]).max() > 1e-3
    assert slack_of(path, limits) > 0
    signs = {np.sign(np.linalg.det(jacobian(chain, q))) for q in path}
    assert len(signs) == 1
