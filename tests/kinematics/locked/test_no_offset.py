from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.locked.locked_arm import locked_arm
from cuspaudit.kinematics.locked.no_offset import has_no_offset
from cuspaudit.robot.chain import (
    X_AXIS,
    Angle,
    Chain,
    Joint,
    Rotation,
    Translation,
)

THIRD = Fraction(1, 3)


def move(x: int | Fraction, z: int | Fraction) -> Translation:
    """Along the common normal, and along the axis."""
    return Translation((Fraction(x), Fraction(0), Fraction(z)))


def tilt(half_turns: Fraction) -> Rotation:
    """A twist."""
    return Rotation(X_AXIS, Angle(half_turns))


def three(
    alpha1: Fraction, alpha2: Fraction, d2: int, d3: int, idle: bool = True
) -> Chain:
    """Three joints with a = 1, 2, 3/2 in D-H numbers, and one before them to lock."""
    joints = [
        Joint("j1", "revolute"),
        Joint("j2", "revolute", (move(1, 0), tilt(alpha1))),
        Joint("j3", "revolute", (move(2, d2), tilt(alpha2))),
    ]
    first = [Joint("j0", "revolute")] if idle else []
    return Chain("three", (*first, *joints), (move(Fraction(3, 2), d3),))


HALF = Fraction(1, 2)
CASES = [
    (HALF, THIRD, 0, 0, True),
    (HALF, HALF, 0, 1, True),
    (-HALF, Fraction(1, 6), 0, 0, True),
    (HALF, THIRD, 0, 1, False),
    (HALF, HALF, 1, 0, False),
    (THIRD, HALF, 0, 0, False),
]


@pytest.mark.parametrize(("alpha1", "alpha2", "d2", "d3", "expected"), CASES)
def test_offsets_are_told(
    alpha1: Fraction, alpha2: Fraction, d2: int, d3: int, expected: bool
) -> None:
    """The hypotheses are alpha1 = 90 deg, d2 = 0, and d3 = 0 or alpha2 = 90 deg."""
    held = locked_arm(three(alpha1, alpha2, d2, d3), 1)
    tip = held.arm.tool.translation, held.arm.ring.constant(1)
    assert has_no_offset(held, tip) is expected


@pytest.mark.parametrize(
    ("alpha1", "alpha2", "d2", "d3"), [case[:4] for case in CASES if case[4]]
)
def test_the_paper_agrees_that_they_are_noncuspidal(
    alpha1: Fraction, alpha2: Fraction, d2: int, d3: int
) -> None:
    """Algorithm 1 calls arms without offsets noncuspidal, as the theorem does."""
    model = exact_model(three(alpha1, alpha2, d2, d3, idle=False))
    assert answer(model).verdict is Verdict.NONCUSPIDAL


def test_two_signs_tell_the_postures_apart() -> None:
    """On a grid det J is a multiple of sin(t - t0) times the slope of a quadratic."""
    # D-H numbers 90 and 60 deg, a = 1, 2, 3/2, as in the proof: det J = a Du q'(u)
    a, c60 = (1.0, 2.0, 1.5), 0.5
    rng = np.random.default_rng(0)
    for theta, t in rng.uniform(-np.pi, np.pi, (50, 2)):
        flat = np.array([a[1] + a[2] * np.cos(t), a[2] * np.sin(t) * c60])
        c, s = np.cos(theta), np.sin(theta)
        p = c * flat[0] - s * flat[1]
        slope = -2 * a[1] * a[2] * p / (2 * a[0]) * 2
        slope -= 2 * a[2] * (a[1] + a[2] * np.cos(t)) - 2 * a[2] ** 2 * c60**2 * np.cos(
            t
        )
        det = determinant(theta, t, a, c60)
        assert det == pytest.approx(-a[0] * np.sin(t) * slope, abs=1e-6)


def determinant(theta: float, t: float, a: tuple[float, ...], c: float) -> float:
    """The Jacobian of (L, z) by differences."""

    def value(x: float, y: float) -> np.ndarray:
        flat = np.array([a[1] + a[2] * np.cos(y), a[2] * np.sin(y) * c])
        up = a[2] * np.sin(y) * np.sqrt(1 - c * c)
        p = np.cos(x) * flat[0] - np.sin(x) * flat[1]
        z = np.sin(x) * flat[0] + np.cos(x) * flat[1]
        return np.array([2 * a[0] * p + flat @ flat + up * up, z])

    h = 1e-6
    by_theta = (value(theta + h, t) - value(theta - h, t)) / (2 * h)
    by_t = (value(theta, t + h) - value(theta, t - h)) / (2 * h)
    return float(by_theta[0] * by_t[1] - by_t[0] * by_theta[1])
