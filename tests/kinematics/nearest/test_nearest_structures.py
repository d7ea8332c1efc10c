from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from redrawn import moved, redrawn
from scipy.optimize import minimize
from short_tables import arm, shift, with_wrist

from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.nearest.concurrent import concurrent
from cuspaudit.kinematics.nearest.links import Link, links_of, reach_of
from cuspaudit.kinematics.nearest.meeting import (
    PREFERRED,
    meeting,
    square_and_meeting,
)
from cuspaudit.kinematics.nearest.nearest_structures import (
    NearStructure,
    nearest_structures,
)
from cuspaudit.kinematics.theorems.registry import reduction_of
from cuspaudit.robot.chain import Chain, reverse
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.library import open_robot

UR3 = """
name: a calibrated UR3
convention: standard
angle_unit: rad
units: m
joints:
  - {type: revolute, d: 0.151992253529, a: -0.000243788992, alpha: 1.571952484466}
  - {type: revolute, d: 12.062000375761, a: -0.239838345814, alpha: 0.00358518981}
  - {type: revolute, d: 17.671902564174, a: -0.178746921547, alpha: 0.003921323366,
     theta: 6.682833498198}
  - {type: revolute, d: -29.621646036954, a: 0.000107694613, alpha: 1.571202995888,
     theta: -0.57811698261}
  - {type: revolute, d: 0.085321835382, a: -0.000198736633, alpha: -1.57280803096}
  - {type: revolute, d: 0.082117420471, a: 0, alpha: 0}
"""
REGIONAL = ((1, 2, "3/2"), (0, 1, "1/3"), (-90, 90, 30))
LIBRARY = ("ur5", "puma-560", "fanuc-crx-10ia-l", "abb-gofa-5", "kinova-jaco-gen2")


def near(chain: Chain) -> dict[str, NearStructure]:
    """The structures near a chain, by name."""
    return {found.name: found for found in nearest_structures(exact_model(chain))}


def test_a_calibrated_arm_is_milliradians_from_its_pattern(tmp_path: Path) -> None:
    """D-H offsets of kilometres do not hide that three axes are parallel to 4 mrad."""
    file = tmp_path / "ur3.yaml"
    file.write_text(UR3)
    nearest, *_ = nearest_structures(exact_model(read_robot(file).chain))
    assert nearest.name == "UR pattern"
    assert not nearest.holds
    assert nearest.angle == pytest.approx(0.003921323, abs=1e-8)
    assert nearest.length == pytest.approx(0.000243789, abs=1e-8)


@pytest.mark.parametrize("gap", ["1/10000", "1/50", "1/3"])
def test_a_wrist_that_misses_by_a_gap_is_that_far(gap: str) -> None:
    """Axis 6 beside the point of axes 4 and 5 has to move by the gap, and not turn."""
    chain = with_wrist(arm(*REGIONAL))
    joints = list(chain.joints)
    joints[5] = replace(joints[5], before=(shift(gap, 0, 0), *joints[5].before))
    # x of joint 5 is across axes 5 and 6
    found = near(chain.with_joints(joints))["spherical wrist"]
    assert not found.holds
    assert found.length == pytest.approx(float(Fraction(gap)))
    assert found.angle < 1e-12


def test_offsets_along_the_middle_axis_are_shared() -> None:
    """Axes 4 and 6 that are 1 apart along axis 5 come half the way from both sides."""
    chain = with_wrist(arm(*REGIONAL))
    joints = list(chain.joints)
    joints[5] = replace(joints[5], before=(shift(0, 0, "1/10"), *joints[5].before))
    found = near(chain.with_joints(joints))["spherical wrist"]
    assert found.length == pytest.approx(0.05)


@pytest.mark.parametrize("name", LIBRARY)
def test_what_holds_is_at_distance_zero(name: str) -> None:
    """A structure holds exactly when the theorem's test of the arm says so."""
    model = exact_model(open_robot(name).chain)
    reduction = reduction_of(model)
    found = nearest_structures(model)
    assert [s.size for s in found] == sorted(s.size for s in found)
    held = {s.name for s in found if s.holds}
    assert (reduction.kind in held) if reduction else (not held)
    for structure in found:
        assert structure.holds == (structure.size == 0)


@pytest.mark.parametrize("name", LIBRARY)
def test_the_nearest_arm_has_the_structure_exactly(name: str) -> None:
    """The theorems reduce each nearest arm, and its axes lie within the distance."""
    chain = open_robot(name).chain
    own = links_of(chain)
    for found in nearest_structures(exact_model(chain)):
        assert reduction_of(found.model) is not None
        for link, other in zip(own, links_of(found.model.chain), strict=True):
            assert abs(_angle(link) - _angle(other)) <= found.angle + 1e-8
            lever = reach_of(own) * found.angle
            apart = abs(_distance(link) - _distance(other))
            if (
                min(np.linalg.norm(np.cross(x.axis, x.next)) for x in (link, other))
                > 0.1
            ):
                assert apart <= found.length + lever + 1e-8


def _angle(link: Link) -> float:
    return float(np.arccos(np.clip(link.axis @ link.next, -1, 1)))


def _distance(link: Link) -> float:
    """The distance of two axes; not a number where they are nearly parallel."""
    normal = np.cross(link.axis, link.next)
    sine = np.linalg.norm(normal)
    return float(abs(link.step @ normal) / sine) if sine > 0.1 else np.nan


@pytest.mark.parametrize("name", LIBRARY)
def test_distances_do_not_depend_on_frames(name: str) -> None:
    """Other link frames, base and zeros of joints leave every distance as it is."""
    chain = open_robot(name).chain
    other = near(redrawn(chain, 5))
    for kind, found in near(chain).items():
        assert other[kind].holds == found.holds
        assert other[kind].length == pytest.approx(found.length, abs=1e-6)
        assert other[kind].angle == pytest.approx(found.angle, abs=1e-6)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(
    ("name", "kind"), [("ur5", "UR pattern"), ("puma-560", "spherical wrist")]
)
def test_no_arm_is_farther_than_where_it_came_from(
    name: str, kind: str, seed: int
) -> None:
    """Move the axes of an arm by a hair, and its structure is at most a hair away."""
    chain = open_robot(name).chain
    hair = Fraction(1, 10000)
    length = hair * Fraction(reach_of(links_of(chain)))
    found = near(moved(chain, seed, length, hair))[kind]
    assert 0 < found.size <= float(hair) * PREFERRED * 1.01


@pytest.mark.parametrize("name", ["puma-560", "abb-irb-120", "kuka-kr-6-r900"])
@pytest.mark.parametrize("kind", ["spherical wrist", "spherical shoulder"])
def test_the_rest_of_the_arm_stays(name: str, kind: str) -> None:
    """Mend the wrist of a moved arm, and all its links are the old ones to a hair."""
    chain = open_robot(name).chain
    if kind == "spherical shoulder":
        chain = reverse(chain)
    hair = Fraction(1, 10000)
    found = near(moved(chain, 1, hair, hair))[kind]
    assert not found.holds
    mended = links_of(found.model.chain)
    for link, other in zip(links_of(chain), mended, strict=True):
        assert measures(link) == pytest.approx(measures(other), abs=5e-3)


def measures(link: Link) -> list[float]:
    """The angle of the axes and where the step stands to them."""
    u, v, w = link.axis, link.step, link.next
    return [float(x) for x in (u @ w, u @ v, w @ v, v @ v, np.cross(u, w) @ v)]


def test_parallel_axes_have_no_wrist_near_by() -> None:
    """Axes that are parallel meet in one point after no small move: nothing is said."""
    assert "spherical shoulder" not in near(open_robot("ur5").chain)


def test_an_arm_with_slides_is_compared_where_its_axes_turn() -> None:
    """The Stanford arm has its wrist, and no pattern of six axes that turn."""
    assert {
        name: s.holds for name, s in near(open_robot("stanford-arm").chain).items()
    } == {"spherical wrist": True}


def test_three_joints_have_the_relations_of_neighbouring_axes() -> None:
    """Distances of an orthogonal arm with links 1, 2: what each relation asks for."""
    found = near(open_robot("chablat-2022-3r").chain)
    assert set(found) == {
        f"axes {pair} {word}"
        for pair in ("1 and 2", "2 and 3")
        for word in ("parallel", "meeting")
    }
    for pair in ("1 and 2", "2 and 3"):
        assert found[f"axes {pair} parallel"].angle == pytest.approx(np.pi / 2)
    assert found["axes 1 and 2 meeting"].length <= 1
    assert found["axes 2 and 3 meeting"].length <= 2


def _tilted(axis: np.ndarray, b: np.ndarray) -> np.ndarray:
    across = np.linalg.svd(axis[None, :])[2][1:]
    turn = b @ across
    angle = np.linalg.norm(turn) + 1e-300
    return np.cos(angle) * axis + np.sin(angle) * turn / angle


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("square", [False, True])
def test_a_general_optimizer_finds_no_nearer_meeting(seed: int, square: bool) -> None:
    """Two axes far from their places: tilts help, and no mixture is much better."""
    rng = np.random.default_rng(seed)
    axis, following, step = (x / np.linalg.norm(x) for x in rng.normal(size=(3, 3)))
    link, reach = Link(axis, step, following), 1.5
    ours = (square_and_meeting if square else meeting)(link, reach)
    found = ours.link
    assert abs(np.cross(found.axis, found.next) @ found.step) < 1e-12
    assert np.linalg.norm(found.step - step) == pytest.approx(ours.length)
    assert found.next @ following == pytest.approx(np.cos(ours.angle))
    assert not square or abs(found.axis @ found.next) < 1e-12

    def meets(x: np.ndarray) -> np.ndarray:
        tilted = _tilted(following, x[4:6])
        out = np.cross(axis, tilted) @ (step + reach * x[1:4])
        return np.array([out, axis @ tilted] if square else [out])

    least = _least(6, meets, [slice(1, 4), slice(4, 6)], rng)
    assert least * 0.999 <= ours.size(reach) <= least * PREFERRED * 1.001


def _least(
    size: int,
    meets: Callable[[np.ndarray], np.ndarray],
    parts: list[slice],
    rng: np.random.Generator,
) -> float:
    """The least x[0] that bounds all parts of an x for which ``meets`` is 0."""

    def room(x: np.ndarray) -> np.ndarray:
        return np.array([x[0] ** 2 - x[part] @ x[part] for part in parts])

    results = (
        minimize(
            lambda x: x[0],
            np.r_[1.0, start[1:]],
            constraints=[
                {"type": "eq", "fun": meets},
                {"type": "ineq", "fun": room},
                {"type": "ineq", "fun": lambda x: x[0]},
            ],
            method="SLSQP",
            options={"maxiter": 300},
        )
        for start in rng.uniform(-0.3, 0.3, (4, size))
    )
    return min(float(found.fun) for found in results if found.success)


@pytest.mark.parametrize("seed", range(2))
def test_a_general_optimizer_finds_no_nearer_point(seed: int) -> None:
    """Sequential quadratic programs over all shifts and tilts come no nearer."""
    rng = np.random.default_rng(seed)
    a, d = rng.uniform(-1, 1, (2, 6))
    chain = arm(
        [Fraction(x).limit_denominator(100) for x in a],
        [Fraction(x).limit_denominator(100) for x in d],
        [int(x) for x in rng.integers(30, 150, 6)],
    )
    links = links_of(chain)
    reach, first, second = reach_of(links), links[3], links[4]
    ours = concurrent(first, second, reach)
    assert ours is not None

    def meets(x: np.ndarray) -> np.ndarray:
        between, last = _tilted(first.next, x[4:6]), _tilted(second.next, x[9:11])
        return np.r_[
            first.step + reach * x[1:4] + x[11] * between - x[12] * first.axis,
            second.step + reach * x[6:9] + x[13] * last - x[11] * second.axis,
        ]

    parts = [slice(1, 4), slice(4, 6), slice(6, 9), slice(9, 11)]
    least = _least(14, meets, parts, rng)
    assert least * 0.999 <= ours.size(reach) <= least * PREFERRED * 1.001


def test_absurd_lengths_give_no_list_and_no_warning() -> None:
    """Floating point cannot square a length of 1e300; one of 1e-300 is no zero."""
    long = arm((1, Fraction(10**300), 1), (0, 1, 0), (90, 60, 0))
    assert nearest_structures(exact_model(long)) == ()
    short = near(arm((1, Fraction(1, 10**300), 1), (0, 1, 0), (90, 60, 0)))
    assert not short["axes 2 and 3 meeting"].holds
    assert short["axes 2 and 3 meeting"].length == 0
