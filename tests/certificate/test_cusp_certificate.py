"""Cusps as proof: what is accepted, and what must not be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from flint import arb, arb_series
from short_tables import arm

from cuspaudit.auditing.proofs.certified_robot import certified_robot
from cuspaudit.auditing.search.cusps import search_cusps
from cuspaudit.certificate import (
    CuspCertificate,
    certificate_from_text,
    text_from_certificate,
    verify,
)
from cuspaudit.certificate.balls import working_precision
from cuspaudit.certificate.cusp_point import CuspBox, true_cusp
from cuspaudit.errors import InvalidCertificateError
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import jacobian

SIX = arm(
    ("1/10", "7/10", "1/20", 0, 0, 0),
    (0, 0, "3/20", "7/10", 0, "1/10"),
    (-90, 0, -90, 90, -90, 0),
)
#: like the CRX: the last three axes do not meet in one point
OFFSET = arm(
    (0, "27/50", 0, 0, 0, 0),
    (0, 0, 0, "27/50", "3/20", "4/25"),
    (-90, 180, -90, 90, -90, 180),
)
THREE = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))


def cusp_of(chain: Chain) -> CuspCertificate:
    """The certificate of a cusp that a search met."""
    found = search_cusps(chain, [None] * len(chain.joints), starts=12)[0]
    posture = tuple(Fraction(repr(value)) for value in found.posture)
    return CuspCertificate(**certified_robot(chain), posture=posture)


@pytest.fixture(scope="module", params=["six", "three"])
def certificate(request: pytest.FixtureRequest) -> CuspCertificate:
    """A certificate that is accepted."""
    return cusp_of(OFFSET if request.param == "six" else THREE)


def test_a_true_cusp_is_accepted(certificate: CuspCertificate) -> None:
    """The proof of a cusp that is one, in well under the time a reader notices."""
    result = verify(certificate)
    assert result.accepted
    assert result.claim == "cuspidal"
    assert "has a cusp" in result.reason
    assert result.smallest is not None
    assert result.smallest > 0


def test_it_is_the_same_from_its_file(certificate: CuspCertificate) -> None:
    """Written and read again, nothing has changed."""
    assert certificate_from_text(text_from_certificate(certificate)) == certificate


@pytest.mark.parametrize("joint", [1, 2])
def test_a_moved_posture_is_refused(certificate: CuspCertificate, joint: int) -> None:
    """A thousandth of a radian away nothing is proved."""
    posture = list(certificate.posture)
    posture[joint] += Fraction(1, 1000)
    result = verify(replace(certificate, posture=tuple(posture)))
    assert not result.accepted
    assert "no cusp is proved near" in result.reason


def test_the_first_joint_may_be_anywhere(certificate: CuspCertificate) -> None:
    """Joint 1 moves neither det J nor its kernel."""
    posture = (Fraction(5), *certificate.posture[1:])
    assert verify(replace(certificate, posture=posture)).accepted


def test_a_cusp_must_be_inside_the_limits(certificate: CuspCertificate) -> None:
    """Limits around the posture are proved, a box that leaves them is not."""
    wide = [(value - 1, value + 1) for value in certificate.posture]
    result = verify(replace(certificate, limits=tuple(wide)))
    assert result.accepted
    assert "inside the joint limits" in result.reason
    near = list(wide)
    near[1] = (certificate.posture[1], certificate.posture[1] + 1)
    for limits in (near, [(low + 4, high + 4) for low, high in wide]):
        result = verify(replace(certificate, limits=tuple(limits)))
        assert not result.accepted
        assert "inside the limits of joint_" in result.reason


def test_a_winding_is_not_another(certificate: CuspCertificate) -> None:
    """A turn further the posture is the same, the limits are not."""
    limits = tuple((value - 1, value + 1) for value in certificate.posture)
    turned = [*certificate.posture]
    turned[2] += Fraction(6283185307179586, 10**15)
    assert not verify(
        replace(certificate, limits=limits, posture=tuple(turned))
    ).accepted


def test_a_posture_that_is_singular_only_is_refused() -> None:
    """Without the second condition there is a fold, and no cusp."""
    certificate = cusp_of(THREE)

    def h(x: float) -> float:
        return float(np.linalg.det(jacobian(THREE, [0.0, 0.3, x])))

    steps = np.linspace(-3.0, 3.0, 61)
    low, high = next(ends for ends in pairwise(steps) if h(ends[0]) * h(ends[1]) < 0)

    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if h(low) * h(middle) > 0 else (low, middle)
    assert abs(h(low)) < 1e-12
    q = np.array([[0.0, 0.3, low]])
    posture = tuple(Fraction(repr(float(x))) for x in q[0])
    assert not verify(replace(certificate, posture=posture)).accepted


def test_noncuspidal_arms_have_none() -> None:
    """A spherical wrist with a regular shoulder: nothing a search meets is proved."""
    for found in search_cusps(SIX, [None] * 6, starts=12)[:4]:
        posture = tuple(Fraction(repr(value)) for value in found.posture)
        certificate = CuspCertificate(**certified_robot(SIX), posture=posture)
        assert not verify(certificate).accepted


@dataclass(frozen=True)
class Swallowtail:
    """(u^4 + u y, y) with y = v + u^2: h = 4 u^3 + v + u^2, no cusp at 0."""

    variables: Sequence[int] = (0, 1)

    def determinant(self, q: Sequence[arb_series]) -> arb_series:
        """Det J."""
        u, v = q
        return 4 * u * u * u + v + u * u

    def kernel(self, q: Sequence[arb_series]) -> list[arb_series]:
        """adj(J) e_1."""
        return [arb_series([1]), -2 * q[0]]


class WithConstantKernel(Swallowtail):
    """The same with the vector that spans the kernel at 0."""

    def kernel(self, q: Sequence[arb_series]) -> list[arb_series]:
        """No field."""
        return [arb_series([1]), arb_series([0])]


class Bent(Swallowtail):
    """(u^3 + u y, y) with y = v - 3 u^2: h = v, a cusp at 0."""

    def determinant(self, q: Sequence[arb_series]) -> arb_series:
        """Det J."""
        return q[1]

    def kernel(self, q: Sequence[arb_series]) -> list[arb_series]:
        """adj(J) e_1."""
        return [arb_series([1]), 6 * q[0]]


class Twice(Swallowtail):
    """(u^2 - v^2, u v): the rank drops by two at 0, where h = 2 (u^2 + v^2)."""

    def determinant(self, q: Sequence[arb_series]) -> arb_series:
        """Det J."""
        return 2 * (q[0] * q[0] + q[1] * q[1])

    def kernel(self, q: Sequence[arb_series]) -> list[arb_series]:
        """adj(J) e_1."""
        return [q[0], -q[1]]


def at_zero(field: Swallowtail) -> CuspBox | str:
    """What is said of the point 0."""
    with working_precision(128, 3):
        return true_cusp(field, [arb(0), arb(0)], 128)


def test_the_kernel_is_taken_as_a_field() -> None:
    """A constant vector would accept a false cusp, and refuse a true one."""
    assert isinstance(at_zero(Bent()), CuspBox)
    assert isinstance(at_zero(Swallowtail()), str)
    # the mistake, made on purpose: it is accepted, so this test can see it
    assert isinstance(at_zero(WithConstantKernel()), CuspBox)


def test_a_rank_drop_of_two_is_no_cusp() -> None:
    """Where two columns vanish nothing is proved."""
    assert isinstance(at_zero(Twice()), str)


def test_the_file_must_fit() -> None:
    """One number a joint, and a task that has cusps."""
    certificate = cusp_of(THREE)
    with pytest.raises(InvalidCertificateError, match="posture"):
        verify(replace(certificate, posture=certificate.posture[:2]))
    text = text_from_certificate(certificate).replace('"cusp"', '"cups"')
    with pytest.raises(InvalidCertificateError, match="kinds"):
        certificate_from_text(text)


def test_virtual_joints_have_no_limits() -> None:
    """The claim is not about a joint that no motor makes."""
    certificate = cusp_of(OFFSET)
    limits = tuple((value - 1, value + 1) for value in certificate.posture)
    five = replace(certificate, task="position-and-axis", tool=())
    assert "virtual" in verify(replace(five, limits=limits)).reason
