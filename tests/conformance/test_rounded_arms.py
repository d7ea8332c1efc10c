"""The PiPER: a spherical wrist by design, 1.4 mm beside it in its URDF [FACTS, 7]."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from cuspaudit.audit.library import open_robot
from cuspaudit.audit.report import Audit, Options, audit
from cuspaudit.certificate import verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.snap_policy import DEFAULT_POLICY

pytestmark = pytest.mark.slow


def audited(corpus: Path, length: Fraction) -> Audit:
    """The arm, lengths up to ``length`` m counting as 0 where that makes axes meet."""
    robot = open_robot(str(corpus / "urdf" / "agilex_piper.urdf"), tip="link6")
    return audit(robot, Options(snap=replace(DEFAULT_POLICY, length=length)))


def test_the_offset_of_the_file_is_kept_and_makes_the_arm_cuspidal(
    corpus: Path,
) -> None:
    """1.4 mm are no noise: by default both models have the offset and a witness."""
    found = audited(corpus, DEFAULT_POLICY.length)
    assert (found.verdict, found.literal) == (Verdict.CUSPIDAL, Verdict.CUSPIDAL)


def test_without_the_offset_the_models_differ_and_the_clearance_says_by_how_little(
    corpus: Path,
) -> None:
    """Snapped: a spherical wrist, noncuspidal. Literal: a path close to det J = 0."""
    found = audited(corpus, Fraction(2, 1000))
    assert (found.verdict, found.literal) == (Verdict.NONCUSPIDAL, Verdict.CUSPIDAL)
    assert found.answer.reduction is not None
    assert found.answer.reduction.kind == "spherical wrist"
    assert found.literal_witness is not None
    assert 0 < found.literal_witness.clearance < 0.01
    assert verify(found.literal_witness.certificate).accepted
