from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from certified_arms import ARMS, det, divided, with_offset
from flint import ctx

from cuspaudit.certificate import PathCertificate, cover
from cuspaudit.certificate.cover import Cover, Refusal


def along(arm: PathCertificate, *points: Sequence[Any]) -> Cover:
    """The cover of another path of the arm."""
    path = tuple(tuple(map(Fraction, point)) for point in points)
    return Cover(replace(arm, path=path))


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("pieces", [1, 7])
def test_the_bound_is_below_the_minimum_and_near_it(
    name: str, pieces: int, certified: dict[str, PathCertificate]
) -> None:
    """The bound is at most the least |det J| of many samples, and a quarter of it."""
    arm = certified[name]
    a, b = (np.array([float(x) for x in row]) for row in arm.postures)
    least = min(arm.sign * det(arm, a + s * (b - a)) for s in np.linspace(0, 1, 301))
    bound = float(Cover(divided(arm, pieces)).cover())
    assert least / 4.1 < bound <= least * (1 + 1e-9)


def test_a_long_way_is_cut_where_det_is_small(arm6: PathCertificate) -> None:
    """The boxes adapt: one segment of some radians takes no more than thirty."""
    whole = Cover(arm6)
    whole.cover()
    assert 1 < whole.boxes < 30
    assert whole.bits == 128


def test_what_taylor_s_polynomial_does_not_see_is_in_the_remainder(
    arm3: PathCertificate, monkeypatch: pytest.MonkeyPatch
) -> None:
    """1 - 100 q^6 is flat at 0, where its polynomial is 1, and negative at 1."""
    monkeypatch.setattr(
        cover, "jacobian_determinant", lambda arm, q: 1 - 100 * q[0] ** 6
    )
    with pytest.raises(Refusal, match="opposite sign"):
        along(arm3, (-1, 0, 0), (1, 0, 0)).cover()
    fine = along(arm3, ("-0.3", 0, 0), ("0.3", 0, 0))
    assert 0.2 < float(fine.cover()) < 1 - 100 * 0.3**6


def test_a_path_may_rest(arm3: PathCertificate) -> None:
    """A segment of length zero is a box like any other."""
    first = arm3.postures[0]
    rest = along(arm3, first, first)
    assert float(rest.cover()) == pytest.approx(det(arm3, first), rel=1e-9)
    assert rest.boxes == 1


@pytest.mark.parametrize(
    ("start", "end"),
    [
        ("-0.1", "0.1"),
        ("-0.1", "0.2"),
        ("-0.1", "0.3"),
        ("-0.3", "0.17"),
        ("-0.1", "0"),
    ],
)
def test_a_path_that_touches_the_singularity_is_refused(start: str, end: str) -> None:
    """Det J >= 0 on the whole line and 0 at one point of it is not det J > 0.

    The point is the middle of the segment, a dyadic point, no dyadic point, an end.
    """
    arm, (a, b) = with_offset(), (Fraction(start), Fraction(end))
    touching = along(arm, (0, a, -a), (0, b, -b))
    with pytest.raises(Refusal, match="segment 1 of 1"):
        touching.cover()
    assert touching.boxes < 2000


def test_beside_the_point_of_contact_the_path_is_proved() -> None:
    """The line moved aside by 1e-7 misses the singularity, and this is proved."""
    arm, aside = with_offset(), Fraction(1, 10**7)
    a, b = Fraction("-0.1"), Fraction("0.3")
    clear = along(arm, (0, a + aside, -a), (0, b + aside, -b))
    assert 0 < float(clear.cover()) < 1e-6
    into = along(arm, (0, a - aside, -a), (0, b - aside, -b))
    with pytest.raises(Refusal, match="opposite sign"):
        into.cover()


def test_the_precision_is_raised_where_it_must_be() -> None:
    """Det J of about 1e-49 among terms of size 1 is told from 0 with more bits."""
    arm, t = with_offset(), Fraction(1, 10**25)
    before = ctx.prec, ctx.cap
    close = along(arm, (0, t, -t), (0, t, -t))
    assert 1e-50 < float(close.cover()) < 1e-48
    assert close.bits == 256
    assert (ctx.prec, ctx.cap) == before


def test_what_is_exactly_zero_is_never_told_from_zero() -> None:
    """At a singular posture every precision is tried, and the posture refused."""
    arm = with_offset()
    zero = along(arm, (0, 0, 0), (0, 0, 0))
    with pytest.raises(Refusal, match="not decided with 1024 bits"):
        zero.cover()


def test_an_arm_that_is_singular_everywhere_is_refused(arm3: PathCertificate) -> None:
    """Three joints on one axis: det J vanishes for want of any term."""
    joints = tuple(replace(joint, before=()) for joint in arm3.joints)
    with pytest.raises(Refusal, match="not decided"):
        Cover(replace(arm3, joints=joints, tool=())).cover()


def test_work_is_bounded(
    arm6: PathCertificate, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Too many boxes, or too many halvings, is a refusal and no endless search."""
    monkeypatch.setattr(cover, "MAX_BOXES", 3)
    with pytest.raises(Refusal, match="not proved with 3 boxes"):
        Cover(arm6).cover()
    monkeypatch.setattr(cover, "MAX_BOXES", 1000)
    monkeypatch.setattr(cover, "MAX_DEPTH", 1)
    with pytest.raises(Refusal, match="could not prove"):
        Cover(arm6).cover()
