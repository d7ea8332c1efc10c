"""Claims about every arm of a tolerance, and the arms themselves, in floats."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from certified_arms import crx, det, exact, issac, kinematics, sliding, translate, xarm6
from flint import arb
from structured_arms import some_structures

from cuspaudit.certificate import (
    Loose,
    PathCertificate,
    Rotate,
    Tolerance,
    certificate_from_text,
    read_certificate,
    text_from_certificate,
    verify,
)
from cuspaudit.certificate.balls import working_precision
from cuspaudit.certificate.loose.loose_arm import loose_arm
from cuspaudit.certificate.loose.loose_slopes import slopes_at
from cuspaudit.errors import InvalidCertificateError

ROOT = Path(__file__).parents[3]
X, Y, Z = ((Fraction(i == 0), Fraction(i == 1), Fraction(i == 2)) for i in range(3))


def with_play(
    arm: PathCertificate, lengths: str, angles: str | None = None
) -> PathCertificate:
    """The same claim for every arm of a tolerance."""
    radii = Fraction(lengths), Fraction(angles or lengths)
    return replace(arm, tolerance=Tolerance(*radii))


def built(arm: PathCertificate, rng: np.random.Generator) -> PathCertificate:
    """An arm at the edge of the tolerance, both axes of each link off, as numbers."""
    assert arm.tolerance is not None
    way, turn = float(arm.tolerance.lengths), float(arm.tolerance.angles)

    def off() -> list[translate | Rotate]:
        v, w = (x / np.linalg.norm(x) for x in rng.normal(size=(2, 3)))
        x, y, z = exact([round(float(n), 9) for n in w])
        angle = Fraction(repr(turn)) * (1 - Fraction(1, 10**8))
        moved = translate(*[repr(float(n) * way * (1 - 1e-8)) for n in v])
        return [moved, Rotate((x, y, z), radians=angle)]

    joints = [replace(j, before=(*off(), *j.before, *off())) for j in arm.joints]
    tool = (*off(), *arm.tool, *off())
    return replace(arm, joints=tuple(joints), tool=tool, tolerance=None)


def second_posture(arm: PathCertificate) -> np.ndarray:
    """Newton's method for the second posture of an arm, in floats."""
    first, q = (np.array([float(x) for x in row]) for row in arm.postures)
    target = kinematics(arm, first)[0]
    for _ in range(30):
        T, J = kinematics(arm, q)
        E = target[:3, :3] @ T[:3, :3].T
        turn = np.array([E[2, 1] - E[1, 2], E[0, 2] - E[2, 0], E[1, 0] - E[0, 1]]) / 2
        step = np.r_[target[:3, 3] - T[:3, 3], turn][: len(q)]
        q = q + np.linalg.solve(J[: len(q)], step)
    assert np.abs(step).max() < 1e-12
    return q


@pytest.mark.parametrize(
    ("make", "radius"),
    [(issac, "0.001"), (sliding, "0.0005"), (crx, "0.0003"), (xarm6, "0.00008")],
)
def test_arms_of_an_accepted_tolerance_have_the_couple(
    make: type[PathCertificate], radius: str
) -> None:
    """Random arms at its edge: a second posture in the box, and det J of one sign."""
    claim = with_play(make(), radius)
    found = verify(claim)
    assert found.accepted, found.reason
    assert f"for every arm within {radius} m and {radius} rad" in found.reason
    assert found.radius is not None
    assert found.smallest is not None
    rng = np.random.default_rng(0)
    for _ in range(25):
        arm = built(claim, rng)
        last = second_posture(arm)
        claimed = np.array([float(x) for x in arm.postures[1]])
        assert np.abs(last - claimed).max() < found.radius
        path = [[float(x) for x in row] for row in arm.path] + [list(last)]
        for a, b in pairwise(np.array(path)):
            for share in np.linspace(0, 1, 9):
                height = det(arm, a + share * (b - a)) * arm.sign
                assert height >= found.smallest


EVERY = sorted((ROOT / "certificates/accepted").glob("*-every-arm-path.json"))


@pytest.mark.parametrize("file", EVERY, ids=lambda file: file.name)
@pytest.mark.parametrize("arms", [3, pytest.param(40, marks=pytest.mark.slow)])
def test_arms_of_the_certified_boxes_have_the_couple(file: Path, arms: int) -> None:
    """Six known arms: all of so many at the edge of the box keep both postures."""
    claim = read_certificate(file)
    assert isinstance(claim, PathCertificate)
    rng = np.random.default_rng(arms)
    for _ in range(arms):
        arm = built(claim, rng)
        last = second_posture(arm)
        path = [[float(x) for x in row] for row in arm.path] + [list(last)]
        for a, b in pairwise(np.array(path)):
            for share in np.linspace(0, 1, 7):
                assert det(arm, a + share * (b - a)) * arm.sign > 0


@pytest.mark.parametrize("file", EVERY, ids=lambda file: file.name)
def test_the_certified_boxes_are_verified_in_seconds(file: Path) -> None:
    """By 1 mm and 1 mrad, or a tenth: proved; ten or a hundred times it: refused."""
    claim = read_certificate(file)
    assert claim.tolerance is not None
    radius = 1e-4 if file.name[:5] in ("piper", "lwa4p") else 1e-3
    assert float(claim.tolerance.lengths) == float(claim.tolerance.angles) == radius
    found = verify(claim)
    assert found.accepted, found.reason
    assert found.seconds < 5
    wide = Fraction(repr(radius * 30))
    assert not verify(replace(claim, tolerance=Tolerance(wide, wide))).accepted


def test_play_as_wide_as_the_couple_is_refused() -> None:
    """With more and more play a step of the proof fails, and stays refused."""
    answers = [verify(with_play(issac(), f"0.{'0' * k}1")) for k in (6, 4, 2, 1, 0)]
    assert [answer.accepted for answer in answers] == [True, True, True, False, False]
    assert all("every robot" in answer.reason for answer in answers[3:])
    assert not verify(with_play(crx(), "0", "0.01")).accepted
    assert not verify(with_play(crx(), "0.01", "0")).accepted


def test_a_claim_without_play_says_so() -> None:
    """It is about the numbers, and never about every arm."""
    reason = verify(issac()).reason
    assert reason.endswith("for these numbers")
    assert "every" not in reason


@pytest.mark.parametrize("make", [issac, crx])
def test_slopes_by_play_are_those_of_differences(make: type[PathCertificate]) -> None:
    """Each play, and each joint, moved by a little changes det J by its slope."""
    arm, size = make(), 1e-6
    q = [float(x) for x in arm.path[0]]
    with working_precision(64):
        loose = loose_arm(with_play(arm, "0.000000001"))
        slopes = slopes_at(loose, [arb(x) for x in q])
        steps = size * np.eye(len(q))
        for k, step in enumerate(steps):
            ends = [det(arm, np.array(q) + way * step) for way in (1, -1)]
            by_hand = (ends[0] - ends[1]) / (2 * size)
            assert float(slopes.by_joint[k]) == pytest.approx(by_hand, abs=1e-6)
        for place in slopes.places:
            v, w = slopes.in_own_frame(place)
            at_start = place.step == 0
            for i, axis in enumerate((X, Y, Z)):
                for slope, off in (
                    (v, translate(*(x * Fraction(repr(size)) for x in axis))),
                    (w, Rotate(axis, radians=Fraction(repr(size)))),
                ):
                    moved = inserted(arm, place.before, off, at_start)
                    by_hand = (det(moved, q) - det(arm, q)) / size
                    entry = slope[i]
                    value = 0.0 if entry is None else float(entry)
                    assert value == pytest.approx(by_hand, abs=1e-4)


def inserted(
    arm: PathCertificate, link: int, motion: translate | Rotate | Loose, at_start: bool
) -> PathCertificate:
    """The arm with one more motion at one end of a link."""
    links = [joint.before for joint in arm.joints] + [arm.tool]
    old = links[link]
    links[link] = (motion, *old) if at_start else (*old, motion)
    *before, tool = links
    joints = [
        replace(joint, before=each)
        for joint, each in zip(arm.joints, before, strict=True)
    ]
    return replace(arm, joints=tuple(joints), tool=tool)


def test_a_loose_number_is_all_its_values() -> None:
    """A turn that is not known to a hair is proved for all, and refused when wide."""
    arm, near = issac(), Fraction(1, 1000)
    for link, axis in ((1, X), (2, X), (2, Z)):
        for kind in ("turn", "slide"):
            claim = inserted(arm, link, Loose(kind, axis, near), at_start=False)
            found = verify(claim)
            assert found.accepted, found.reason
            assert found.reason.endswith("for every value of its loose number")
            assert certificate_from_text(text_from_certificate(claim)) == claim
            wide = inserted(arm, link, Loose(kind, axis, Fraction(2)), at_start=False)
            assert not verify(wide).accepted
    exactly = inserted(arm, 1, Loose("turn", X, Fraction(0)), at_start=True)
    assert verify(exactly).accepted


def test_one_loose_number_is_less_than_a_tolerance() -> None:
    """Where the tolerance of all axes is refused, one number may be as loose."""
    wide = "0.005"
    assert not verify(with_play(issac(), wide)).accepted
    one = inserted(issac(), 1, Loose("turn", X, Fraction(wide)), at_start=False)
    assert verify(one).accepted


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"within": "0.001"', '"within": "-0.001"'),
        ('"within": "0.001"', '"within": "0.001", "by": "1"'),
        ('"within": "0.001"', '"within": "nan"'),
        ('["1", "0", "0"], "within"', '["0", "0", "0"], "within"'),
        ('"schema": "cuspaudit/certificate/2"', '"schema": "cuspaudit/certificate/1"'),
    ],
)
def test_a_loose_number_that_is_none_is_refused(old: str, new: str) -> None:
    """Negative, not a number, about no axis, with another key, or in version 1."""
    loose = Loose("turn", X, Fraction(1, 1000))
    text = text_from_certificate(inserted(issac(), 1, loose, at_start=True))
    if "/1" in new:
        text = text.replace('"kind": "path",\n ', "")
    assert old in text
    with pytest.raises(InvalidCertificateError):
        certificate_from_text(text.replace(old, new))


def test_play_does_not_widen_what_limits_allow() -> None:
    """The box of all second postures has to be inside, not only the middle one."""
    claim = with_play(issac(), "0.001")
    radius = verify(claim).radius
    assert radius is not None
    size = len(claim.joints)
    last = claim.postures[1]
    for share, accepted in ((Fraction(1, 4), False), (Fraction(3), True)):
        room = Fraction(radius) * share
        limits = tuple(
            (min(x, y) - 9, y + room) if y > x else (y - room, x + 9)
            for x, y in zip(claim.postures[0], last, strict=True)
        )
        assert len(limits) == size
        assert verify(replace(claim, limits=limits)).accepted is accepted


def test_kinds_that_know_no_play_refuse_it() -> None:
    """A theorem about exact relations is not one about every arm near by."""
    structure = next(iter(some_structures().values()))
    wide = replace(structure, tolerance=Tolerance(Fraction(0), Fraction(0)))
    found = verify(wide)
    assert not found.accepted
    assert "more than one robot" in found.reason
