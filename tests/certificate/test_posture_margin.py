from __future__ import annotations

import numpy as np
import pytest

from cuspaudit.auditing.witness import certificate_of
from cuspaudit.certificate.posture_margin import posture_margin
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import jacobian
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.virtual_joint import with_virtual_joint

_NAMES = ("ur5", "fanuc-crx-10ia-l", "chablat-2022-3r", "chablat-2022-5r")


def margin(chain: Chain, posture: np.ndarray) -> float | None:
    """The margin of a posture of a chain."""
    return posture_margin(certificate_of(chain, 1, np.array([posture, posture])))


def height(chain: Chain, posture: np.ndarray) -> float:
    """Det J of the task."""
    rows = 3 if chain.task == "position" else 6
    return float(np.linalg.det(jacobian(chain, posture)[:rows]))


@pytest.mark.parametrize("name", _NAMES)
def test_no_posture_within_the_margin_is_singular(name: str) -> None:
    """Det J keeps its sign at random postures within it, and may not much beyond."""
    chain = with_virtual_joint(open_robot(name).chain)
    n, rng, found = len(chain.joints), np.random.default_rng(0), 0
    for _ in range(12):
        posture = rng.uniform(-3, 3, n)
        radius = margin(chain, posture)
        if radius is None:
            continue
        found += 1
        sign = np.sign(height(chain, posture))
        for _ in range(60):
            way = rng.normal(size=n)
            there = posture + way / np.linalg.norm(way) * radius
            assert np.sign(height(chain, there)) == sign
    assert found >= 9


def test_the_margin_of_an_elbow_is_near_the_distance() -> None:
    """Joint 5 of a UR5 at 0.4 is 0.4 from singular: a quarter of it is proved."""
    chain = open_robot("ur5").chain
    found = margin(chain, np.array([0.1, -1, 1.2, 0.3, 0.4, 0]))
    assert found is not None and 0.1 < found <= 0.4


def test_a_singular_posture_has_no_margin() -> None:
    """Nothing is proved at det J = 0, nor for an arm that slides."""
    assert margin(open_robot("ur5").chain, np.zeros(6)) is None
    assert margin(open_robot("stanford-arm").chain, np.full(6, 0.5)) is None
