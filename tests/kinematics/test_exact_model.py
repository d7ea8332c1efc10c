from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from flint import arb
from hypothesis import given
from hypothesis import strategies as st
from short_tables import arm, degrees, shift

from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.transform import Transform
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.frames import angle_value, frames

TOLERANCE = Fraction(1, 10**12)
rationals = st.fractions(-3, 3, max_denominator=20)
directions = st.tuples(*[st.integers(-4, 4).map(Fraction)] * 3).filter(any)
angles = st.one_of(
    st.sampled_from([30, 45, 60, 90, 135, 180, -120, 210]).map(degrees),
    st.builds(Angle, rationals, rationals),
)
motions = st.lists(
    st.one_of(
        st.tuples(rationals, rationals, rationals).map(Translation),
        st.builds(Rotation, directions, angles),
    ),
    max_size=3,
).map(tuple)
joints = st.tuples(st.sampled_from(("revolute", "prismatic")), motions, directions)


def chain_of(rows: list[tuple[str, tuple[Motion, ...], Vector]], tool: object) -> Chain:
    """A chain with these joints and tool."""
    made = (Joint(f"j{i}", *row) for i, row in enumerate(rows))
    return Chain("chain", tuple(made), tool)


def placed(model: ExactModel, values: np.ndarray) -> np.ndarray:
    """The tip's frame by the exact model, evaluated in floating point."""
    result = np.eye(4)
    assignment = {}
    for joint, value in zip(model.joints, values, strict=True):
        if joint.kind == "revolute":
            turned = value + angle_value(joint.zero)
            c, s = joint.variables
            assignment |= {c: arb(math.cos(turned)), s: arb(math.sin(turned))}
        else:
            assignment[joint.variables[0]] = arb(value)
    for joint in model.joints:
        result = result @ matrix(joint.before, assignment)
        result = result @ matrix(model.motion(joint), assignment)
    return result @ matrix(model.tool, assignment)


def matrix(transform: Transform, assignment: dict[str, arb]) -> np.ndarray:
    """A transform of polynomials as a matrix of floats."""

    def number(entry: object) -> float:
        return float(transform.ring.evaluate(entry, assignment).mid())

    result = np.eye(4)
    result[:3, :3] = [[number(x) for x in row] for row in transform.rotation]
    result[:3, 3] = [number(x) for x in transform.translation]
    return result


@given(st.lists(joints, min_size=1, max_size=3), motions, st.integers(0, 10**6))
def test_the_model_moves_as_the_chain(
    rows: list[tuple[str, tuple[Motion, ...], Vector]], tool: object, seed: int
) -> None:
    """Tip frames by the exact model and by plain matrices agree, near 1e-12."""
    chain = chain_of(rows, tool)
    values = np.random.default_rng(seed).uniform(-3, 3, len(rows))
    exact = placed(exact_model(chain), values)
    assert np.allclose(exact, frames(chain, values)[-1], atol=1e-9)


@given(directions, angles)
def test_turns_are_rotations_exactly(axis: Vector, angle: Angle) -> None:
    """Even an approximated turn is orthogonal with determinant 1, in the field."""
    chain = chain_of([("revolute", (Rotation(axis, angle),), Z_AXIS)], ())
    model = exact_model(replace(chain, tool=(Rotation(axis, angle),)))
    turn, ring = model.tool, model.ring
    product = turn @ turn.inverse()
    for i in range(3):
        assert product.translation[i] == 0
        for j in range(3):
            assert ring.reduce(product.rotation[i][j]) == (1 if i == j else 0)


@pytest.mark.parametrize("value", [0, 30, 45, 60, 90, 120, 150, 225, 300, -30, 405])
def test_special_angles_are_exact(value: int) -> None:
    """Multiples of 30 and 45 degrees have their cosine and sine in the field."""
    chain = chain_of([("prismatic", (), Z_AXIS)], (Rotation(X_AXIS, degrees(value)),))
    model = exact_model(chain)
    assert model.is_exact
    (_, row, _) = model.tool.rotation
    cosine, sine = (float(model.ring.evaluate(p, {}).mid()) for p in (row[1], -row[2]))
    assert math.isclose(cosine, math.cos(math.radians(value)), abs_tol=1e-15)
    assert math.isclose(sine, math.sin(math.radians(value)), abs_tol=1e-15)
    one = model.ring.reduce(row[1] ** 2 + row[2] ** 2)
    assert one == 1


@given(st.builds(Angle, rationals, rationals), st.sampled_from((X_AXIS, Y_AXIS)))
def test_other_angles_are_near_and_noted(angle: Angle, axis: Vector) -> None:
    """Another angle is a rational point within the tolerance, and on the record."""
    chain = chain_of([("prismatic", (), Z_AXIS)], (Rotation(axis, angle),))
    for tolerance in (TOLERANCE, Fraction(1, 1000)):
        model = exact_model(chain, tolerance)
        exact = placed(model, np.zeros(1))
        error = np.abs(exact - frames(chain, [0.0])[-1]).max()
        assert error <= float(tolerance) + 1e-15
        if not model.is_exact:
            assert model.approximations[0].where == "tool, angle"
            assert model.approximations[0].difference == float(tolerance)


@given(directions)
def test_axes_are_unit_exactly(axis: Vector) -> None:
    """A joint axis has length 1 in the model; irrational lengths are noted."""
    model = exact_model(chain_of([("revolute", (), axis)], ()))
    unit, ring = model.joints[0].axis, model.ring
    assert ring.total(x * x for x in unit) == 1
    length = math.sqrt(sum(float(x) ** 2 for x in axis))
    for entry, wanted in zip(unit, axis, strict=True):
        value = float(ring.evaluate(entry, {}).mid())
        assert abs(value - float(wanted) / length) < 2e-12
    square = sum(x * x for x in axis)
    rational = math.isqrt(square.numerator) ** 2 == square.numerator
    assert model.is_exact == rational


def test_a_pythagorean_axis_is_exact() -> None:
    """(1, 2, 2)/3 and (3, 4)/5 are unit vectors over Q."""
    for axis in ((1, 2, 2), (0, 3, 4), (2, 3, 6), (0, 0, -7)):
        x, y, z = map(Fraction, axis)
        assert exact_model(chain_of([("prismatic", (), (x, y, z))], ())).is_exact


def test_a_turn_about_the_own_axis_shifts_the_zero() -> None:
    """Turns by any angle about the joint's axis need no cosine; others stay."""
    odd = Angle(radians=Fraction(1, 7))
    before = (
        Rotation(X_AXIS, degrees(90)),
        Rotation(Z_AXIS, odd),
        Rotation((Fraction(0), Fraction(0), Fraction(-2)), degrees(45)),
    )
    model = exact_model(chain_of([("revolute", before, Z_AXIS)], ()))
    assert model.is_exact
    assert model.ring.radicand is None
    assert model.joints[0].zero == odd + degrees(-45)
    joints = [("revolute", (), X_AXIS), ("prismatic", before, Z_AXIS)]
    slide = exact_model(chain_of(joints, ()))
    assert not slide.is_exact
    assert slide.joints[1].zero.is_zero


@pytest.mark.parametrize(
    ("alpha", "radicand"),
    [
        ((90, 90, 0), None),
        ((45, 90, 0), 2),
        ((30, 60, 0), 3),
        ((60, 135, 0), None),
        ((77, 60, 0), None),
        ((60, 90, 120), 3),
    ],
)
def test_the_field_of_a_three_joint_arm(
    alpha: tuple[int, ...], radicand: int | None
) -> None:
    """Q, or the one quadratic field that is asked for; Q when two are."""
    assert exact_model(arm((1, 1, 1), (0, 1, 0), alpha)).ring.radicand == radicand


def test_the_field_of_a_six_joint_arm() -> None:
    """The field that most angles ask for."""
    chain = arm((1,) * 6, (0,) * 6, (30, 45, 60, 90, 30, 0))
    model = exact_model(chain)
    assert model.ring.radicand == 3
    assert len(model.approximations) == 1


def test_opposite_angles_stay_opposite() -> None:
    """A turn by an odd angle and back is the identity, exactly."""
    angle = Angle(radians=Fraction(123, 457))
    tool = (Rotation(X_AXIS, angle), shift(0, 0, 0), Rotation(X_AXIS, -angle))
    model = exact_model(chain_of([("prismatic", (), Z_AXIS)], tool))
    identity = [[int(i == j) for j in range(3)] for i in range(3)]
    assert [list(row) for row in model.tool.rotation] == identity


def test_variables_are_numbered_from_the_base() -> None:
    """c_i and s_i for a turning joint, q_i for a sliding one."""
    model = exact_model(arm((1, 1, 1), (0, 1, 0), (90, 90, 0), "RPR"))
    assert model.ring.variables == ("c1", "s1", "q2", "c3", "s3")
    assert [joint.variables for joint in model.joints] == [
        ("c1", "s1"),
        ("q2",),
        ("c3", "s3"),
    ]
