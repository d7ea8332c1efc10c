"""The interval arithmetic of the second checker against balls of a thousand bits."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import Any

import pytest
from certified_arms import crx, issac, raghavan_roth, sliding
from flint import arb, ctx, fmpq
from second_checker import evaluated, needs_node
from structured_arms import palletizer, scara, some_structures

from cuspaudit.certificate import text_from_certificate
from cuspaudit.certificate.arm import arm_from_certificate
from cuspaudit.certificate.determinant import jacobian_determinant

pytestmark = needs_node

COUNT = 2000


@pytest.fixture(autouse=True)
def _many_bits() -> Any:
    saved, ctx.prec = ctx.prec, 1000
    yield
    ctx.prec = saved


def exactly(x: float) -> arb:
    """The number that a float is."""
    a, b = x.as_integer_ratio()
    return arb(fmpq(a, b))


def contains(ends: list[float], value: arb) -> bool:
    """Whether the whole ball of a true value lies between the ends."""
    low, high = ends
    above = low == -math.inf or not value < exactly(low)
    below = high == math.inf or not value > exactly(high)
    return above and below


def floats(rng: random.Random) -> float:
    """A float of any size: ordinary, tiny, huge, whole, or next to another."""
    kind = rng.randrange(6)
    if kind == 0:
        return rng.uniform(-4, 4)
    if kind == 1:
        return rng.choice([-1, 1]) * 2.0 ** rng.randint(-1074, -1000)
    if kind == 2:
        return rng.choice([-1, 1]) * rng.random() * 10.0 ** rng.randint(-150, 150)
    if kind == 3:
        return float(rng.randint(-3, 3))
    return math.nextafter(rng.choice([1.0, -1.0, 0.5, 2.0]), rng.choice([-9, 9]))


def intervals(rng: random.Random) -> list[float]:
    """A point, a narrow interval or a wide one."""
    a = floats(rng)
    b = rng.choice([a, math.nextafter(a, math.inf), floats(rng)])
    return [min(a, b), max(a, b)]


def members(ends: list[float], rng: random.Random) -> list[float]:
    """Both ends and something between."""
    low, high = ends
    between = min(max(low + rng.random() * (high - low), low), high)
    return [low, high, between]


def test_sums_products_and_quotients_are_enclosed() -> None:
    """Whatever members are taken, their exact result is between the ends."""
    rng = random.Random(1)
    calls = [
        (name, intervals(rng), intervals(rng))
        for name in ("sum", "difference", "product", "quotient")
        for _ in range(COUNT)
    ]
    for (name, a, b), ends in zip(calls, evaluated(calls), strict=True):
        if ends[0] is None or ends[1] is None:
            continue  # infinite, or no number: proves nothing
        assert ends[0] <= ends[1]
        for x in members(a, rng):
            for y in members(b, rng):
                p, q = exactly(x), exactly(y)
                if name == "quotient" and y == 0:
                    pytest.fail("a quotient by 0 has finite ends")
                value = {
                    "sum": lambda p=p, q=q: p + q,
                    "difference": lambda p=p, q=q: p - q,
                    "product": lambda p=p, q=q: p * q,
                    "quotient": lambda p=p, q=q: p / q,
                }[name]()
                assert contains(ends, value), (name, a, b, ends)


def test_results_are_narrow() -> None:
    """Of two points of ordinary size the ends are ten units in the last place apart."""
    rng = random.Random(2)
    calls = [
        (name, [x, x], [y, y])
        for name in ("sum", "product", "quotient")
        for x, y in ((rng.uniform(0.5, 4), rng.uniform(0.5, 4)) for _ in range(200))
    ]
    for ends in evaluated(calls):
        assert ends[1] - ends[0] <= 10 * math.ulp(ends[1])


def test_sines_and_cosines_are_enclosed() -> None:
    """Of narrow and wide intervals, near 0 and far from it, at members of each."""
    rng = random.Random(3)
    arguments = [
        *([x, x] for x in (0.0, 1e-300, math.pi, math.pi / 2, 1.5, -7.0, 1e5, 1e9)),
        *([x, x + 2.0 ** -rng.randint(0, 52)] for x in _angles(rng, COUNT)),
        *([x, x + rng.random() * 8] for x in _angles(rng, 300)),
    ]
    calls = [("sineAndCosine", ends) for ends in arguments]
    for (low, high), (sine, cosine) in zip(arguments, evaluated(calls), strict=True):
        for x in members([low, high], rng):
            s, c = exactly(x).sin_cos()
            assert contains(sine, s), (low, high, sine)
            assert contains(cosine, c), (low, high, cosine)
        if high - low < 1e-9 and abs(low) < 40:
            assert sine[1] - sine[0] < 2 * (high - low) + 1e-13


def _angles(rng: random.Random, count: int) -> list[float]:
    return [rng.uniform(-20, 20) for _ in range(count)]


def test_fixed_angles_are_enclosed_and_right_angles_exact() -> None:
    """The sine of p pi / q + r, for the angles of robots and for odd ones."""
    rng = random.Random(4)
    angles = [
        (f"{rng.randint(-99, 99)}/{rng.randint(1, 12)}", str(rng.randint(-3, 3) / 10))
        for _ in range(300)
    ]
    angles += [(f"{k}/2", "0") for k in range(-9, 9)]
    calls = [("sineAndCosineOf", *angle) for angle in angles]
    for (t, r), (sine, cosine) in zip(angles, evaluated(calls), strict=True):
        turns, radians = Fraction(t), Fraction(r)
        angle = arb.pi() * _ball(turns) + _ball(radians)
        assert contains(sine, angle.sin()) or _is_exact(sine, angle.sin())
        assert contains(cosine, angle.cos()) or _is_exact(cosine, angle.cos())
        if not radians and (2 * turns).denominator == 1:
            assert sorted(abs(x) for x in (*sine, *cosine)) == [0, 0, 1, 1]


def _whole(rng: random.Random) -> int:
    return rng.randint(-(10**30), 10**30)


def _ball(x: Fraction) -> arb:
    return arb(fmpq(x.numerator, x.denominator))


def _is_exact(ends: list[float], value: arb) -> bool:
    """Whether the ends are one integer, which the ball of the true value holds."""
    return ends[0] == ends[1] and value.contains(int(ends[0]))


def test_rational_numbers_pi_and_roots_are_enclosed() -> None:
    """The ends are neighbours in floating point, or the number itself."""
    rng = random.Random(5)
    texts = [
        *(f"{_whole(rng)}/{rng.randint(1, 10**25)}" for _ in range(300)),
        *(str(rng.uniform(-9, 9)) for _ in range(100)),
        *("0", "1", "-1", "0.5", "1/3", f"{2**53 + 1}", f"1/{2**53 + 1}"),
    ]
    for text, ends in zip(
        texts, evaluated([("enclosed", t) for t in texts]), strict=True
    ):
        x = Fraction(text)
        assert Fraction(ends[0]) <= x <= Fraction(ends[1])
        assert ends[1] in (ends[0], math.nextafter(ends[0], math.inf))
        assert (ends[0] == ends[1]) == (Fraction(float(x)) == x)
    squares = [[x, x + rng.choice([0, 1])] for x in (rng.random() for _ in range(300))]
    squares += [[-1.0, 4.0], [0.0, 2.0], [1e-300, 1e300], [4.0, 4.0]]
    roots = evaluated([("rootOf", ends) for ends in squares])
    for (least, most), (low, high) in zip(squares, roots, strict=True):
        assert 0 <= Fraction(low) ** 2 <= max(0, Fraction(least))
        assert Fraction(high) ** 2 >= Fraction(most)
        assert high - math.sqrt(most) <= 4 * math.ulp(high)
    [[ends, low, high]] = evaluated([("pi",)])
    assert contains(ends, arb.pi())
    assert _ball(Fraction(low)) < arb.pi() < _ball(Fraction(high))
    assert Fraction(high) - Fraction(low) < Fraction(1, 10**40)


ARMS = {
    "issac": issac(),
    "sliding": sliding(),
    "crx": crx(),
    "raghavan_roth": raghavan_roth(),
    **{c.theorem: c for c in some_structures().values()},
}


@pytest.mark.parametrize("name", ARMS)
def test_det_is_that_of_the_first_checker(name: str) -> None:
    """Both enclose one number, at postures and with derivatives along a line."""
    arm, rng = ARMS[name], random.Random(6)
    count = len(arm.joints)
    lines = [
        [(rng.uniform(-3, 3), rng.uniform(-1, 1)) for _ in range(count)]
        for _ in range(5)
    ]
    text = text_from_certificate(arm)
    calls = [
        ("determinant", text, [[[a, a], [b, b]] for a, b in line], 5) for line in lines
    ]
    exact = arm_from_certificate(arm, arb)
    for line, jet in zip(lines, evaluated(calls), strict=True):
        step = arb("1e-60")
        values = [
            jacobian_determinant(
                exact, [exactly(a) + k * step * exactly(b) for a, b in line]
            )
            for k in range(-2, 3)
        ]
        m2, m1, p0, p1, p2 = (arb(0) if v is None else v for v in values)
        slope = (8 * (p1 - m1) - (p2 - m2)) / (12 * step)
        bend = (16 * (p1 + m1) - 30 * p0 - p2 - m2) / (24 * step * step)
        for ends, value in zip(jet, (p0, slope, bend), strict=False):
            wide = value + arb(0, "1e-40")
            assert contains(ends, wide)
            assert ends[1] - ends[0] < 1e-11


def test_the_arms_have_four_joints_too() -> None:
    """The task of position and angle is among those compared."""
    sizes = {len(arm.joints) for arm in ARMS.values()}
    assert sizes == {3, 4, 6}
    assert len(scara()[0]) == len(palletizer()[0]) == 4
