from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from certified_arms import ARMS, crx, kinematics, with_offset
from flint import arb, arb_mat
from hypothesis import given, settings
from hypothesis import strategies as st

from cuspaudit.certificate import PathCertificate, Translate, krawczyk
from cuspaudit.certificate.arm import arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.krawczyk import PostureBox, _system, true_posture


def box_round(arm: PathCertificate, second: Any, bits: int = 128) -> PostureBox | None:
    """The box that holds the true posture next to ``second``."""
    with working_precision(bits):
        first, near = (
            [ball_from_fraction(Fraction(x)) for x in row]
            for row in (arm.postures[0], second)
        )
        return true_posture(arm_from_certificate(arm, arb), first, near)


def newton(arm: PathCertificate, bits: int = 512) -> list[arb]:
    """The true second posture by Newton's method with many bits."""
    with working_precision(bits):
        balls = arm_from_certificate(arm, arb)
        q0, q = ([ball_from_fraction(x) for x in row] for row in arm.postures)
        target = balls.outward(0, q0)[1]
        for _ in range(5):
            F, J, _ = _system(balls, q, target)
            step = J.mid().inv() * F.mid()
            q = [x - step[i, 0].mid() for i, x in enumerate(q)]
        return q


@pytest.mark.parametrize("name", ARMS)
def test_the_true_posture_is_in_the_box(
    name: str, certified: dict[str, PathCertificate]
) -> None:
    """The limit of Newton's method with 512 bits lies in the box found with 128."""
    arm = certified[name]
    box = box_round(arm, arm.postures[1])
    assert box is not None
    assert box.radius < 1e-12
    for side, value in zip(box.values, newton(arm), strict=True):
        assert side.contains(value.mid())


@pytest.mark.parametrize("name", ["issac", "sliding", "crx"])
@pytest.mark.parametrize(("by", "found"), [("1e-12", True), ("1e-8", False)])
def test_the_box_grows_with_the_defect_up_to_its_bound(
    name: str, by: str, found: bool, certified: dict[str, PathCertificate]
) -> None:
    """A rough second posture needs a larger box; one beyond 1e-9 is refused."""
    arm = certified[name]
    second = (arm.postures[1][0] + Fraction(by), *arm.postures[1][1:])
    box = box_round(arm, second)
    assert (box is not None) == found
    if box:
        assert 5e-13 < box.radius < 1e-11


def test_the_derivative_is_that_of_differences(arm6: PathCertificate) -> None:
    """F' agrees with differences of F, at a pose far from the target."""
    with working_precision(256):
        balls = arm_from_certificate(arm6, arb)
        q0, q = ([ball_from_fraction(x) for x in row] for row in arm6.postures)
        q = [x + arb(i + 1) / 10 for i, x in enumerate(q)]
        target = balls.outward(0, q0)[1]
        F, J, _ = _system(balls, q, target)
        step = arb(2) ** -60
        for j in range(6):
            there = [x + (step if i == j else 0) for i, x in enumerate(q)]
            change = (_system(balls, there, target)[0] - F) / step
            column = arb_mat(6, 1, [J[i, j] for i in range(6)])
            difference = (change - column).entries()
            assert all(entry.abs_upper() < 1e-15 for entry in difference)


@settings(max_examples=10, deadline=None)
@given(st.lists(st.integers(-20, 20), min_size=6, max_size=6))
def test_every_posture_is_a_posture_of_its_own_pose(tenths: list[int]) -> None:
    """Next to a regular posture lies exactly one of its pose: itself."""
    arm = crx()
    q = tuple(Fraction(n, 10) + Fraction(1, 7) for n in tenths)
    J = kinematics(arm, q)[1]
    if abs(np.linalg.det(J)) > 1e-4:
        box = box_round(replace(arm, postures=(q, q), path=(q, q)), q)
        assert box is not None
        assert box.radius < 1e-15


def test_a_half_turn_is_another_pose(arm6: PathCertificate) -> None:
    """A hand turned half round its own axis has the same skew part, not the pose."""
    pi = Fraction("3.14159265358979323846264338327950288")
    *others, last = arm6.postures[0]
    assert box_round(arm6, (*others, last + pi)) is None


def test_no_box_reaches_over_a_singularity(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where two postures of one pose are closer than the box is wide, none is proved.

    The posture is 1e-10 from a fold, and the box reaches 2^-31 > 4e-10 to each side.
    """
    first = (Fraction(0), Fraction(1, 10**10), Fraction(0))
    arm = replace(with_offset(), postures=(first, first), path=(first, first))
    exact = box_round(arm, first)
    assert exact is not None
    assert exact.radius < 1e-10
    monkeypatch.setattr(krawczyk, "_exponents", lambda newton: [-31])
    assert box_round(arm, first) is None


def test_a_box_without_a_posture_is_refused(
    arm6: PathCertificate, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A box of 1e-12 round a point 1e-10 away from the posture holds none."""
    second = (arm6.postures[1][0] + Fraction(1, 10**10), *arm6.postures[1][1:])
    assert box_round(arm6, second) is not None
    monkeypatch.setattr(krawczyk, "_exponents", lambda newton: [-40])
    assert box_round(arm6, second) is None


def test_a_singular_posture_is_refused(arm3: PathCertificate) -> None:
    """Where the Jacobian matrix is singular no box is found."""
    zero = (Fraction(0),) * 3
    still = tuple(replace(joint, before=()) for joint in arm3.joints)
    arm = replace(arm3, joints=still, tool=(), postures=(zero, zero))
    assert box_round(arm, zero) is None
    far = Translate((Fraction(1), Fraction(0), Fraction(0)))
    assert box_round(replace(arm, tool=(far,)), zero) is None
