from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer

from cuspaudit.auditing.free_joint.moving_path import Locks, moving_path
from cuspaudit.auditing.search.lift import close
from cuspaudit.certificate import text_from_certificate
from cuspaudit.cli.verify_free import verify_free
from cuspaudit.errors import InvalidCertificateError
from cuspaudit.kinematics.locked.span import Span
from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.frames import angle_value

PATH = np.array(
    [
        [0.486, 1.084, -1.252, 0.571, -0.992, 2.97],
        [-0.239, 1.848, -2.149, 0.17, -0.091, 3.727],
        [-0.711, 2.462, -2.344, 0.27, 0.669, 4.221],
        [-1.613, 3.539, -2.031, 0.97, 2.049, 5.162],
    ]
)
"""Of a Panda whose joint 3 is locked at 40 deg, closed below."""

SPAN = Span(Angle(Fraction(7, 36)), Angle(Fraction(1, 4)))


@pytest.fixture(scope="module")
def certificate(seven_joints: Callable[[str], Chain]) -> dict[str, Any]:
    """The certificate of that path from 35 to 45 deg."""
    locks = Locks(seven_joints("franka-panda"), 3)
    moving = moving_path(
        locks,
        SPAN,
        close(locks.near(float(np.radians(40))), PATH),
        float(np.radians(40)),
    )
    assert moving is not None
    text = text_from_certificate(moving.certificate(locks, None))
    found: dict[str, Any] = json.loads(text)
    return found


def answer(certificate: dict[str, Any] | None, within: bool, *ends: float) -> int:
    """The exit code of a record with one interval."""
    witness = None if certificate is None else {"certificate": certificate}
    row = {"proof": "path", "lower": ends[0], "upper": ends[1], "witness": witness}
    record = {"within_limits": within, "stretches": [row]}
    with pytest.raises(typer.Exit) as done:
        verify_free(record, Path("record.json"), True)
    return done.value.exit_code


def test_an_interval_is_that_of_its_certificate(certificate: dict[str, Any]) -> None:
    """Ends beyond the certificate's, or in the wrong order, are rejected."""
    low, high = map(angle_value, (SPAN.lower, SPAN.upper))
    assert answer(certificate, False, low, high) == 0
    assert answer(certificate, False, low, high + 1e-9) == 1
    assert answer(certificate, False, high + 1, low - 1) == 1
    assert answer(certificate, False, low, float("nan")) == 1


def test_limits_are_those_of_the_certificate(certificate: dict[str, Any]) -> None:
    """A record within limits is not proved by a path that knows none."""
    low, high = map(angle_value, (SPAN.lower, SPAN.upper))
    assert answer(certificate, True, low, high) == 1
    wide = {**certificate, "limits": [["-7", "7"]] * 6}
    assert answer(wide, True, low, high) == 0


def test_a_path_without_its_certificate_is_missed() -> None:
    """An interval said to be proved by a path has to have one."""
    row = {"proof": "path", "lower": 0.0, "upper": 0.1, "witness": None}
    record = {"within_limits": False, "stretches": [row]}
    with pytest.raises(InvalidCertificateError, match="cut or altered"):
        verify_free(record, Path("record.json"), False)
