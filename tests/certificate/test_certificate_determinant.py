from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from certified_arms import ARMS, X, Z, det, kinematics
from flint import arb, arb_series
from hypothesis import given, settings
from hypothesis import strategies as st

from cuspaudit.certificate import CertifiedJoint, PathCertificate, Rotate, Translate
from cuspaudit.certificate.arm import arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.determinant import jacobian_determinant

small = st.integers(-12, 12).map(lambda n: Fraction(n, 4))
vectors = st.tuples(small, small, small)
axes = vectors.filter(any)
motions = st.one_of(
    st.builds(Translate, vectors), st.builds(Rotate, axes, small, small)
)
joints = st.builds(
    CertifiedJoint,
    st.just("joint"),
    st.sampled_from(["revolute", "revolute", "prismatic"]),
    axes,
    st.lists(motions, max_size=2).map(tuple),
)


@st.composite
def arms(draw: Any) -> PathCertificate:
    """Any arm, with a posture and a direction to move in as its postures."""
    size = draw(st.sampled_from([3, 6]))
    row = st.tuples(*[small] * size)
    postures = draw(row), draw(row)
    return PathCertificate(
        robot_name="any",
        task="position" if size == 3 else "pose",
        unit="m",
        joints=tuple(draw(st.lists(joints, min_size=size, max_size=size))),
        tool=tuple(draw(st.lists(motions, max_size=2))),
        sign=1,
        postures=postures,
        path=postures,
    )


def value_at(arm: PathCertificate, q: Any, bits: int = 128) -> arb:
    """Det J in balls at exact joint values; 0 where no term is left."""
    with working_precision(bits):
        balls = [ball_from_fraction(Fraction(x)) for x in q]
        value = jacobian_determinant(arm_from_certificate(arm, arb), balls)
    return arb(0) if value is None else value


@settings(max_examples=60, deadline=None)
@given(arms())
def test_det_is_that_of_the_geometric_jacobian(arm: PathCertificate) -> None:
    """In the coordinates of a middle link det J has the value it has in the base."""
    q = arm.postures[0]
    value, size = value_at(arm, q), len(arm.joints)
    J = kinematics(arm, q)[1][:size]
    scale = np.prod(np.linalg.norm(J, axis=0)) + 1
    assert abs(float(value) - float(np.linalg.det(J))) < 1e-10 * scale
    assert value.rad() < 1e-25 * scale


@settings(max_examples=30, deadline=None)
@given(arms())
def test_more_bits_agree(arm: PathCertificate) -> None:
    """Balls of two precisions enclose one number, so they meet."""
    q = arm.postures[0]
    assert value_at(arm, q, 64).overlaps(value_at(arm, q, 512))


@settings(max_examples=30, deadline=None)
@given(arms(), st.fractions(-1, 1))
def test_a_taylor_expansion_encloses_det(arm: PathCertificate, s: Fraction) -> None:
    """The polynomial at 0 and the remainder over [-1/8, 1/8] enclose det J at s/8."""
    q, step = arm.postures
    t = s / 8

    def series(box: arb) -> list[arb]:
        lifted = arm_from_certificate(arm, lambda ball: arb_series([ball]))
        balls = [
            arb_series([ball_from_fraction(x) + box * ball_from_fraction(d)])
            + arb_series([0, ball_from_fraction(d)])
            for x, d in zip(q, step, strict=True)
        ]
        value = jacobian_determinant(lifted, balls)
        return [arb(0) if value is None else value[k] for k in range(5)]

    with working_precision(128, 5):
        at, over = series(arb(0)), series(arb(0, arb(1) / 8))
        h = ball_from_fraction(t)
        enclosure = sum((at[k] * h**k for k in range(4)), arb(0)) + over[4] * h**4
    there = [x + t * d for x, d in zip(q, step, strict=True)]
    assert enclosure.overlaps(value_at(arm, there, 512))


@pytest.mark.parametrize("name", ARMS)
def test_the_known_arms_have_their_det(
    name: str, certified: dict[str, PathCertificate]
) -> None:
    """Balls and floats agree on every known arm, to float accuracy."""
    arm = certified[name]
    for q in arm.postures:
        assert float(value_at(arm, q)) == pytest.approx(det(arm, q), rel=1e-9)


def test_the_paper_s_determinant(arm3: PathCertificate) -> None:
    """For the ISSAC arm 8 det J = -6 (3 c3 + 4)(c2 c3 - 2 c2 s3 - s3)."""
    q = arm3.postures[0]
    c2, s3, c3 = np.cos(float(q[1])), np.sin(float(q[2])), np.cos(float(q[2]))
    delta = -6 * (3 * c3 + 4) * (c2 * c3 - 2 * c2 * s3 - s3)
    assert 8 * float(value_at(arm3, q)) == pytest.approx(delta, rel=1e-12)


def test_right_angles_stay_exact() -> None:
    """Multiples of a right angle about coordinate axes leave no rounding behind."""
    half = Fraction(1, 2)
    turn = Rotate(X, half), Translate((Fraction(1), Fraction(0), Fraction(0)))
    plain = CertifiedJoint("a", "revolute", Z)
    planar = PathCertificate(
        robot_name="planar",
        task="position",
        unit="m",
        joints=(plain, CertifiedJoint("b", "revolute", Z, turn), plain),
        tool=turn,
        sign=1,
        postures=((half,) * 3, (half,) * 3),
        path=((half,) * 3, (half,) * 3),
    )
    with working_precision(128):
        frame = arm_from_certificate(planar, arb).joints[1].before
    assert [sum(entry is None for entry in row) for row in frame.R] == [2, 2, 2]
    assert all(x is None or x.is_exact() for row in frame.R for x in row)
