from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from certified_arms import ARMS, det, from_dh, kinematics
from flint import arb
from structured_arms import elbow, pairs, some_pairs, without_offset

from cuspaudit.certificate import (
    PairsCertificate,
    certificate_from_text,
    text_from_certificate,
    verify,
)
from cuspaudit.certificate.balls import working_precision
from cuspaudit.certificate.pairs import pairs_proof
from cuspaudit.certificate.pairs.value_circles import value_circles
from cuspaudit.errors import InvalidCertificateError

TRUE = some_pairs()


def reason_against(claim: PairsCertificate) -> str:
    """Why the certificate is refused."""
    result = verify(claim)
    assert not result.accepted
    return result.reason


@pytest.mark.parametrize("name", TRUE)
def test_noncuspidal_arms_are_proved(name: str) -> None:
    """Two and four aspects, axes square or not, and the file is read back."""
    claim = certificate_from_text(text_from_certificate(TRUE[name]))
    assert claim == TRUE[name]
    result = verify(claim)
    assert result.accepted, result.reason
    assert result.claim == "noncuspidal"
    assert 100 < result.boxes < 10_000
    assert result.smallest is not None and result.smallest > 0


def test_a_cuspidal_arm_is_refused_whatever_parts_it() -> None:
    """The arms of the ISSAC paper and of Baili's WT2, with many parting values."""
    issac = ARMS["issac"]()
    wt2 = from_dh([1, 1.5, 0.7], [0, 0.5, 0], [-90, 90, 0])
    for robot in ((issac.joints, issac.tool), wt2):
        values = [v / 10 for v in range(63) if _parts(robot, v / 10)]
        assert values
        reason = reason_against(pairs(robot, *map(str, values)))
        assert "not proved to lie apart" in reason


def _parts(robot: object, value: float) -> bool:
    claim = pairs(robot, str(value))  # type: ignore[arg-type]
    with working_precision(64):
        return value_circles(claim, True).only_sign(arb(value)) is not None


@pytest.mark.parametrize("name", ["four aspects", "skew"])
def test_every_parting_value_is_needed(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Four aspects are parted by four values: without one, two of them are one."""
    monkeypatch.setattr(pairs_proof, "MOST_BOXES", 5000)
    claim = TRUE[name]
    for left_out in range(4):
        rest = tuple(v for k, v in enumerate(claim.parting) if k != left_out)
        assert "not proved" in reason_against(replace(claim, parting=rest))


def test_a_value_that_paths_of_both_signs_pass_parts_nothing() -> None:
    """It is refused, not passed over."""
    claim = TRUE["two aspects"]
    more = replace(claim, parting=(*claim.parting, Fraction(0)))
    assert "both signs may pass" in reason_against(more)


@pytest.mark.parametrize("name", TRUE)
def test_the_circles_are_those_of_the_arm(name: str) -> None:
    """Distances of values over t and w are those of heights and radii in floats."""
    claim, rng = TRUE[name], random.Random(1)
    with working_precision(64):
        circles = value_circles(claim, name != "skew")
    joints = claim.joints
    for _ in range(20):
        t = rng.uniform(-3, 3)
        signs = {np.sign(det(claim, (0, q, t))) for q in np.linspace(0, 6.2, 60)}
        found = circles.only_sign(arb(t))
        assert found is None or len(signs) == 1
    assert len(joints) == 3
    radius = [float(x.mid()) for x in circles.radius]
    for t in np.linspace(-3, 3, 7):
        waves = [1, np.cos(t), np.sin(t), np.cos(2 * t), np.sin(2 * t)]
        there, back = (kinematics(claim, (0, q, t))[0][:3, 3] for q in (0.0, np.pi))
        # half a turn of joint 2 moves the tip by twice its distance from axis 2
        across = np.linalg.norm(there - back) / 2
        assert np.dot(radius, waves) == pytest.approx(across**2, abs=1e-9)


def test_arms_of_which_the_theorem_does_not_speak_are_refused() -> None:
    """Axes 1 and 2 meeting, its own mirror image, a slide: each named, none proved."""
    meeting = from_dh([0, 0.7, 0.3], [0, 0.2, 0], [-90, 90, 0])
    assert "not to meet" in reason_against(pairs(meeting, "1"))
    level = from_dh([1, 0.7, 0.3], [0, 0.2, 0], [0, 90, 0])
    assert "not parallel" in reason_against(pairs(level, "1"))
    assert "mirror" in reason_against(pairs(without_offset()))
    joints, tool = elbow()
    slide = (*joints[:2], replace(joints[2], kind="prismatic"))
    assert "slides" in reason_against(pairs((slide, tool)))


def test_work_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """Too many boxes are a refusal and no endless search."""
    monkeypatch.setattr(pairs_proof, "MOST_BOXES", 50)
    assert "50 boxes" in reason_against(TRUE["two aspects"])


def test_pairs_are_of_positions() -> None:
    """The task is that of three joints."""
    with pytest.raises(InvalidCertificateError, match="joints"):
        verify(replace(TRUE["skew"], task="pose"))
