"""Audits with a tolerance: proved boxes, their ends, and arms that are built."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import cuspaudit as cu
from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.auditing.proofs.certificates import certificate_of_audit
from cuspaudit.auditing.tolerance.box import ToleranceBox, over
from cuspaudit.auditing.tolerance.nearby_arms import built_arm, nearby_arms
from cuspaudit.certificate import verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Angle, Chain, Rotation
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.tolerance import AxisTolerance, tolerance_from_file
from cuspaudit.runtime.clock import Clock

SMALL = ToleranceBox(AxisTolerance(Fraction(1, 10_000), Fraction(1, 10_000)))
TABLE = """
name: arm
convention: standard
units: m
joints:
  - {type: revolute, a: 1, alpha: pi/2, d: 0}
  - {type: revolute, a: 2, alpha: -pi/2, d: 1}
  - {type: revolute, a: 3/2, alpha: 0, d: 0}
"""


@pytest.mark.slow
def test_the_box_of_a_cuspidal_arm_is_proved_and_bounded(tmp_path: Path) -> None:
    """The largest box holds the one asked for, ten times as much is refused."""
    file = tmp_path / "arm.yaml"
    file.write_text(TABLE + "tolerance: {lengths: 1e-4, angles: 1e-4}\n")
    found = cu.audit(cu.load(file))
    entry = found.to_dict()["tolerance"]
    assert entry["verdict"] == "cuspidal"
    assert entry["lengths"] == entry["angles"] == 1e-4
    assert 1e-3 < entry["largest"]["lengths"] < entry["fails"]["lengths"] < 0.02
    assert entry["sensitive"]["largest"] > entry["largest"]["lengths"]
    assert found.verdict == "cuspidal"
    path = tmp_path / "all.json"
    found.save_certificate(path)
    claim = json.loads(path.read_text())
    assert claim["tolerance"] == {"lengths": "0.0001", "angles": "0.0001"}
    assert "for every arm within 0.0001 m and 0.0001 rad" in cu.verify(path).why


@pytest.mark.slow
def test_single_numbers_may_be_loose(tmp_path: Path) -> None:
    """+- on a number means every value of it, and all of them are proved at once."""
    file = tmp_path / "arm.yaml"
    loose = TABLE.replace("a: 2,", "a: 2 +- 1e-3,")
    loose = loose.replace("alpha: pi/2, d: 0", "alpha: pi/2 +- 0.05 deg, d: 0 +/- 1e-3")
    file.write_text(loose)
    robot = cu.load(file)
    assert [number.where for number in robot.loose] == [
        "joint_1 d",
        "joint_1 alpha",
        "joint_2 a",
    ]
    entry = cu.audit(robot).to_dict()["tolerance"]
    assert entry["verdict"] == "cuspidal"
    assert (entry["lengths"], entry["angles"]) == (0, 0)
    assert [n["within"] for n in entry["numbers"]][::2] == [1e-3, 1e-3]
    assert entry["largest"]["factor"] > 2
    assert entry["sensitive"]["where"] in [n["where"] for n in entry["numbers"]]


@pytest.mark.parametrize(
    ("old", "new", "found"),
    [
        ("a: 2,", "a: 2 +- -1,", "+-"),
        ("a: 2,", "a: 2 +- ,", "no number"),
        ("a: 2,", "a: 2 +- 1 +- 1,", "not a number"),
        ("alpha: pi/2", "alpha: pi/2 +- 1e-4", "no unit"),
        ("a: 2,", "a: 2 +- exit(),", "not a number"),
    ],
)
def test_what_follows_plus_minus_is_a_number(
    tmp_path: Path, old: str, new: str, found: str
) -> None:
    """Negative, missing, twice or without a unit: one line that names the cell."""
    file = tmp_path / "arm.yaml"
    file.write_text(TABLE.replace(old, new, 1))
    with pytest.raises(InvalidRobotError) as error:
        cu.load(file)
    assert found in str(error.value)
    assert "row " in str(error.value)


def test_no_tolerance_no_question() -> None:
    """An audit that is not asked says nothing of it, and its certificate neither."""
    found = cu.audit(cu.load("chablat-2022-3r"))
    assert found.to_dict()["tolerance"] is None
    assert "tolerance" not in found.to_dict()["seconds"]


@pytest.mark.slow
def test_a_noncuspidal_arm_of_three_joints_is_proved_over_lengths() -> None:
    """All pairs in balls: a box of lengths, and what tilts would take."""
    robot = open_robot("baili-2004-wt1")
    box = AxisTolerance(Fraction(1, 10**6), Fraction(0))
    result = audit(robot, Options(tolerance=box))
    assert result.over is not None
    assert result.over.verdict is Verdict.NONCUSPIDAL
    assert result.over.proved is not None
    assert 1 <= result.over.proved.proved < result.over.proved.fails
    certificate = certificate_of_audit(result)
    assert certificate is not None
    assert certificate.tolerance is not None
    assert verify(certificate).accepted
    assert not verify(over(certificate, ToleranceBox(box).times(1e6))).accepted
    tilted = audit(robot, Options(tolerance=replace(box, angles=box.lengths)))
    assert tilted.over is not None
    assert tilted.over.verdict is Verdict.UNDECIDED
    assert "square" in tilted.over.why


def test_a_structure_is_sampled_and_called_a_sample() -> None:
    """Of a noncuspidal arm by parallel axes it is said what was seen, not proved."""
    found = cu.audit(
        cu.load("puma-560-arm"), tolerance={"lengths": "1e-4", "angles": "1e-4"}
    )
    entry = found.to_dict()["tolerance"]
    assert found.verdict == "noncuspidal"
    assert entry["verdict"] == "undecided"
    assert entry["largest"] is None
    assert entry["sampled"]["arms"] == 24
    assert "axes 2 and 3 are parallel exactly" in entry["why"]
    assert "arms at the edge of the box" in entry["why"]


@pytest.mark.slow
def test_arms_near_a_ur5_are_cuspidal_by_a_hair() -> None:
    """Its parallel axes off by 0.1 mrad: most arms have a path, none a wide one."""
    chain = open_robot("ur5").chain
    seen = nearby_arms(chain, SMALL, 0, Clock(), count=6)
    assert seen.arms == 6
    assert seen.cuspidal >= 3
    assert seen.clearance is not None
    assert 0 < seen.clearance < 1e-3


def test_built_arms_are_off_by_what_the_box_says() -> None:
    """Each axis, seen from the one before, moves by at most twice the box and tilts."""
    chain = open_robot("chablat-2022-3r").chain
    rng = np.random.default_rng(1)
    for _ in range(20):
        arm = built_arm(chain, SMALL, rng)
        assert arm != chain
        one, other = (frames(each, [0.0] * 3) for each in (chain, arm))
        moved = np.abs(one[1, :3, 3] - other[1, :3, 3]).max()
        assert 0 < moved < 4e-4 + 2e-4 * 5
        for joint in arm.joints:
            turns = [m for m in joint.before if isinstance(m, Rotation)]
            extra = [turns[0], turns[-1]]
            assert all(_size(turn.angle) < 1e-4 for turn in extra)
            assert all(_size(turn.angle) > 0.99e-4 for turn in extra)


def _size(angle: Angle) -> float:
    return abs(float(angle.radians))


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("lengths: 1e-4\n", "angles"),
        ("lengths: -1e-4\nangles: 0\n", "negative"),
        ("lengths: 0\nangles: 0\n", "both are 0"),
        ("lengths: nan\nangles: 0\n", "not finite"),
        ("lengths: 1e-4\nangles: 1e-4\nscale: 2\n", "unknown name"),
        ("tolerance: 1e-4\n", "not a mapping"),
        ("lengths: [1, 2]\nangles: 0\n", "no value"),
        ("lengths: exit()\nangles: 0\n", "not a number"),
    ],
)
def test_what_is_no_tolerance_is_one_line(
    tmp_path: Path, text: str, found: str
) -> None:
    """Missing, negative, empty, unknown: the message names the entry."""
    file = tmp_path / "tolerance.yaml"
    file.write_text(text)
    with pytest.raises(InvalidRobotError) as error:
        tolerance_from_file(str(file))
    assert found in str(error.value)
    assert "\n" not in str(error.value)


def test_a_tolerance_in_degrees_is_rounded_up(tmp_path: Path) -> None:
    """Half a degree is a little more in rad than pi / 360, and not less."""
    file = tmp_path / "tolerance.yaml"
    file.write_text("tolerance: {lengths: 1/10000, angles: 0.5 deg}\n")
    found = tolerance_from_file(str(file))
    assert found.lengths == Fraction(1, 10_000)
    assert 0 <= float(found.angles) - np.pi / 360 < 1e-8


def test_a_chain_stays_what_it_is() -> None:
    """Building an arm leaves the chain's names, kinds and task."""
    chain = open_robot("ur5").chain
    arm = built_arm(chain, SMALL, np.random.default_rng(0))
    assert isinstance(arm, Chain)
    assert (arm.task, arm.kinds) == (chain.task, chain.kinds)
    assert [j.name for j in arm.joints] == [j.name for j in chain.joints]
