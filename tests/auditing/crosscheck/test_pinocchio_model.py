from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cuspaudit.auditing.crosscheck.pinocchio_model import (
    arm_from_chain,
    arm_from_urdf,
    reach_scale,
)
from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats.urdf.read import read_urdf
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.task import lock

CLOSE = 1e-13
ChainOf = Callable[[str], Chain]


def postures(count: int, joints: int) -> np.ndarray:
    """Seeded random joint values."""
    return np.random.default_rng(1).uniform(-3, 3, (count, joints))


@pytest.mark.parametrize("base", ["base", "l1", "stand"])
def test_chain_and_file_are_the_same_arm(seven: Path, base: str) -> None:
    """Every kind of joint, from any base link: Pinocchio's reader and ours agree."""
    chain = read_urdf(seven, base=base, tip="tip").chain
    ours, theirs = arm_from_chain(chain), arm_from_urdf(chain, seven)
    for q in postures(5, len(chain.joints)):
        one, two = ours.at(q), theirs.at(q)
        assert np.abs(one.pose - two.pose).max() < CLOSE * 10
        assert np.abs(one.jacobian - two.jacobian).max() < CLOSE * 10


def test_poses_and_jacobians_are_those_of_our_frames(seven: Path) -> None:
    """Pinocchio confirms the frames that searches and drawings use."""
    chain = read_urdf(seven, base="base", tip="tip").chain
    arm = arm_from_urdf(chain, seven)
    for q in postures(5, 7):
        placed = arm.at(q)
        assert np.abs(placed.pose - frames(chain, q)[-1]).max() < CLOSE
        assert np.abs(placed.jacobian - jacobian(chain, q)).max() < CLOSE


def test_locked_joints_stand_at_their_values(seven: Path) -> None:
    """A turned and a slid joint that are locked leave five joints of the same arm."""
    values = {"j1": "60 deg", "j3": "0.25", "pan": "1 rad"}
    whole = read_urdf(seven, base="base", tip="tip").chain
    chain = lock(whole, {name: values[name] for name in ("j1", "j3")})
    arm, all_joints = arm_from_urdf(chain, seven, values), arm_from_urdf(whole, seven)
    for q in postures(3, 5):
        full = [math.pi / 3, q[0], 0.25, *q[1:]]
        assert np.abs(arm.at(q).pose - all_joints.at(full).pose).max() < CLOSE
        assert np.abs(arm.at(q).pose - frames(chain, q)[-1]).max() < CLOSE
    elsewhere = arm_from_urdf(chain, seven, {**values, "j3": Fraction(1, 2)})
    assert np.abs(elsewhere.at(q).pose - arm.at(q).pose).max() > 0.1


def test_a_position_task_has_three_rows(chain_of: ChainOf) -> None:
    """The determinant of the ISSAC arm at a published posture has its known value."""
    arm = arm_from_chain(chain_of("chablat-2022-3r-mirror"))
    placed = arm.at([-2.8852048972, -2.9963502969, -0.2465089356])
    assert placed.pose[:3, 3] == pytest.approx([2.5, 0, 0.5], abs=1e-9)
    assert placed.jacobian.shape == (3, 3)
    assert abs(placed.determinant) == pytest.approx(6.210299, abs=1e-6)


def test_singular_values_do_not_depend_on_the_unit(chain_of: ChainOf) -> None:
    """Divided by the reach, an arm in mm is the arm in m."""
    chain = chain_of("kinova-jaco-gen2")
    assert chain.unit in ("m", "mm")
    scale = reach_scale(chain)
    values = arm_from_chain(chain).at([0.3] * 6).singular_values(scale)
    assert len(values) == 6
    assert 0 < values[-1] <= values[0] < 6


def test_another_file_is_refused(seven: Path, tmp_path: Path) -> None:
    """A link or joint that Pinocchio does not find, or no URDF, is bad input."""
    chain = read_urdf(seven, base="base", tip="tip").chain
    with pytest.raises(InvalidRobotError, match='no link "tool0"'):
        arm_from_urdf(replace(chain, tip="tool0"), seven)
    with pytest.raises(InvalidRobotError, match='no joint "j9"'):
        arm_from_urdf(chain, seven, {"j9": "0"})
    broken = tmp_path / "broken.urdf"
    broken.write_text("<robot")
    with pytest.raises(InvalidRobotError, match="Pinocchio cannot read it"):
        arm_from_urdf(chain, broken)


def test_a_file_that_pinocchio_refuses_is_checked_by_its_chain(tmp_path: Path) -> None:
    """An odd effort limit stops Pinocchio's reader, not the audit: the chain serves."""
    from cuspaudit.auditing.audit import audit
    from cuspaudit.robot.library import example_robot_data, open_robot

    share = example_robot_data()
    assert share is not None
    source = share / "example-robot-data/robots/ur_description/urdf/ur5_robot.urdf"
    if not source.exists():
        source = next(share.rglob("ur5_robot.urdf"))
    file = tmp_path / "ur5.urdf"
    file.write_text(source.read_text().replace('effort="150.0"', 'effort="-1"'))
    result = audit(open_robot(file))
    assert result.check.against == "chain"
    assert result.verdict.value == "noncuspidal"
