"""Ends of joint ranges as rational points of charts."""

from __future__ import annotations

import math

import pytest
from flint import arb, ctx, fmpq

from cuspaudit.errors import RetryableError
from cuspaudit.surface.box_edges import Limit, edge_of, quadratic_tangent
from cuspaudit.surface.surface import ROTATIONS, Factor

CIRCLES = [Factor("circle", ("c", "s"), rotation) for rotation in ROTATIONS]
LINE = Factor("line", ("q",))
HAIR = arb("1e-10")


@pytest.mark.parametrize("circle", CIRCLES, ids=str)
@pytest.mark.parametrize("degrees", [-700, -213, -91, 0, 45, 100, 359, 1000])
def test_edges_lie_on_the_safe_side(circle: Factor, degrees: int) -> None:
    """Up, an edge is at or above its limit by a hair; down, below."""
    limit = Limit(fmpq(degrees, 180), fmpq(1, 1000))
    ctx.prec = 128
    above, below = (edge_of(limit, circle, up).ball(128) for up in (True, False))
    assert below < limit.ball(128) < above
    assert above - below < HAIR


def test_right_angles_are_exact() -> None:
    """A multiple of a right angle is its own edge, both ways, where a chart has it."""
    for turns in range(-5, 6):
        limit = Limit(fmpq(turns, 2), fmpq(0))
        found = 0
        for circle in CIRCLES:
            try:
                up, down = (edge_of(limit, circle, side) for side in (True, False))
            except RetryableError:
                continue
            found += 1
            assert up == down
            assert up.ball(128).overlaps(limit.ball(128))
            assert up.point == ((1, 0), (0, 1), (-1, 0), (0, -1))[turns % 4]
        assert found >= len(CIRCLES) - 1


def test_a_ball_is_left_behind() -> None:
    """A limit known in a ball is rounded from the far end of the ball."""
    limit = Limit(fmpq(1, 3), fmpq(0), fmpq(1, 10**6))
    above, below = (edge_of(limit, CIRCLES[0], up).ball(128) for up in (True, False))
    exact = Limit(fmpq(1, 3), fmpq(0)).ball(128)
    assert above - exact >= arb("1e-6")
    assert exact - below >= arb("1e-6")


def test_slides_are_exact() -> None:
    """A limit of a slide is a rational number already."""
    limit = Limit(fmpq(0), fmpq(7, 3))
    assert edge_of(limit, LINE, True) == edge_of(limit, LINE, False)
    assert edge_of(limit, LINE, True).t == fmpq(7, 3)


@pytest.mark.parametrize("parts", [4, 6])
@pytest.mark.parametrize("rotation", [ROTATIONS[0], ROTATIONS[2]])
def test_multiples_of_45_and_30_degrees_are_quadratic(
    parts: int, rotation: tuple[fmpq, fmpq]
) -> None:
    """The chart coordinate is that of the angle, or none where it is rational."""
    factor = Factor("circle", ("c", "s"), rotation)
    start = math.atan2(*(float(int(v.p) / int(v.q)) for v in rotation[::-1]))
    seen = 0
    for k in range(-2 * parts, 2 * parts):
        found = quadratic_tangent(Limit(fmpq(k, parts), fmpq(0)), factor)
        if found is None:
            assert 2 * k % parts == 0
            continue
        a, b, m = found
        value = int(a.p) / int(a.q) + int(b.p) / int(b.q) * math.sqrt(m)
        assert value == pytest.approx(math.tan((math.pi * k / parts - start) / 2))
        seen += 1
    assert seen >= 2 * parts


def test_other_limits_have_no_quadratic_coordinate() -> None:
    """Neither one in rad, nor one known in a ball only, nor a slide."""
    factor = Factor("circle", ("c", "s"))
    for limit in (
        Limit(fmpq(1, 5), fmpq(0)),
        Limit(fmpq(1, 4), fmpq(1, 10)),
        Limit(fmpq(1, 4), fmpq(0), fmpq(1, 10**9)),
    ):
        assert quadratic_tangent(limit, factor) is None
    assert quadratic_tangent(Limit(fmpq(0), fmpq(1)), Factor("line", ("q",))) is None
