"""Paths of six joints searched inside limits."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import islice

import numpy as np
import pytest
from short_tables import arm, degrees

from cuspaudit.auditing.limits.joint_limits import interval_of
from cuspaudit.auditing.limits.limits_witness import first_proved, slack
from cuspaudit.auditing.search.around_cusp import is_inside
from cuspaudit.auditing.search.box_search import paths_inside
from cuspaudit.auditing.search.postures_inside import postures_inside
from cuspaudit.auditing.search.widest_ways import WidestWays
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot

CRX = open_robot("fanuc-crx-10ia-l").chain
SLIDES = arm((1, 2, 1, 1, 0, 1), (0, 1, 0, 2, 1, 0), (90, 60, 90, -90, 90, 0), "PRRRRR")
IN_MIDDLE = arm(
    (1, 2, 1, 1, 0, 1), (0, 1, 0, 2, 1, 0), (90, 60, 90, -90, 90, 0), "RRPRRR"
)


def limited(chain: Chain, reach: int, slide: int = 4) -> Chain:
    """The chain with every joint within +-reach degrees, slides within +-slide."""
    ends = {
        "revolute": (degrees(-reach), degrees(reach)),
        "prismatic": (Fraction(-slide), Fraction(slide)),
    }
    return chain.with_joints([replace(j, limits=ends[j.kind]) for j in chain.joints])


@pytest.mark.parametrize(
    "chain",
    [
        limited(CRX, 170),
        pytest.param(limited(SLIDES, 170), marks=pytest.mark.slow),
        pytest.param(limited(IN_MIDDLE, 170), marks=pytest.mark.slow),
    ],
    ids=["turns", "a slide first", "a slide between"],
)
def test_what_is_met_stays_inside_and_is_proved(chain: Chain) -> None:
    """Way points inside, and a certificate that says so."""
    limits = [interval_of(joint) for joint in chain.joints]
    paths = list(islice(paths_inside(chain, limits), 12))
    assert all(is_inside(path, limits) for path in paths)
    witness = first_proved(paths, (chain,))
    assert witness is not None
    assert witness.certificate.limits is not None
    assert slack(witness) > 0


def test_ends_have_one_pose() -> None:
    """Before anything is mended, to rounding."""
    chain = limited(CRX, 170)
    limits = [interval_of(joint) for joint in chain.joints]
    path = next(paths_inside(chain, limits))
    first, last = (frames(chain, q)[-1] for q in (path[0], path[-1]))
    assert np.abs(first - last).max() < 1e-6
    assert np.abs(path[0] - path[-1]).max() > 1e-3


def test_a_box_without_couples_proposes_nothing() -> None:
    """Within a tenth of a degree no pose is reached twice."""
    chain = CRX.with_joints(
        [replace(j, limits=(degrees("30"), degrees("30.1"))) for j in CRX.joints]
    )
    limits = [interval_of(joint) for joint in chain.joints]
    assert list(paths_inside(chain, limits)) == []


@pytest.mark.parametrize("chain", [CRX, SLIDES], ids=["turns", "slide"])
def test_postures_have_the_pose_of_the_given_one(chain: Chain) -> None:
    """All of them, the given one among them, and different from each other."""
    rng = np.random.default_rng(3)
    given = rng.uniform(-1, 1, (2, 6))
    for q, found in zip(
        given, postures_inside(chain, [None] * 6, given, rng), strict=True
    ):
        assert np.abs(np.exp(1j * (found - q)) - 1).max(1).min() < 1e-6
        target = frames(chain, q)[-1]
        for other in found:
            assert np.abs(frames(chain, other)[-1] - target).max() < 1e-6


def test_the_widest_way_goes_by_the_highest_edges() -> None:
    """Its lowest edge is the highest that any way has; no way is level 0."""
    ways = WidestWays(5)
    for edge in ((0, 1, 0.3), (1, 2, 0.9), (0, 2, 0.5), (2, 3, 0.1)):
        ways.join(*edge)
    assert ways.between(0, 1) == [0, 2, 1]
    assert ways.levels([(0, 1), (0, 3), (0, 4)]).tolist() == [0.5, 0.1, 0.0]
    assert ways.between(0, 4) == []
