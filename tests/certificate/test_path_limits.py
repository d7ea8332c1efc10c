"""Paths within limits: by how little a claim may miss."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from certified_arms import with_second

from cuspaudit.certificate import PathCertificate, verify
from cuspaudit.certificate.model import Limits

TINY = Fraction(1, 10**9)
TURN = Fraction(6283185307179586, 10**15)


def around(certificate: PathCertificate, margin: Fraction) -> Limits:
    """The smallest box around the path, and a margin."""
    columns = list(zip(*certificate.path, strict=True))
    return tuple((min(c) - margin, max(c) + margin) for c in columns)


def test_a_path_inside_its_limits_is_accepted(arm6: PathCertificate) -> None:
    """With room of 1e-6 the claim within limits is proved, and says so."""
    result = verify(replace(arm6, limits=around(arm6, 1000 * TINY)))
    assert result.accepted
    assert result.reason.endswith("inside the joint limits, for these numbers")


def test_a_way_point_outside_by_a_nanoradian_is_refused(arm6: PathCertificate) -> None:
    """One number of one way point decides, exactly; ends are open."""
    limits = around(arm6, 1000 * TINY)
    for k in range(6):
        columns = [row[k] for row in arm6.path]
        for pair in (
            (min(columns) + TINY, max(columns) + 1),
            (min(columns), max(columns) + 1),
            (min(columns) - 1, max(columns) - TINY),
        ):
            narrow = (*limits[:k], pair, *limits[k + 1 :])
            result = verify(replace(arm6, limits=narrow))
            assert not result.accepted
            assert "is not inside the limits" in result.reason


def test_the_true_second_posture_must_be_inside(arm3: PathCertificate) -> None:
    """The way point is inside by less than the box of the true posture is wide."""
    margin = Fraction(1, 10**40)
    columns = list(zip(*arm3.path, strict=True))
    tight = tuple(
        (min(c) - 1, max(c) + 1)
        if c[-1] not in (min(c), max(c))
        else (
            (min(c) - margin, max(c) + 1)
            if c[-1] == min(c)
            else (min(c) - 1, max(c) + margin)
        )
        for c in columns
    )
    result = verify(replace(arm3, limits=tight))
    assert not result.accepted
    assert "the second posture is not proved to be inside" in result.reason


def test_another_winding_of_the_second_posture_is_outside(
    arm6: PathCertificate,
) -> None:
    """A turn further it is the same posture, and not inside the same limits."""
    limits = around(arm6, 1000 * TINY)
    second = list(arm6.postures[1])
    second[5] += TURN
    turned = with_second(arm6, tuple(second))
    assert not verify(replace(turned, limits=limits)).accepted
