"""All postures of a pose: numeric, by elimination and eigenvalues."""

import time
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from short_tables import arm, with_wrist

import cuspaudit
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.postures.numeric import PostureSolver, is_even
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.frames import frames, jacobian

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"
GENERAL = (
    "abb-gofa-5",
    "fanuc-crx-10ia-l",
    "hyperplane-6r",
    "kinova-jaco-gen2",
    "raghavan-roth",
    "ufactory-xarm6",
    "ur5",
)
JACO = (3.0675, 1.0545, 1.309, 2.4283, -1.2305, -2.3002)
RAGHAVAN_ROTH = (
    ((0.86, -1.45, -2.88, -3.04, 1.97, 2.59), 6),
    ((2.25, -2.93, 1.44, -2.04, 2.28, 0.26), 4),
)
HYPERPLANE = tuple(np.pi * x for x in (-1 / 6, 1 / 2, -1 / 3, 1 / 2, 1 / 6, -1 / 6))


@cache
def chain_of(name: str) -> Chain:
    """The chain of a robot file, its numbers as they stand."""
    return read_robot(ROBOTS / f"{name}.yaml").chain


def distance(postures: np.ndarray, posture: np.ndarray) -> float:
    """The distance from ``posture`` to the nearest of ``postures``, modulo 2 pi."""
    apart = np.remainder(postures - posture + np.pi, 2 * np.pi) - np.pi
    return float(np.abs(apart).max(axis=-1).min())


def solved(chain: Chain, posture: tuple[float, ...]) -> np.ndarray:
    """The postures found of the pose of ``posture``."""
    solver = PostureSolver.of(chain)
    return solver.solve(solver.poses(np.array([posture])))[0]


@pytest.mark.parametrize("name", GENERAL)
def test_the_given_posture_is_found_again(name: str) -> None:
    """Among the postures of a pose is the one it was made from, and signs are even."""
    solver = PostureSolver.of(chain_of(name))
    given = np.random.default_rng(5).uniform(-np.pi, np.pi, (20, 6))
    for posture, found in zip(given, solver.solve(solver.poses(given)), strict=True):
        assert distance(found, posture) < 1e-8
        assert is_even(solver.determinants(found))
        assert len(found) <= 16


def test_both_sides_of_a_wrist_are_found() -> None:
    """They share joint 2, a double root settled badly, and differ in joint 5."""
    solver = PostureSolver.of(chain_of("puma-560"))
    given = np.random.default_rng(1).uniform(-np.pi, np.pi, (60, 6))
    for posture, found in zip(given, solver.solve(solver.poses(given)), strict=True):
        assert len(found)
        assert distance(found, posture) < 1e-8
        assert is_even(solver.determinants(found))


@pytest.mark.parametrize("name", GENERAL)
def test_all_postures_have_one_pose(name: str) -> None:
    """The forward kinematics of the chain takes every posture to the given pose."""
    chain = chain_of(name)
    given = np.random.default_rng(6).uniform(-np.pi, np.pi, 6)
    target = frames(chain, given)[-1]
    reach = 1 + np.abs(target[:3, 3]).max()
    for posture in solved(chain, tuple(given)):
        assert np.abs(frames(chain, posture)[-1] - target).max() < 1e-9 * reach


def test_determinants_are_those_of_the_jacobian() -> None:
    """The solver's det J is that of `frames.jacobian` in the solver's unit."""
    chain = chain_of("kinova-jaco-gen2")
    solver = PostureSolver.of(chain)
    posture = np.array(JACO)
    expected = np.linalg.det(jacobian(chain, posture)) / solver.scale**3
    assert solver.determinants(posture) == pytest.approx(expected, rel=1e-9)


def test_the_published_pose_of_the_jaco_has_twelve_postures() -> None:
    """JACO Gen2 at a published pose [facts]: exactly 12 postures, 6 of each sign."""
    chain = chain_of("kinova-jaco-gen2")
    found = solved(chain, JACO)
    signs = np.sign(PostureSolver.of(chain).determinants(found))
    assert len(found) == 12
    assert (signs > 0).sum() == 6


@pytest.mark.parametrize(("posture", "count"), RAGHAVAN_ROTH)
def test_the_poses_of_raghavan_and_roth(posture: tuple[float, ...], count: int) -> None:
    """Two published joint vectors have 6 and 4 postures [facts]."""
    assert len(solved(chain_of("raghavan-roth"), posture)) == count


def test_the_hyperplane_pose_has_two_postures() -> None:
    """The exact pose of the robot "hyperplane" has exactly 2 postures [facts]."""
    assert len(solved(chain_of("hyperplane-6r"), HYPERPLANE)) == 2


def test_a_wrist_has_its_eight_postures() -> None:
    """Double roots, by which a spherical wrist hides its flip, are solved too."""
    solver = PostureSolver.of(chain_of("puma-560"))
    given = np.random.default_rng(1).uniform(-np.pi, np.pi, (10, 6))
    counts = [len(found) for found in solver.solve(solver.poses(given))]
    assert counts.count(8) >= 9


def test_only_six_revolute_joints_are_solved() -> None:
    """Another arm is refused by name of the step."""
    with pytest.raises(UnableError, match="six revolute joints"):
        PostureSolver.of(arm((1, 2, 3), (0, 1, 0), (90, 90, 0)))


def test_a_skew_wrist_is_solved() -> None:
    """A spherical wrist whose twists are no right angles: the posture is found."""
    chain = with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)), (-60, 70))
    given = (0.3, 1.1, -0.7, 0.9, 1.3, -0.2)
    assert distance(solved(chain, given), np.array(given)) < 1e-8


def test_an_arm_without_rank_is_refused_or_empty() -> None:
    """With axes 2 and 3 in one line no numpy error reaches the caller."""
    chain = arm(
        (0, 0, "-.4", 0, 0, 0), (0, 0, 0, ".1", ".1", 0), (90, 0, 0, 90, -90, 0)
    )
    try:
        found = solved(chain, (0.1, 0.2, 0.3, 0.4, 0.5, 0.6))
    except UnableError:
        return
    assert found.shape[1] == 6


def test_a_pose_takes_few_milliseconds() -> None:
    """A hundred poses of the CRX are solved at less than 5 ms a pose."""
    solver = PostureSolver.of(chain_of("fanuc-crx-10ia-l"))
    given = np.random.default_rng(0).uniform(-np.pi, np.pi, (100, 6))
    poses = solver.poses(given)
    begun = time.process_time()
    solver.solve(poses)
    assert time.process_time() - begun < 100 * 0.02


@pytest.mark.parametrize("name", ["chablat-2022-6r", "puma-560", "ur5"])
@pytest.mark.parametrize("height", [1.0, -1.0])
def test_a_tool_held_upright_is_solved(name: str, height: float) -> None:
    """With axis 6 along axis 1 as many postures are met as with the tool tilted."""
    solver = PostureSolver.of(chain_of(name))
    upright = solver.poses(np.random.default_rng(3).uniform(-2, 2, (24, 6)))
    upright[:, :3, :3] = np.diag([1.0, height, height])
    tilted = upright.copy()
    c, s = np.cos(0.02), np.sin(0.02)
    tilted[:, :3, :3] @= np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    counts = [[len(p) for p in solver.solve(poses)] for poses in (upright, tilted)]
    same = sum(a == b for a, b in zip(*counts, strict=True))
    assert same >= 22 and max(counts[0]) == max(counts[1]) > 2
