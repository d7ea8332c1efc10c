from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from flint import arb, ctx
from numpy.typing import NDArray

from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.library import open_robot
from cuspaudit.toolpath.ball_arm import BITS
from cuspaudit.toolpath.following.expansion import expansion_at
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.strand import settled
from cuspaudit.toolpath.following.tube import Knot, knot_at, tube_round
from cuspaudit.toolpath.following.tube_axis import axis_at, beside
from cuspaudit.toolpath.joint_pose import pose_of_joints
from cuspaudit.toolpath.traced_arm import TracedArm, traced_arm
from tests.toolpath.traced_arms import crx, exact, mirror

Array = NDArray[np.float64]


def scara() -> TracedArm:
    """Four joints, one of which slides, with a position and an angle."""
    return traced_arm(open_robot("adept-cobra-600").chain)


ARMS = [mirror, scara, crx]
FIRST = [0.3, -0.7, 0.2, 1.1, -0.6, 0.4]
SECOND = [0.5, -0.4, 0.1, 1.3, -0.9, 0.7]


@pytest.fixture(autouse=True)
def precision() -> Iterator[None]:
    """Tubes are made at this working precision."""
    with ctx.workprec(BITS):
        yield


def leg(arm: TracedArm) -> tuple[LegSystem, Array]:
    """A leg between the poses of two joint vectors, and the first with s = 0."""
    n = arm.joints
    poses = [pose_of_joints(arm, [exact(x) for x in q[:n]]) for q in (FIRST, SECOND)]
    return arm.system(*poses), np.append(np.array(FIRST[:n]) / arm.scales, 0.0)


@pytest.mark.parametrize("make", ARMS)
def test_the_ball_arm_moves_as_the_chain_does(make: object) -> None:
    """Tip and det J agree with the other implementation of the kinematics."""
    assert callable(make)
    arm: TracedArm = make()
    chain, values = arm.chain, np.array(FIRST[: arm.joints])
    coordinates = [arb(x) for x in values / arm.scales]
    tip = arm.balls.placed(coordinates).tip
    there = frames(chain, values)[-1]
    assert max(abs(float(tip[i, 3]) - there[i, 3]) for i in range(3)) < 1e-12
    height = float(np.linalg.det(jacobian(chain, values))) * np.prod(arm.scales)
    assert float(arm.determinant(coordinates)) == pytest.approx(height, rel=1e-9)


@pytest.mark.parametrize("make", ARMS)
def test_the_expansion_has_the_derivatives_of_the_equations(make: object) -> None:
    """K, its first derivatives and the second one along a step, against differences."""
    assert callable(make)
    system, y = leg(make())
    here = expansion_at(system, y)
    step = np.linspace(0.4, -0.7, len(y))
    size = 1e-4

    def slope(at: Array) -> Array:
        return system.plain(at)[1]

    along = (slope(y + size * step) - slope(y - size * step)) / (2 * size)
    assert np.abs(here.bend @ step - along).max() < 1e-6
    twice = (slope(y + size * step) - 2 * slope(y) + slope(y - size * step)) / size**2
    assert np.abs(here.twice(step) - twice).max() < 1e-5
    assert np.abs(here.value).max() < 1e-12
    moved = system.plain(y + size * step)[0] - system.plain(y - size * step)[0]
    assert np.abs(here.slope @ step - moved / (2 * size)).max() < 1e-6


@pytest.mark.parametrize("make", ARMS)
def test_a_tube_holds_the_curve_and_its_bounds_are_kept(make: object) -> None:
    """Newton from anywhere in a tube comes to one point in it, as steep as is said."""
    assert callable(make)
    system, y = leg(make())
    rng = np.random.default_rng(1)
    start = axis_at(system, y, np.eye(len(y))[-1])
    assert start is not None
    middle = settled(system, start.point(0.05), start.along)
    end = settled(system, start.point(0.1), start.along)
    assert middle is not None and end is not None
    axis = axis_at(system, middle, start.along)
    assert axis is not None
    tube = tube_round(axis, (y, end))
    assert tube is not None and tube.trend(-1) == 1
    points = []
    for t in np.linspace(*tube.span, 15):
        center = axis.point(t)
        found = []
        for _ in range(4):
            side = tube.across @ (tube.widths * rng.uniform(-0.9, 0.9, len(y) - 1))
            found.append(settled(system, center + side, tube.along))
        assert all(point is not None for point in found)
        assert np.ptp(np.array(found), axis=0).max() < 1e-11
        side = tube.across.T @ (found[0] - center)
        assert (np.abs(side) < tube.widths).all()
        points.append(found[0])
    rows = np.array(points)
    assert (rows > tube.low).all() and (rows < tube.high).all()
    rise = np.diff(rows, axis=0) / np.diff(np.linspace(*tube.span, 15))[:, None]
    assert (rise > tube.rise_low).all() and (rise < tube.rise_high).all()


def test_no_tube_is_proved_that_is_too_long() -> None:
    """A chord over most of the leg of the CRX has no tube: the test fails by itself."""
    system, y = leg(crx())
    start = axis_at(system, y, np.eye(len(y))[-1])
    assert start is not None
    end = start.point(3.0)
    assert tube_round(start, (y - 3.0 * start.along, end)) is None


def test_a_knot_is_a_zero_and_a_tube_holds_those_on_it_only() -> None:
    """A point off the curve has no knot; a knot elsewhere is not in the tube."""
    system, y = leg(mirror())
    across = np.eye(4)[:, :3]
    assert knot_at(system, y, across) is not None
    assert knot_at(system, y + 1e-6, across) is None
    axis = axis_at(system, y, np.eye(4)[-1])
    assert axis is not None
    tube = tube_round(axis, (axis.point(-0.01), axis.point(0.01)))
    assert tube is not None
    assert tube.holds(Knot(y, np.full(4, 1e-12)))
    assert not tube.holds(Knot(y, np.full(4, 1.0)))
    assert not tube.holds(Knot(y + 0.1 * tube.across[:, 0], np.full(4, 1e-12)))
    assert not tube.holds(Knot(axis.point(0.02), np.full(4, 1e-12)))


def test_half_a_turn_off_is_no_posture() -> None:
    """Vee E = 0 where the hand is half a turn off: it is not taken for the pose."""
    system, y = leg(crx())
    assert system.is_genuine([arb(x) for x in y])
    turned = y.copy()
    turned[5] += np.pi
    assert not system.is_genuine([arb(x) for x in turned])


def test_directions_beside_a_vector_make_a_basis() -> None:
    """Orthonormal to rounding, with the vector."""
    direction = np.array([0.2, -0.5, 0.1, 0.9])
    square = np.column_stack([beside(direction), direction / np.linalg.norm(direction)])
    assert np.abs(square.T @ square - np.eye(4)).max() < 1e-14
