from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cuspaudit.auditing.free_joint.moving_path import Locks, moving_path
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.witness import certified
from cuspaudit.certificate import (
    Lock,
    LockCertificate,
    certificate_from_text,
    text_from_certificate,
    verify,
)
from cuspaudit.errors import InvalidCertificateError
from cuspaudit.kinematics.locked.span import Span
from cuspaudit.robot.chain import Angle, Chain

PATH = np.array(
    [
        [0.486, 1.084, -1.252, 0.571, -0.992, 2.97],
        [-0.239, 1.848, -2.149, 0.17, -0.091, 3.727],
        [-0.711, 2.462, -2.344, 0.27, 0.669, 4.221],
        [-1.613, 3.539, -2.031, 0.97, 2.049, 5.162],
    ]
)
"""Of a Panda whose joint 3 is locked at 40 deg, found by a search; closed below."""

SPAN = Span(Angle(Fraction(7, 36)), Angle(Fraction(1, 4)))


@pytest.fixture(scope="module")
def locks(seven_joints: Callable[[str], Chain]) -> Locks:
    """A Panda with joint 3 to be locked."""
    return Locks(seven_joints("franka-panda"), 3)


@pytest.fixture(scope="module")
def moving(locks: Locks) -> LockCertificate:
    """The certificate of the path above from 35 to 45 deg."""
    path = close(locks.near(np.radians(40)), PATH)
    found = moving_path(locks, SPAN, path, np.radians(40))
    assert found is not None
    return found.certificate(locks, None)


def test_a_path_is_proved_for_all_values_of_a_span(moving: LockCertificate) -> None:
    """One certificate proves the Panda cuspidal for joint 3 from 35 to 45 deg."""
    result = verify(moving)
    assert result.accepted, result.reason
    assert result.claim == "cuspidal"
    assert result.smallest is not None
    assert result.smallest > 0
    assert "every value of the locked joint within 5 deg" in result.reason


def test_single_values_have_the_path_by_the_other_checker(
    moving: LockCertificate, locks: Locks
) -> None:
    """At random values of the span the path is a witness of the ordinary kind."""
    rng = random.Random(0)
    half = float(moving.lock.half)
    given = moving.path, moving.slopes, moving.bends
    place, slope, bend = (np.array(rows, dtype=float) for rows in given)
    for _ in range(4):
        d = rng.uniform(-half, half)
        chain = locks.near(np.radians(40) + d)
        proposed = place + d * (slope + d * bend)
        path = close(chain, proposed)
        witness = certified(chain, path)
        assert witness.verification.accepted
        assert np.abs(path[-1] - proposed[-1]).max() < 0.01


def test_a_certificate_survives_its_file(moving: LockCertificate) -> None:
    """A lock certificate is read back from its text as it was."""
    assert certificate_from_text(text_from_certificate(moving)) == moving


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"sign": "other"}, "opposite sign"),
        ({"half": 30}, "proved"),
        ({"slopes": 0}, "no second posture"),
        ({"end": Fraction(1, 100)}, "no second posture"),
        ({"still": Fraction(1, 100)}, "no second posture"),
        ({"limits": (Fraction(-3), Fraction(3))}, "limits"),
    ],
)
def test_what_is_false_is_refused(
    moving: LockCertificate, change: dict[str, object], said: str
) -> None:
    """A wrong sign, a span too long, a path that stays, another end: all refused."""
    result = verify(changed(moving, change))
    assert not result.accepted
    assert said in result.reason


def changed(moving: LockCertificate, change: dict[str, object]) -> LockCertificate:
    """The certificate with one thing made false."""
    [(key, value)] = change.items()
    if key == "sign":
        return replace(moving, sign=-1 if moving.sign == 1 else 1)
    if key == "half":
        return replace(moving, lock=replace(moving.lock, half=moving.lock.half * 30))
    if key == "slopes":
        return replace(moving, slopes=tuple((Fraction(0),) * 6 for _ in moving.path))
    if key == "still":  # at a single value, and its end off
        moving = replace(moving, lock=replace(moving.lock, half=Fraction(0)))
    if key in ("end", "still"):
        *path, last = moving.path
        return replace(moving, path=(*path, tuple(x + value for x in last)))
    return replace(moving, limits=(value,) * 6)


def test_limits_that_hold_the_path_are_proved(moving: LockCertificate) -> None:
    """Within limits of 6 rad the same path is a proof within them."""
    wide = (Fraction(-6), Fraction(6))
    result = verify(replace(moving, limits=(wide,) * 6))
    assert result.accepted
    assert result.reason.endswith("inside the joint limits")


@pytest.mark.parametrize(
    ("lock", "where"),
    [
        (Lock(4, 1, Fraction(1, 10)), "lock.motion: a translation"),
        (Lock(3, 9, Fraction(1, 10)), "lock.motion"),
        (Lock(9, 0, Fraction(1, 10)), "lock.joint"),
        (Lock(3, 1, Fraction(-1)), "lock.half"),
    ],
)
def test_a_lock_is_a_rotation_of_the_robot(
    moving: LockCertificate, lock: Lock, where: str
) -> None:
    """A lock that is no rotation, or a negative one, is not well formed."""
    with pytest.raises(InvalidCertificateError, match=where):
        verify(replace(moving, lock=lock))
