"""The circles of values over an angle, against the map itself."""

from __future__ import annotations

import pytest
from flint import arb, fmpq
from surfaces import arm_map, cylinder, torus

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.errors import UnableError
from cuspaudit.surface.value_waves import ValueWaves, value_waves

Map = tuple[PolynomialSystem, PolynomialMap]
MAPS: dict[str, Map] = {
    "orthogonal": arm_map((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
    "general": arm_map((1, 2, "3/2"), (0, 1, "1/3"), (90, "73.7398", 0)),
    "over Q(sqrt 3)": arm_map((1, 2, "3/2"), (0, 1, "1/3"), (30, 60, 0)),
    "with a slant": torus(lambda c, s, k, t: (k + 2 * c + s, t + 3 * s)),
    "a slanted line": torus(lambda c, s, k, t: (k + (2 + t) * c, k + (2 + t) * s)),
}


def waves_of(pair: Map) -> ValueWaves:
    """The circles of a map that is not triangular."""
    surface, delta = oriented(*pair)
    found = value_waves(surface, pair[1], delta)
    assert found is not None
    return found


def point(turn: str) -> tuple[arb, arb]:
    """Cosine and sine of so many half turns."""
    ball = arb(fmpq(*map(int, turn.split("/"))))
    return ball.cos_pi(), ball.sin_pi()


@pytest.mark.parametrize("name", MAPS)
def test_a_value_leads_back_to_its_point(name: str) -> None:
    """Q = K u has the squared length N, is half R(u) - R(-u), and leads back to u."""
    variety, mapping = MAPS[name]
    surface, waves = oriented(variety, mapping)[0], waves_of(MAPS[name])
    names = (*surface.fiber.names, *surface.base.names)
    c, s = point("3/7")

    def value(p: Polynomial, u: tuple[arb, ...]) -> arb:
        return variety.ring.evaluate(p, dict(zip(names, (*u, c, s), strict=True)))

    square = waves.squared_radius(c, s)
    for u in (point("-2/5"), point("4/5")):
        q = [value(row[0], u) * u[0] + value(row[1], u) * u[1] for row in waves.rows]
        q[1] *= waves.stretch
        assert (q[0] * q[0] + q[1] * q[1] - square).contains(0)
        assert all(map(arb.overlaps, waves.on_fiber(c, s, (q[0], q[1]), square), u))
        back = tuple(-x for x in u)
        halves = [(value(r, u) - value(r, back)) / 2 for r in mapping.components]
        # the rows are those of the map, up to order and to a slant that is taken off
        assert any((q[1] / waves.stretch - half).contains(0) for half in halves)


@pytest.mark.parametrize("name", MAPS)
def test_delta_has_the_sign_told(name: str) -> None:
    """Delta is a constant of this sign times g, at every point tried."""
    surface, delta = oriented(*MAPS[name])
    waves, ring = waves_of(MAPS[name]), surface.ring
    names = (*surface.fiber.names, *surface.base.names)
    ratios = []
    for base, fiber in (("1/7", "2/9"), ("5/3", "-1/4"), ("6/5", "7/8")):
        (c, s), u = point(base), point(fiber)
        at = dict(zip(names, (*u, c, s), strict=True))
        (k11, k12), (k21, k22) = (
            [ring.evaluate(p, at) for p in row] for row in waves.rows
        )
        (a, b), (x, y) = waves.first, waves.second
        _, y1, z1, y2, z2 = waves.radius
        q = k11 * u[0] + k12 * u[1], waves.stretch * (k21 * u[0] + k22 * u[1])
        slope = z1 * c - y1 * s + 2 * z2 * (1 - 2 * s * s) - 2 * y2 * (2 * s * c)
        g = q[0] * (b * c - a * s) + q[1] * (y * c - x * s) + slope / 2
        ratios.append(ring.evaluate(delta, at) / g)
        assert ratios[-1] * waves.sign > 0
    assert all(ratio.overlaps(ratios[0]) for ratio in ratios)


def test_whether_the_centers_keep_to_a_line() -> None:
    """Square axes 1 and 2 have it so; a slanted line is turned into the first axis."""
    lines = {name: waves_of(pair).is_line for name, pair in MAPS.items()}
    assert lines["orthogonal"]
    assert not lines["over Q(sqrt 3)"]
    for name, pair in MAPS.items():
        first, second = waves_of(pair).aligned()
        assert lines[name] == (second == (arb(0), arb(0)))
        assert any(abs(x) > 0 for x in first)


def test_axes_that_meet_need_no_circles() -> None:
    """A triangular map has none."""
    pair = arm_map((0, 2, 1), (0, 0, "1/2"), (90, 90, 0))
    surface, delta = oriented(*pair)
    assert value_waves(surface, pair[1], delta) is None


@pytest.mark.parametrize(
    ("pair", "why"),
    [
        (cylinder(lambda c, s, q: (q**2 + (q + 1) * c, (q + 1) * s)), "a line"),
        (torus(lambda c, s, k, t: (k * t + 3 * c, t + 3 * s)), "high degree"),
    ],
)
def test_other_maps_are_refused_for_tiles(pair: Map, why: str) -> None:
    """A line as factor, or centers on a curve of higher degree."""
    with pytest.raises(UnableError, match=why):
        waves_of(pair)
