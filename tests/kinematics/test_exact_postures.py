"""All postures of a pose, exactly."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from flint import fmpq
from short_tables import arm, with_wrist

import cuspaudit
from cuspaudit.algebra.msolve import (
    find_msolve,
    msolve_text,
    parse_real_solutions,
    run_msolve,
)
from cuspaudit.algebra.parametrization import ZeroDimensionalParametrization
from cuspaudit.errors import UnableError
from cuspaudit.kinematics import exact_postures as module
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.exact_postures import exact_postures
from cuspaudit.kinematics.frames import angle_value
from cuspaudit.kinematics.polynomial_map import jacobian_determinant, polynomial_map
from cuspaudit.kinematics.postures import PostureSolver
from cuspaudit.kinematics.reading import read_robot

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"
ARMS = ("abb-gofa-5", "fanuc-crx-10ia-l", "ur5")
TANGENTS = tuple(
    fmpq(a, b) for a, b in ((-1, 3), (4, 5), (2, 3), (5, 7), (-3, 2), (1, 4))
)


def model_of(name: str) -> ExactModel:
    """The exact model of a robot file."""
    return exact_model(read_robot(ROBOTS / f"{name}.yaml").chain)


@cache
def solved(name: str) -> ZeroDimensionalParametrization:
    """All postures of one rational pose."""
    return exact_postures(model_of(name), TANGENTS)


def cos_sin(t: fmpq) -> tuple[fmpq, fmpq]:
    """Cosine and sine by the half-angle tangent."""
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


GIVEN = [x for t in TANGENTS for x in cos_sin(t)]


@pytest.mark.parametrize("name", ARMS)
def test_the_given_posture_is_among_them(name: str) -> None:
    """Exactly one real point has the (c, s) of the posture the pose was made from."""
    names = [f"{x}{k}" for k in range(1, 7) for x in "cs"]
    hits = 0
    for point in solved(name).real_points():
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
    signs = [p.sign(determinant, model.ring) for p in solved(name).real_points()]
    assert sum(signs) == 0
    assert 0 not in signs
    assert solved(name).degree <= 16


@pytest.mark.parametrize("name", ARMS)
def test_the_numeric_solver_finds_the_same(name: str) -> None:
    """Two routes: eigenvalues in doubles, and roots of the exact resultant."""
    model = model_of(name)
    solver = PostureSolver.of(model.chain)
    zeros = np.array([angle_value(joint.zero) for joint in model.joints])
    given = np.array([2 * np.arctan(int(t.p) / int(t.q)) for t in TANGENTS]) - zeros
    numeric = solver.solve(solver.poses(given[None]))[0]
    exact = []
    for point in solved(name).real_points():
        ball = {n: float(b.mid()) for n, b in point.ball(60).items()}
        turns = [np.arctan2(ball[f"s{k}"], ball[f"c{k}"]) for k in range(1, 7)]
        exact.append(np.array(turns) - zeros)
    assert len(numeric) == len(exact)
    for posture in exact:
        apart = np.remainder(numeric - posture + np.pi, 2 * np.pi) - np.pi
        assert np.abs(apart).max(axis=1).min() < 1e-9


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


def test_a_wrong_posture_over_a_root_is_left_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Roots are kept by substitution alone: from a false joint 5 no posture is left."""

    def wrong(turn: object, axis: object, ring: object) -> object:
        c, s = right(turn, axis, ring)
        return c, s + 1

    right = module._turn_of
    monkeypatch.setattr(module, "_turn_of", wrong)
    assert exact_postures(model_of("ur5"), TANGENTS).degree == 0


def test_postures_that_share_joint_2_are_refused() -> None:
    """A wrist flips at one joint 2: a double root, and nothing is claimed."""
    with pytest.raises(UnableError, match="share joint 2"):
        exact_postures(model_of("puma-560"), TANGENTS)


def test_what_is_not_solved_is_refused() -> None:
    """Three joints, or numbers in Q(sqrt 3)."""
    with pytest.raises(UnableError, match="six revolute"):
        exact_postures(exact_model(arm((1, 2, 3), (0, 1, 0), (90, 90, 0))), TANGENTS)
    skew = exact_model(with_wrist(arm((1, 2, 3), (0, 1, 0), (90, 90, 0)), (60, 90)))
    with pytest.raises(UnableError, match="sqrt 3"):
        exact_postures(skew, TANGENTS)


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
