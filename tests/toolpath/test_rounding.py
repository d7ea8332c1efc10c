"""What doubles decide is held against the same numbers in 256 bits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from flint import arb, arb_mat, ctx
from numpy.typing import NDArray

from cuspaudit.robot.library import open_robot
from cuspaudit.toolpath.ball_arm import BITS
from cuspaudit.toolpath.following import tube_bounds
from cuspaudit.toolpath.following.births import complete_runs
from cuspaudit.toolpath.following.expansion import expansion_at
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.starts import solve_pose
from cuspaudit.toolpath.following.strand import settled
from cuspaudit.toolpath.following.strands import follow_path, known_postures
from cuspaudit.toolpath.following.tube import Tube, knot_at, tube_round
from cuspaudit.toolpath.following.tube_axis import TubeAxis, axis_at
from cuspaudit.toolpath.following.tube_bounds import TubeBounds
from cuspaudit.toolpath.joint_pose import pose_of_joints
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_arm import TracedArm, traced_arm
from cuspaudit.toolpath.traced_path import TracedPath
from cuspaudit.toolpath.waypoints import Pose, ToolPath
from tests.toolpath.traced_arms import (
    arm_of_axes,
    exact,
    fact,
    mirror,
    places,
    table_arm,
)

Array = NDArray[np.float64]

FINE = 256
FIRST = [0.3, -0.7, 0.2, 1.1, -0.6, 0.4]
SECOND = [0.5, -0.4, 0.1, 1.3, -0.9, 0.7]
SCALES = ["1e-6", "1", "1e6"]


@pytest.fixture(autouse=True)
def precision() -> Iterator[None]:
    """Tubes are made at this working precision."""
    with ctx.workprec(BITS):
        yield


def three(scale: str) -> TracedArm:
    """The orthogonal arm, all lengths times ``scale``."""
    size = Fraction(scale)
    lengths = [str(size), str(2 * size), str(Fraction(3, 2) * size)]
    return traced_arm(table_arm(lengths, ["0", str(size), "0"], ["-1/2", "1/2", "0"]))


def six(scale: str) -> TracedArm:
    """The CRX-10iA/L, likewise."""
    size = Fraction(scale)

    def at(*entries: str) -> list[str]:
        return [str(Fraction(x) * size) for x in entries]

    base, elbow, wrist = at("0", "0", "0"), at("0", "0", ".71"), at(".15", ".54", ".71")
    points = [base, base, elbow, elbow, wrist, wrist]
    return traced_arm(arm_of_axes("zxxyxy", points, wrist))


def slide(scale: str) -> TracedArm:
    """Four joints, one of which slides; of its own size."""
    return traced_arm(open_robot("adept-cobra-600").chain)


ARMS = [(make, scale) for make in (three, six) for scale in SCALES] + [(slide, "1")]


def leg(arm: TracedArm) -> tuple[LegSystem, Array]:
    """A leg between the poses of two joint vectors, and the first with s = 0."""
    n = arm.joints
    poses = [pose_of_joints(arm, [exact(x) for x in q[:n]]) for q in (FIRST, SECOND)]
    with ctx.workprec(FINE):
        system = arm.system(*poses)
    return system, np.append(np.array(FIRST[:n]) / arm.scales, 0.0)


def exact_slope(system: LegSystem, y: list[arb]) -> arb_mat:
    """F' at a point, as M K."""
    placed, s = system.arm.placed(y[:-1]), y[-1]
    rows = [[*row] for row in zip(*placed.speeds, strict=True)]
    for row, speed in zip(rows, system.goal.velocity, strict=True):
        row.append(-speed)
    if system.signs is not None:
        cosine = system._angle(y).cos()
        own = [*map(arb, system.signs), -system.goal.angle]
        rows.append([cosine * x for x in own])
    elif system.has_pose:
        back = system.goal.back(s)
        E = back * arb_mat([[placed.tip[i, j] for j in range(3)] for i in range(3)])
        M = (
            arb_mat([[E.trace() * (i == j) for j in range(3)] for i in range(3)]) - E
        ) / 2
        columns = [*placed.turns, [-x for x in system.goal.omega]]
        turned = M * back * arb_mat([list(row) for row in zip(*columns, strict=True)])
        rows += turned.tolist()
    return arb_mat(rows)


def balls(matrix: Array) -> arb_mat:
    """Its doubles, exactly."""
    return arb_mat([[arb(float(x)) for x in row] for row in np.atleast_2d(matrix)])


def worst(bounds: TubeBounds, places: list[float]) -> float:
    """The greatest excess of what is true on the axis over what is said of it."""
    axis = bounds._axis
    system, found = axis.here.system, []
    with ctx.workprec(FINE):
        Y, N = balls(axis.Y), balls(axis.across)
        for t in places:
            y = [
                arb(c) + arb(t) * a + arb(t) ** 2 * e
                for c, a, e in zip(
                    axis.here.at.tolist(), axis.along.tolist(), axis.bow.tolist(),
                    strict=True,
                )
            ]  # fmt: skip
            value = Y * system.value(y)
            left = Y * exact_slope(system, y) * N
            drift = (
                Y
                * exact_slope(system, y)
                * balls(axis.along + 2 * t * axis.bow).transpose()
            )
            own, still, moving = bounds.own, bounds._left(0 * bounds.own), bounds.moving
            if bounds.turn is not None:
                moving = moving + bounds.turn * bounds.turned * bounds.turning
            for i in range(system.size):
                found.append(float(abs(value[i, 0]) - own[i]))
                found.append(float(abs(drift[i, 0]) - moving[i]))
                found += [
                    float(abs(left[i, j] - int(i == j)) - still[i, j])
                    for j in range(system.size)
                ]
    return max(found)


def axis_of(system: LegSystem, y: Array) -> TubeAxis:
    """An axis a little further along the curve."""
    start = axis_at(system, y, np.eye(len(y))[-1])
    assert start is not None
    middle = settled(system, start.point(0.05), start.along)
    assert middle is not None
    axis = axis_at(system, middle, start.along)
    assert axis is not None
    return axis


@pytest.mark.parametrize(("make", "scale"), ARMS)
def test_the_bounds_of_a_tube_hold_in_exact_numbers(make: object, scale: str) -> None:
    """|Y F|, |Y F' y'| and |1 - Y F' N| on the axis are below what doubles say."""
    assert callable(make)
    axis = axis_of(*leg(make(scale)))
    for T in (1e-9, 1e-3, 0.1, 0.25):
        bounds = TubeBounds(axis, T)
        assert bounds.is_admissible
        assert worst(bounds, [-T, -T / 3, 0.0, T / 2, T]) <= 0


def test_without_the_slack_the_bounds_are_wrong(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The slack is needed: with none, exact numbers exceed what doubles say."""
    axes = [axis_of(*leg(make(scale))) for make, scale in ARMS]
    monkeypatch.setattr(tube_bounds, "NOISE", 0.0)
    assert sum(worst(TubeBounds(axis, 1e-9), [0.0]) > 0 for axis in axes) >= 4


def test_what_is_not_of_moderate_size_is_refused() -> None:
    """A long, bent or skew axis, and a hand far from its goal: no tube is tried."""
    axis = axis_of(*leg(six("1")))
    assert TubeBounds(axis, 0.1).is_admissible
    assert not TubeBounds(axis, 4.5).is_admissible
    bent = replace(axis, bow=axis.across @ np.full(6, 1e3))
    assert not TubeBounds(bent, 0.1).is_admissible
    skew = replace(axis, across=axis.across + 1e-13)
    assert not TubeBounds(skew, 0.1).is_admissible
    ends = axis.point(-0.05), axis.point(0.05)
    assert tube_round(axis, ends) is not None and tube_round(skew, ends) is None
    off = axis.here.value + np.array([0, 0, 0, 0.2, 0, 0])
    assert not TubeBounds(
        replace(axis, here=replace(axis.here, value=off)), 0.1
    ).is_admissible


def test_a_posture_half_a_turn_off_has_no_axis_and_no_knot() -> None:
    """Vee E = 0 there as well; M is not near the identity, and nothing is proved."""
    system, y = leg(six("1"))
    turned = y.copy()
    turned[5] += np.pi
    assert expansion_at(system, y).sound and not expansion_at(system, turned).sound
    assert axis_at(system, turned, np.eye(7)[-1]) is None
    assert knot_at(system, turned, np.eye(7)[:, :-1]) is None


@pytest.mark.parametrize(("make", "scale"), ARMS)
def test_the_zero_of_a_knot_is_in_its_box(make: object, scale: str) -> None:
    """Newton's method in 256 bits, across the last coordinate, ends inside the box."""
    assert callable(make)
    system, start = leg(make(scale))
    y = settled(system, start, np.eye(len(start))[-1])
    assert y is not None
    knot = knot_at(system, y, np.eye(len(y))[:, :-1])
    assert knot is not None
    inside = exact_zero(system, knot.at)
    assert all(ball.contains(x) for ball, x in zip(knot.balls(), inside, strict=True))


def exact_zero(system: LegSystem, at: Array) -> list[arb]:
    """The zero near a point with the same s, to 30 digits."""
    with ctx.workprec(FINE):
        y = [arb(float(x)) for x in at]
        for _ in range(6):
            square = arb_mat([row[:-1] for row in exact_slope(system, y).tolist()])
            step = square.solve(system.value(y)).mid()
            y = [*((x - step[i, 0]).mid() for i, x in enumerate(y[:-1])), y[-1]]
        size = arb(1e-30) * system.arm.reach
        assert all(abs(x) < size for x in system.value(y).entries())
        return y


def inside(system: LegSystem, one: Tube, at: Array) -> bool:
    """Whether the curve at the s of a point is in the tube, in exact numbers."""
    y = exact_zero(system, at)
    with ctx.workprec(FINE):
        offset = arb_mat([[x - float(c)] for x, c in zip(y, one.center, strict=True)])
        square = balls(np.column_stack([one.along, one.across]))
        t = square.solve(offset)[0, 0]
        for _ in range(60):
            moved = offset - balls(one.bow).transpose() * t * t
            z = square.solve(moved)
            t = z[0, 0].mid()
        sides = [abs(z[i + 1, 0]) < float(w) for i, w in enumerate(one.widths)]
        return bool(all(sides) and one.span[0] < t and t < one.span[1])


def kept(arm: TracedArm, path: ToolPath, trace: TracedPath) -> int:
    """How many points of proved runs were found in their tubes; all of them must be."""
    with ctx.workprec(FINE):
        legs, count = [arm.system(a, b) for a, b in pairwise(path.poses)], 0
    for run in trace.runs:
        links = [] if run.free is None else run.free.links
        for link in links[:: max(1, len(links) // 5)]:
            first, last = link.before.at, link.after.at
            for share in (0.0, 0.5, 1.0):
                row = np.eye(len(first))[-1]
                start = first + share * (last - first)
                guess = settled(legs[link.leg], start, row)
                if guess is None:
                    continue
                guess[-1] = start[-1]
                assert inside(legs[link.leg], link.tube, guess)
                count += 1
    return count


@pytest.mark.parametrize("scale", SCALES)
def test_runs_of_small_and_large_arms_are_those_of_the_arm(scale: str) -> None:
    """Lengths times 1e-6 or 1e6 change no end, and exact zeros lie in the tubes."""
    rows = [["2.5", "0.4", "0.5"], ["1.2", "1.1", "0.8"], ["-1", "1.5", "0.2"]]
    size = Fraction(scale)
    path = places(*[[str(Fraction(x) * size) for x in row] for row in rows])
    trace, arm = trace_path(three(scale), path), three(scale)
    plain = trace_path(mirror(), places(*rows))
    assert plain.births_complete and trace.births_complete
    assert [(r.end, r.proved) for r in trace.runs] == [
        (r.end, r.proved) for r in plain.runs
    ]
    assert (
        np.abs([a.at - b.at for a, b in zip(trace.runs, plain.runs, strict=True)]).max()
        < 1e-6
    )
    assert kept(arm, path, trace) >= 12


def test_many_waypoints_that_almost_coincide() -> None:
    """Legs of 1e-12: each run goes through all of them, in its tubes."""
    step = Fraction(1, 10**12)
    poses = [
        Pose((Fraction(5, 2) + k * step, Fraction(2, 5), Fraction(1, 2)))
        for k in range(60)
    ]
    path = ToolPath(tuple(poses))
    trace = trace_path(mirror(), path)
    assert trace.runs and all(r.end == "reached" and r.proved for r in trace.runs)
    assert kept(mirror(), path, trace) >= 12


def test_a_run_counted_twice_does_not_stand_for_a_missing_one() -> None:
    """Each posture between two events needs a run of its own to be called complete."""
    arm = mirror()
    path = places(*fact("changes posture")["path"])
    legs = [arm.system(a, b) for a, b in pairwise(path.poses)]
    first, last = (solve_pose(arm, path.poses[k]) for k in (0, -1))
    found = follow_path(
        arm,
        legs,
        known_postures(arm, legs[0], first, 0.0),
        known_postures(arm, legs[-1], last, 1.0),
    )
    assert complete_runs(arm, path, legs, first, last, found)[0]
    runs, refused = list(found.runs), 0
    for k in range(len(runs)):
        found.runs = [*runs[:k], runs[k - 1], *runs[k + 1 :]]
        complete, remarks = complete_runs(arm, path, legs, first, last, found)
        refused += not complete and "not every posture has a run" in remarks[-1]
    assert refused >= 2


def test_a_run_dies_of_a_singularity_on_a_short_leg_too() -> None:
    """Legs of 6e-4, of a circle of 10,000: two runs die, proved, none is undecided."""
    turns = 2 * np.pi * np.arange(1658, 1672) / 9999
    rows = np.column_stack(
        [1.5 + 0.9 * np.cos(turns), 0.7 * np.sin(turns), 0.5 + 0.3 * np.sin(2 * turns)]
    )
    path = places(*[[f"{x:.9f}" for x in row] for row in rows.tolist()])
    trace = trace_path(mirror(), path)
    ends = sorted((run.end, run.proved) for run in trace.runs)
    assert ends == [("reached", True)] * 2 + [("singular", True)] * 2
    assert kept(mirror(), path, trace) >= 12
