from __future__ import annotations

import pytest

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.certificates import certificate_of_audit
from cuspaudit.auditing.structure_certificate import structure_certificate
from cuspaudit.certificate import (
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


def test_a_verdict_of_an_exact_run_alone_has_no_certificate() -> None:
    """Baili's arm is noncuspidal, and no relation of its axes says so."""
    assert certificate_of_audit(audit(open_robot("baili-2004-wt8"))) is None
