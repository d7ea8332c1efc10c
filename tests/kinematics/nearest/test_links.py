from __future__ import annotations

import numpy as np
import pytest
from redrawn import redrawn
from short_tables import arm

from cuspaudit.kinematics.nearest.exact_arm import exact_arm
from cuspaudit.kinematics.nearest.links import Link, links_of, reach_of
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.relations import relations

ARMS = ("ur5", "puma-560", "fanuc-crx-10ia-l", "stanford-arm", "chablat-2022-3r")


def assert_one_arm(links: tuple[Link, ...], others: tuple[Link, ...]) -> None:
    """The links hold the same lengths and angles, seen from any frame."""
    for link, other in zip(links, others, strict=True):
        pairs = [
            (a, b)
            for x, y in (("axis", "next"), ("axis", "step"), ("next", "step"))
            for a, b in [
                (
                    getattr(link, x) @ getattr(link, y),
                    getattr(other, x) @ getattr(other, y),
                )
            ]
        ]
        pairs.append((np.linalg.norm(link.step), np.linalg.norm(other.step)))
        for a, b in pairs:
            assert a == pytest.approx(b, abs=1e-8)


@pytest.mark.parametrize("name", ARMS)
def test_links_do_not_depend_on_frames(name: str) -> None:
    """Other frames and zeros of the joints leave the lengths and angles of links."""
    chain = open_robot(name).chain
    assert_one_arm(links_of(chain), links_of(redrawn(chain, 3)))


def test_the_reach_is_the_length_of_the_rope() -> None:
    """A planar arm reaches as far as its stretched links, whatever their offsets."""
    chain = arm((1, 2, "1/2"), (3, -1, 4), (0, 0, 0))
    assert reach_of(links_of(chain)) == pytest.approx(3.5)


@pytest.mark.parametrize("name", ARMS)
def test_the_arm_of_the_links_is_the_arm(name: str) -> None:
    """Written in exact numbers, the links are those read, and relations are kept."""
    chain = open_robot(name).chain
    again = exact_arm(chain, links_of(chain))
    assert_one_arm(links_of(chain), links_of(again))
    kept = {words for words in relations(chain) if "base" not in words}
    assert kept == {words for words in relations(again) if "base" not in words}
