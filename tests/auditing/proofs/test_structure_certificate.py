from __future__ import annotations

import pytest

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.proofs.certificates import certificate_of_audit
from cuspaudit.auditing.proofs.pairs_certificate import pairs_certificate
from cuspaudit.auditing.proofs.structure_certificate import structure_certificate
from cuspaudit.certificate import (
    PairsCertificate,
    PathCertificate,
    StructureCertificate,
    certificate_from_text,
    text_from_certificate,
    verify,
)
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.virtual_joint import with_virtual_joint


@pytest.mark.parametrize(
    ("name", "theorem"),
    [
        ("puma-560", "spherical wrist"),
        ("stanford-arm", "spherical wrist"),
        ("ur5", "UR pattern"),
        ("adept-cobra-600", "parallel axes"),
        ("rawr-orion-5", "yaw and pitch"),
        ("anthropomorphic-offset", "pair of axes"),
    ],
)
def test_noncuspidal_arms_of_the_library_have_a_certificate(
    name: str, theorem: str
) -> None:
    """A stranger can check the theorem from the file alone."""
    found = structure_certificate(with_virtual_joint(open_robot(name).chain))
    assert found is not None
    assert found.theorem == theorem
    assert verify(certificate_from_text(text_from_certificate(found))).accepted


@pytest.mark.parametrize(
    "name", ["fanuc-crx-10ia-l", "chablat-2022-3r", "raghavan-roth", "chablat-2022-6r"]
)
def test_cuspidal_arms_have_none(name: str) -> None:
    """No theorem says noncuspidal of an arm that is cuspidal."""
    chain = with_virtual_joint(open_robot(name).chain)
    assert structure_certificate(chain) is None


def test_an_audit_has_the_certificate_of_its_verdict() -> None:
    """A path where it is cuspidal, a structure where not; both say whose numbers."""
    cuspidal = certificate_of_audit(audit(open_robot("chablat-2022-3r")))
    assert isinstance(cuspidal, PathCertificate)
    assert cuspidal.numbers == "literal"
    other = certificate_of_audit(audit(open_robot("puma-560-arm")))
    assert isinstance(other, StructureCertificate)
    assert other.numbers == "literal"
    assert verify(other).accepted


def test_baili_s_arm_is_certified_by_its_pairs() -> None:
    """Noncuspidal with four aspects, and no relation of its axes says so."""
    found = certificate_of_audit(audit(open_robot("baili-2004-wt8")))
    assert isinstance(found, PairsCertificate)
    assert verify(found).accepted


@pytest.mark.parametrize(
    "name", ["baili-2004-wt1", "wenger-2007-a3-0.1", "salunkhe-2022-fig4b"]
)
def test_an_exact_run_of_three_joints_has_a_certificate_of_pairs(name: str) -> None:
    """Noncuspidal without a relation of the axes, and still provable by a stranger."""
    found = pairs_certificate(open_robot(name).chain)
    assert found is not None
    assert 2 <= len(found.parting) <= 4
    assert verify(certificate_from_text(text_from_certificate(found))).accepted
