"""All postures of a pose, exactly."""

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import fmpq, fmpq_poly
from short_tables import arm

import cuspaudit
from cuspaudit.algebra.msolve import (
    find_msolve,
    msolve_text,
    parse_real_solutions,
    run_msolve,
)
from cuspaudit.algebra.points.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
)
from cuspaudit.errors import PrecisionError, UnableError
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.polynomial_map import polynomial_map
from cuspaudit.kinematics.postures import chart as module
from cuspaudit.kinematics.postures.exact import (
    exact_postures,
    posture_sign,
    real_postures,
)
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.robot.formats.read_robot import read_robot

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"
TABLES = {
    "60 degrees": (
        (0, 2, 0, 0, 0, 0),
        (0, 0, 0, -1, "-1/2", 0),
        (90, 180, 90, 60, 60, 0),
    ),
    "no offsets": ((0, 3, 0, 0, 0, 0), (0, 0, 0, 3, 0, 0), (90, 0, 90, -90, 90, 0)),
}
ARMS = ("abb-gofa-5", "fanuc-crx-10ia-l", "ur5", "puma-560", *TABLES)
PUBLISHED = {
    ("kinova_jaco_gen2_salunkhe", 12): (
        "kinova-jaco-gen2.yaml",
        (
            (3.0675, 1.0545, 1.3090, 2.4283, -1.2305, -2.3002),
            (2.4335, 0.0930, 1.5741, 1.4318, 2.3453, 0.5381),
            (-0.8579, 3.0414, 1.5722, -1.5905, 2.1627, 0.5381),
            (2.9135, 0.2823, 1.9296, -2.1655, -2.9687, -2.7157),
            (-0.2813, 2.0345, 1.8632, -0.5833, -1.0916, -2.4131),
            (-0.2454, 2.8157, 1.3091, 0.4876, -2.8301, -2.2997),
            (-3.1201, 0.7084, 1.4902, 2.6200, -1.9633, -1.8820),
            (2.4724, 0.0937, 2.0282, -1.4913, -2.4233, 2.4349),
            (-0.1583, 2.7026, 1.4700, -0.0656, -2.5403, -1.9078),
            (-0.7502, 1.9398, 2.0269, -1.4265, 0.6208, 2.6295),
            (-0.8051, 3.0471, 1.1134, 1.5105, -2.2688, 2.4382),
            (2.5337, 1.2024, 1.1148, 1.5844, 0.6025, 2.6326),
        ),
    ),
    ("raghavan_roth", 6): (
        "raghavan-roth.yaml",
        (
            (0.8600, -1.4500, -2.8800, -3.0400, 1.9700, 2.5900),
            (0.1389, 0.4232, 2.1236, 2.9521, 2.0860, 2.8695),
            (0.5310, -1.9190, -2.0760, -2.5581, -0.3859, -1.6421),
            (0.7721, -1.1156, -2.7754, 2.9990, 2.1793, 2.2133),
            (0.1948, 0.3117, 2.3214, 2.8963, 2.1961, 2.6555),
            (0.6132, -1.2034, -1.6151, 2.9441, -2.3903, -0.3742),
        ),
    ),
    ("raghavan_roth", 4): (
        "raghavan-roth.yaml",
        (
            (2.2500, -2.9300, 1.4400, -2.0400, 2.2800, 0.2600),
            (0.7330, 1.4904, -2.4857, -0.7333, 2.6173, -0.1896),
            (2.8898, -3.0721, 1.2413, -2.2331, 1.0305, 1.4365),
            (2.0337, 1.8930, 2.9436, -1.2547, -0.9453, 2.8422),
        ),
    ),
}
TANGENTS = tuple(
    fmpq(a, b) for a, b in ((-1, 3), (4, 5), (2, 3), (5, 7), (-3, 2), (1, 4))
)


def model_of(name: str) -> ExactModel:
    """The exact model of a robot file or of a table above."""
    if name in TABLES:
        return exact_model(arm(*TABLES[name]))
    return exact_model(read_robot(ROBOTS / f"{name}.yaml").chain)


@cache
def solved(name: str) -> ZeroDimensionalParametrization:
    """All postures of one rational pose."""
    return exact_postures(model_of(name), TANGENTS)


def cos_sin(t: fmpq) -> tuple[fmpq, fmpq]:
    """Cosine and sine by the half-angle tangent."""
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


def values_of(model: ExactModel, point: RealPoint) -> np.ndarray:
    """The joint values of a posture, rad."""
    ball = {n: float(b.mid()) for n, b in point.ball(60).items()}
    turns = [np.arctan2(ball[f"s{k}"], ball[f"c{k}"]) for k in range(1, 7)]
    return np.array(turns) - model.zeros


def nearest(postures: Sequence[np.ndarray], posture: np.ndarray) -> float:
    """The distance to the nearest of ``postures``, rad."""
    apart = np.remainder(np.array(postures) - posture + np.pi, 2 * np.pi) - np.pi
    return float(np.abs(apart).max(axis=1).min())


GIVEN = [x for t in TANGENTS for x in cos_sin(t)]


@pytest.mark.parametrize("name", ARMS)
def test_the_given_posture_is_among_them(name: str) -> None:
    """Exactly one real point has the (c, s) of the posture the pose was made from."""
    names = [f"{x}{k}" for k in range(1, 7) for x in "cs"]
    hits = 0
    for point in real_postures(solved(name)):
        ball = point.ball(80)
        hits += all(
            (ball[n] - x).contains(0) for n, x in zip(names, GIVEN, strict=True)
        )
    assert hits == 1


@pytest.mark.parametrize("name", ARMS)
def test_as_many_are_positive_as_negative(name: str) -> None:
    """Det J has as many positive as negative signs over a regular pose [theorem]."""
    model = model_of(name)
    determinant = jacobian_determinant(model)
    found = real_postures(solved(name))
    signs = [posture_sign(p, model, determinant) for p in found]
    assert sum(signs) == 0
    assert 0 not in signs
    assert solved(name).degree <= 16 * (1 if model.ring.radicand is None else 2)


@pytest.mark.parametrize("name", ARMS)
def test_the_numeric_solver_finds_the_same(name: str) -> None:
    """Two routes: eigenvalues in doubles, and roots of the exact resultant."""
    model = model_of(name)
    solver = PostureSolver.of(model.chain)
    zeros = model.zeros
    given = np.array([2 * np.arctan(int(t.p) / int(t.q)) for t in TANGENTS]) - zeros
    numeric = solver.solve(solver.poses(given[None]))[0]
    exact = [values_of(model, point) for point in real_postures(solved(name))]
    assert len(numeric) == len(exact)
    assert max(nearest(numeric, posture) for posture in exact) < 1e-9


def test_every_chart_gives_the_same_postures() -> None:
    """Another seed turns joints 2, 3, 4 by other angles; c and s are the same."""
    model = model_of("ur5")
    first, second = (exact_postures(model, TANGENTS, seed) for seed in (1, 2))
    assert first.degree == second.degree == 8

    def points(found: ZeroDimensionalParametrization) -> set[tuple[int, ...]]:
        balls = [p.ball(60) for p in found.real_points()]
        return {
            tuple(round(float(b.mid()) * 2**30) for n, b in ball.items() if n != "t")
            for ball in balls
        }

    assert points(first) == points(second)


def test_all_points_satisfy_the_pose() -> None:
    """Every coordinate of the pose is constant on the whole set, complex points too."""
    model = model_of("ur5")
    found, kinematic = solved("ur5"), polynomial_map(model)
    at = dict(zip(model.ring.variables, GIVEN, strict=True))
    for entry in (*kinematic.position.components, *kinematic.rotation.components):
        value = model.ring.substitute(entry, at)
        assert found.vanishes(model.ring, entry - value)


def test_a_wrong_number_is_not_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is read off balls has to close the loop exactly, or nothing is answered."""
    right = module.proposed_numerators

    def wrong(*given: Any) -> list[fmpq_poly]:
        first, *others = right(*given)
        return [first + fmpq(1, 10**9), *others]

    monkeypatch.setattr(module, "proposed_numerators", wrong)
    with pytest.raises(PrecisionError):
        exact_postures(model_of("ur5"), TANGENTS)


def test_a_root_without_a_posture_is_left_out() -> None:
    """D of the PUMA 560 has roots with joint 5 straight: none is a posture."""
    found = solved("puma-560")
    assert found.degree == len(real_postures(found)) == 8


def test_where_every_joint_is_shared_the_equations_are_solved() -> None:
    """Without offsets each joint angle belongs to two postures: a Groebner basis."""
    assert solved("no offsets").grounds != solved("puma-560").grounds


def test_three_joints_are_refused() -> None:
    """It solves arms of six revolute joints."""
    with pytest.raises(UnableError, match="six revolute"):
        exact_postures(exact_model(arm((1, 2, 3), (0, 1, 0), (90, 90, 0))), TANGENTS)


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("kinova_jaco_gen2_salunkhe", 12),
        pytest.param("raghavan_roth", 6, marks=pytest.mark.slow),
        pytest.param("raghavan_roth", 4, marks=pytest.mark.slow),
    ],
)
def test_the_published_postures(name: str, count: int) -> None:
    """JACO Gen2: 12, 6 of each sign; Raghavan-Roth: 6 and 4 at two poses.

    Twists within 1e-4 and postures within 1e-3 rad of the published ones, which are
    given to three digits or more: the numbers of an exact model are then short.
    """
    file, published = PUBLISHED[name, count]
    model = exact_model(read_robot(ROBOTS / file).chain, Fraction(1, 10**4))
    zeros = model.zeros
    halves = np.tan((np.array(published[0]) + zeros) / 2)
    tangents = [Fraction(x).limit_denominator(1000) for x in halves]
    found = real_postures(
        exact_postures(model, [fmpq(t.numerator, t.denominator) for t in tangents])
    )
    determinant = jacobian_determinant(model)
    signs = [posture_sign(point, model, determinant) for point in found]
    assert (signs.count(1), signs.count(-1)) == (count // 2, count // 2)
    exact = [values_of(model, point) for point in found]
    assert max(nearest(exact, np.array(posture)) for posture in published) < 0.05


@pytest.mark.slow
def test_msolve_finds_as_many() -> None:
    """A third route: msolve on the pose equations of the CRX."""
    try:
        find_msolve()
    except UnableError:
        pytest.skip("msolve is not installed")
    model = model_of("fanuc-crx-10ia-l")
    kinematic = polynomial_map(model)
    at = dict(zip(model.ring.variables, GIVEN, strict=True))
    equations = [
        entry - model.ring.substitute(entry, at)
        for entry in (*kinematic.position.components, *kinematic.rotation.components)
    ]
    text = msolve_text(model.ring, [*kinematic.variety.equations, *equations])
    boxes = parse_real_solutions(run_msolve(text, timeout=120))
    assert len(boxes) == len(solved("fanuc-crx-10ia-l").real_points())
