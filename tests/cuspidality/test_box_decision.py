"""Cuspidal within limits, by pairs: against the second route, and under symmetries."""

from __future__ import annotations

import math
import random
from dataclasses import replace
from fractions import Fraction

import pytest
from flint import arb
from joint_boxes import Limits, arm_of, of_slide, within, within_by_values
from short_tables import arm, shift

from cuspaudit.cuspidality.pair_decision import decide_pairs
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.kinematics.tip_circles import tip_across
from cuspaudit.robot.chain import X_AXIS, Angle, Rotation

ISSAC = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
SKEW = arm((1, "7/5", "4/5"), ("1/10", "1/2", "1/5"), (60, 90, 0))


def random_limits(rng: random.Random) -> Limits:
    """Ranges of joints 2 and 3 in whole degrees, short, long, or none."""
    found: list[tuple[int, int] | None] = [None]
    for _ in range(2):
        low = rng.randint(-200, 100)
        none = rng.random() < 0.2
        found.append(None if none else (low, low + rng.randint(30, 400)))
    return found


@pytest.mark.parametrize(
    "seed", [0, 1, *(pytest.param(k, marks=pytest.mark.slow) for k in range(2, 8))]
)
def test_two_routes_agree(seed: int) -> None:
    """Pairs and sample values give one verdict and one number of aspects."""
    limits = random_limits(random.Random(seed))
    first, second = within(ISSAC, limits), within_by_values(ISSAC, limits)
    assert first.verdict is second.verdict is not Verdict.UNDECIDED
    assert first.aspects == second.aspects


def test_no_limits_are_no_box() -> None:
    """Without limits verdict and aspects are those of the arm."""
    free = decide_pairs(*reduced_map(exact_model(SKEW)))
    found = within(SKEW, (None, None, None))
    assert found.verdict is free.verdict
    assert (found.aspects.count, found.aspects.proved) == (free.aspects, True)


def test_a_larger_box_keeps_a_couple() -> None:
    """T1: along growing boxes the verdict goes from noncuspidal to cuspidal once."""
    verdicts = [within(ISSAC, (None, (-k, k), (-k, k))).verdict for k in (40, 90, 181)]
    cuspidal = [verdict is Verdict.CUSPIDAL for verdict in verdicts]
    assert cuspidal == sorted(cuspidal)
    assert cuspidal[0] is False
    assert cuspidal[-1] is True


def test_a_long_first_joint_changes_nothing() -> None:
    """T2: a range of joint 1 over a half turn never matters, a short one may."""
    box = ((-170, -30), (-40, 170))
    free = within(ISSAC, (None, *box))
    for ends in ((-91, 90), (0, 181), (-500, 500)):
        found = within(ISSAC, (ends, *box))
        assert found.verdict is free.verdict is Verdict.CUSPIDAL
        assert found.pairs == free.pairs
        assert found.aspects == free.aspects


def test_a_first_joint_that_hardly_moves_keeps_a_cusp() -> None:
    """A cusp in the box has couples as near to it as one likes: any range will do."""
    box = ((-170, -30), (-40, 170))
    for width in ("1/100", 30):
        assert within(ISSAC, ((0, width), *box)).verdict is Verdict.CUSPIDAL


@pytest.mark.slow
def test_moving_the_range_of_the_first_joint_changes_nothing() -> None:
    """Only the length of the range of joint 1 counts."""
    box = ((-170, -30), (-40, 170))
    found = [within(ISSAC, ((k, k + 90), *box)) for k in (-45, 0, 133)]
    assert len({(f.verdict, f.aspects, f.pairs) for f in found}) == 1


@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in (1, 2))]
)
def test_a_mirror_image_has_the_mirrored_limits(seed: int) -> None:
    """In the mirror every joint turns the other way, and every limit with it.

    The mirror (x, y, z) -> (x, -y, z) of A(theta, d, a, alpha) is A(-theta, d, a,
    -alpha).
    """
    limits = random_limits(random.Random(100 + seed))
    image = arm((1, 2, "3/2"), (0, 1, 0), (90, -90, 0))
    other = [None if ends is None else (-ends[1], -ends[0]) for ends in limits]
    first, second = within(ISSAC, limits), within(image, other)
    assert first.verdict is second.verdict
    assert first.aspects == second.aspects


@pytest.mark.slow
def test_scaled_arms_and_shifted_joints() -> None:
    """Lengths in another unit change nothing; whole turns move the box along."""
    limits = (None, (-27, 169), (-213, 30))
    scaled = arm((1000, 2000, 1500), (0, 1000, 0), (-90, 90, 0))
    turned = (None, (-27 + 360, 169 + 360), (-213 - 720, 30 - 720))
    first = within(ISSAC, limits)
    for chain, ends in ((scaled, limits), (ISSAC, turned)):
        found = within(chain, ends)
        assert (found.verdict, found.aspects) == (first.verdict, first.aspects)


def test_joints_turned_round_have_their_limits_turned() -> None:
    """With every axis reversed the joint values, and so the limits, change sign."""
    first = within(ISSAC, (None, (-170, -30), (-40, 170)))
    down = (Fraction(0), Fraction(0), Fraction(-1))
    joints = [replace(joint, axis=down) for joint in ISSAC.joints]
    found = within(ISSAC.with_joints(joints), (None, (30, 170), (-170, 40)))
    assert (found.verdict, found.aspects) == (first.verdict, first.aspects)


@pytest.mark.parametrize("kinds", [pytest.param("RRP", marks=pytest.mark.slow), "PRR"])
def test_slides_with_limits(kinds: str) -> None:
    """A slide is limited like an interval of the line, by both routes."""
    chain = arm((1, 2, "3/2"), (0, 1, 0), (-90, 60, 30), kinds)
    last = (-2, 1) if kinds == "RRP" else (-100, 100)
    first, second = (
        decide(chain, (None, (-150, 120), last))
        for decide in (within, within_by_values)
    )
    assert first.verdict is second.verdict is not Verdict.UNDECIDED
    assert first.aspects == second.aspects


@pytest.mark.slow
def test_a_short_first_slide_needs_no_more_than_its_length() -> None:
    """Growing ranges of a first slide go from noncuspidal to cuspidal once."""
    chain = arm((1, 2, "3/2"), (0, 1, 0), (-60, 90, 0), "PRR")
    free = within(chain, (None, None, None)).verdict
    verdicts = [
        within(chain, ((0, length), None, None)).verdict
        for length in ("1/100", 1, 3, 100)
    ]
    cuspidal = [verdict is Verdict.CUSPIDAL for verdict in verdicts]
    assert cuspidal == sorted(cuspidal)
    assert verdicts[-1] is free


def test_triangular_arms_have_box_aspects() -> None:
    """An arm that no limits can make cuspidal still counts its aspects."""
    found = within(arm_of("offset_puma"), ((-170, 170),) * 3)
    assert found.verdict is Verdict.NONCUSPIDAL
    assert (found.aspects.count, found.aspects.proved) == (6, True)


@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in (1, 2, 3))]
)
def test_a_second_joint_that_slides_has_pairs(seed: int) -> None:
    """Pairs and sample values agree, verdict and aspects, where joint 2 slides."""
    rng = random.Random(seed)
    chain = arm(("1/2", "1/5", 2), ("1/10", 0, "1/5"), (60, 45, 30), "RPR")
    slide = Fraction(rng.randint(-40, 0), 10)
    low = rng.randint(-180, 0)
    limits = (None, (slide, slide + 4), (low, low + rng.randint(90, 400)))
    first, second = of_slide(chain, limits), within_by_values(chain, limits)
    assert first.verdict is second.verdict is not Verdict.UNDECIDED
    assert first.aspects == second.aspects


def test_a_short_first_joint_before_a_slide_leaves_fewer_couples() -> None:
    """Each couple asks of joint 1 less than its range, and a cusp keeps some."""
    chain = arm(("1/2", "1/5", 2), ("1/10", 0, "1/5"), (60, 45, 30), "RPR")
    across = tip_across(exact_model(chain))
    width = 20
    found = of_slide(chain, ((0, width), (-4, 3), (-170, 170)))
    assert found.verdict is Verdict.CUSPIDAL
    most = math.cos(math.radians(width))
    for couple in found.couples:
        ends = []
        for end in couple.postures:
            values = {"q2": end.fiber_point(64)[0]}
            values |= found.surface.base.coordinates(arb(end.base[0]))
            ends.append([float(found.surface.ring.evaluate(p, values)) for p in across])
        (a, b), (c, d) = ends
        assert a * c + b * d > most * (a * a + b * b)


def test_base_and_tool_change_nothing_within_limits() -> None:
    """The arm stands elsewhere, its tip turned about the last axis's point: one box."""
    limits = (None, (-170, -30), (-40, 170))
    moved = ISSAC.with_joints(
        [
            replace(
                ISSAC.joints[0],
                before=(
                    shift(3, -2, 1),
                    Rotation(X_AXIS, Angle(Fraction(1, 3))),
                    *ISSAC.joints[0].before,
                ),
            ),
            *ISSAC.joints[1:],
        ]
    )
    turned = replace(ISSAC, tool=(*ISSAC.tool, Rotation(X_AXIS, Angle(Fraction(1, 7)))))
    first = within(ISSAC, limits)
    for chain in (moved, turned):
        found = within(chain, limits)
        assert (found.verdict, found.aspects) == (first.verdict, first.aspects)
        assert len(found.couples) == len(first.couples)
