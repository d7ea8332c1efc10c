from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
from slides_table import arms

from cuspaudit.auditing.search.mixed_joints import search_mixed, way_over_net
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.frames import jacobian
from cuspaudit.toolpath.asked import joint_vector
from cuspaudit.toolpath.same_aspect import FoundConnection, same_aspect
from cuspaudit.toolpath.traced_arm import TracedArm, traced_arm
from tests.toolpath.traced_arms import crx, mirror

FIRST, SECOND = "-2.898307145,-3.034023772,-0.268389431", "-0.837159,-0.502084,2.533577"
OTHER = "0.167985446,-0.247417323,-1.90299532"


def ask(
    arm: TracedArm, first: str, second: str, within: bool = False
) -> FoundConnection:
    """The answer for two texts."""
    chain = arm.robot_chain
    ends = [joint_vector(text, chain, "--from") for text in (first, second)]
    return same_aspect(arm, ends[0], ends[1], within)


def test_two_postures_of_one_pose_in_one_aspect() -> None:
    """The pair of the paper is joined by a path on which det J keeps its sign."""
    found = ask(mirror(), FIRST, SECOND)
    assert found.answer == "same" and found.path is not None
    chain = mirror().robot_chain
    heights = [
        np.linalg.det(jacobian(chain, a + t * (b - a)))
        for a, b in zip(found.path, found.path[1:], strict=False)
        for t in np.linspace(0, 1, 20)
    ]
    assert min(heights) > 0 or max(heights) < 0


def test_opposite_signs_are_different_aspects() -> None:
    """No path keeps det J away from 0 between them."""
    found = ask(mirror(), FIRST, OTHER)
    assert found.answer == "different" and "opposite signs" in found.why


def test_a_singular_posture_leaves_it_open() -> None:
    """All joints of the CRX at 0 is singular: it lies in no aspect."""
    found = ask(crx(), "0,0,0,0,0,0", "0.1,0.2,0.3,0.4,0.5,0.6")
    assert found.answer == "open" and "singular" in found.why


def test_limits_bind_the_path_only_where_they_are_asked_for() -> None:
    """A vector outside the limits is joined to one inside without them only."""
    chain = mirror().robot_chain
    limits = Angle(radians=Fraction(-3)), Angle(radians=Fraction(3))
    arm = traced_arm(
        chain.with_joints([replace(j, limits=limits) for j in chain.joints])
    )
    assert ask(arm, FIRST, SECOND).answer == "same"
    found = ask(arm, FIRST, SECOND, within=True)
    assert found.answer == "different" and "j2 of the first" in found.why
    inside = "-2.9,-2.9,-0.27"
    found = ask(arm, inside, "-2.8,-2.7,-0.2", within=True)
    assert found.answer == "same" and found.path is not None
    assert np.abs(found.path).max() < 3


def test_an_arm_with_slides_is_joined_over_postures_far_from_singular() -> None:
    """Two postures of one pose that a search joined: a proved path, as det J shows."""
    number = 6
    chain = list(arms(number + 1, seed=0))[number][2]
    found = search_mixed(chain, seed=0, most=32)
    arm = traced_arm(chain)
    ends = [
        tuple(
            Fraction(repr(float(x)))
            if kind == "prismatic"
            else Angle(radians=Fraction(repr(float(x))))
            for x, kind in zip(found.proposals[0].path[k], chain.kinds, strict=True)
        )
        for k in (0, -1)
    ]
    joined = same_aspect(arm, ends[0], ends[1])
    assert joined.answer == "same" and joined.path is not None
    heights = [
        np.linalg.det(jacobian(chain, a + t * (b - a)))
        for a, b in zip(joined.path, joined.path[1:], strict=False)
        for t in np.linspace(0, 1, 30)
    ]
    assert min(heights) > 0 or max(heights) < 0


def test_the_net_leads_where_the_straight_way_is_singular() -> None:
    """Of couples that no straight way joins some are joined over the net, sampled."""
    chain = next(c for kinds, _, c in arms(20, seed=0) if kinds == "RRRPRR")
    rng, met = np.random.default_rng(0), 0
    for _ in range(40):
        first, second = rng.uniform(-2, 2, (2, 6))
        signs = [np.sign(np.linalg.det(jacobian(chain, q))) for q in (first, second)]
        if signs[0] != signs[1]:
            continue
        way = way_over_net(chain, first, second, 0)
        if way is None:
            continue
        heights = [
            np.linalg.det(jacobian(chain, a + t * (b - a)))
            for a, b in pairwise(way)
            for t in np.linspace(0, 1, 25)
        ]
        assert min(heights) * max(heights) > 0
        met += len(way) > 2
        if met:
            break
    assert met
