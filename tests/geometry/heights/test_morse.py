from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from flint import arb, ctx, fmpq

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.geometry.heights.ascent import climb
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.geometry.heights.height import plain_height
from cuspaudit.geometry.heights.morse import (
    basin,
    critical_point,
    exits,
    inertia,
    middle,
)
from cuspaudit.geometry.heights.proved_ascent import prove_ascent
from cuspaudit.geometry.heights.proved_path import prove_path
from cuspaudit.geometry.heights.segment import segment

RING = Ring(["x", "y", "z"])
x, y, z = RING.gens
SPHERE = PolynomialSystem(RING, (x**2 + y**2 + z**2 - 1,))
# positive on the sphere, with maxima at +-x, minima at +-z, saddles at +-y
HILLS = ChartedHeight(SPHERE, 2, plain_height(RING, [3 * x**2 + 2 * y**2 + z**2]))


def ball(*coordinates: float) -> tuple[arb, ...]:
    """A tiny box."""
    return tuple(arb(v, 1e-25) for v in coordinates)


@pytest.fixture(autouse=True)
def _precision() -> object:
    with ctx.workprec(106):
        yield


def test_inertia_is_that_of_the_eigenvalues() -> None:
    """Signs are proved for regular matrices of any scale, never for singular ones."""
    chance = np.random.default_rng(1)
    for _ in range(20):
        values = chance.choice([-1, 1], 4) * 10.0 ** chance.integers(-6, 6, 4)
        Q = np.linalg.qr(chance.normal(size=(4, 4)))[0]
        H = Q @ np.diag(values) @ Q.T
        H = (H + H.T) / 2
        exact = np.array([[arb(float(e)) for e in row] for row in H], dtype=object)
        assert inertia(exact) in {(np.linalg.eigvalsh(H) > 0).sum(), None}
    assert inertia(np.array([[arb(1), arb(1)], [arb(1), arb(1)]], dtype=object)) is None
    wide = np.array([[arb(1, 2), arb(0)], [arb(0), arb(1)]], dtype=object)
    assert inertia(wide) is None
    assert inertia(np.array([[arb(-2), arb(1)], [arb(1), arb(3)]], dtype=object)) == 1


def test_indices_on_the_sphere() -> None:
    """Maxima, saddles and minima of a quadratic form, two of each."""
    for place, rising in (((1, 0, 0), 0), ((0, 1, 0), 1), ((0, 0, -1), 2)):
        point = critical_point(HILLS, ball(*place))
        assert point is not None
        assert point.rising == rising
        assert point.sign == 1


def test_slopes_in_a_chart_are_those_of_differences() -> None:
    """Gradient and Hessian along V by moving on V."""
    at = np.array([0.6, 0.48, 0.64])
    tangent, step = HILLS.tangent(at), 1e-4
    gradient, hessian = HILLS.slopes(tangent, at)

    def value(t: np.ndarray) -> float:
        moved = HILLS.retract(tangent, at + t @ tangent.forms.matrix)
        assert moved is not None
        return HILLS.value_at(moved)

    e = np.eye(2) * step
    first = [(value(v) - value(-v)) / (2 * step) for v in e]
    assert gradient == pytest.approx(first, abs=1e-6)
    second = [
        [
            (value(a + b) - value(a - b) - value(b - a) + value(-a - b)) / (4 * step**2)
            for a in e
        ]
        for b in e
    ]
    assert hessian == pytest.approx(np.array(second), abs=1e-4)
    enclosed = HILLS.enclosed_slopes(tangent, [arb(float(v)) for v in at])
    assert enclosed is not None
    assert enclosed[0].astype(float) == pytest.approx(gradient)
    assert enclosed[1].astype(float) == pytest.approx(hessian)


def test_a_basin_holds_its_maximum_and_not_the_other() -> None:
    """The basin of (1, 0, 0), a good part of the sphere."""
    top = critical_point(HILLS, ball(1, 0, 0))
    assert top is not None
    found = basin(HILLS, top)
    assert found is not None
    assert found.holds(ball(1, 0, 0))
    near = fmpq(1, 50)
    t = 1 / (1 + near * near)
    assert found.holds([arb((1 - near**2) * t), arb(2 * near * t), arb(0)])
    assert not found.holds(ball(-1, 0, 0))
    assert not found.holds(ball(0, 1, 0))


def test_the_exits_of_a_saddle_lead_to_both_maxima() -> None:
    """From (0, 1, 0) to (1, 0, 0) and (-1, 0, 0), always above the saddle."""
    saddle = critical_point(HILLS, ball(0, 1, 0))
    tops = [critical_point(HILLS, ball(sign, 0, 0)) for sign in (1, -1)]
    found = [basin(HILLS, top) for top in tops if top]
    basins = [near for near in found if near is not None]
    assert saddle is not None and len(basins) == 2
    pair = exits(HILLS, saddle)
    assert pair is not None
    reached = set()
    for exit_ in pair:
        way = prove_ascent(HILLS, exit_.end, saddle.level, basins, seed=1)
        assert way is not None
        reached.add(way.top)
        for step in way.steps:
            height = HILLS.height.value(step.image)
            assert height is not None
            assert not height < saddle.level
        assert np.abs(way.places[-1]) == pytest.approx([1, 0, 0], abs=1e-9)
    assert reached == {0, 1}


def test_an_ascent_below_its_level_is_refused() -> None:
    """From a point at 1.463 no way is proved to stay above the level 1.47."""
    top = critical_point(HILLS, ball(1, 0, 0))
    assert top is not None
    found = basin(HILLS, top)
    assert found is not None
    start = [arb(0.28), arb(0.96), arb(0)]
    assert prove_ascent(HILLS, tuple(start), arb(1.47), [found], 1) is None


def test_a_climb_goes_up_and_ends_at_a_maximum() -> None:
    """Each way point is higher than the last, from a saddle too."""
    for start in ([0.0, 0.6, 0.8], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]):
        places, at_top = climb(HILLS, np.array(start), 0.5, np.random.default_rng(2))
        assert at_top
        assert np.abs(places[-1]) == pytest.approx([1, 0, 0], abs=1e-6)
        levels = [HILLS.value_at(p) for p in places]
        assert all(a < b for a, b in pairwise(levels))
        assert (places**2).sum(axis=1) == pytest.approx(1)


def test_a_segment_bounds_the_height_along_it() -> None:
    """G on an arc of the sphere: value, slope and bend at t = 0 and between."""
    at = np.array([0.6, 0.48, 0.64])
    tangent = HILLS.tangent(at)
    begin = HILLS.retract(tangent, at)
    assert begin is not None
    v = np.array([0.01, 0.02])
    over = [arb(float(b), 0.03) for b in begin]
    found = segment(
        HILLS, tangent, [arb(float(b)) for b in begin], over, [arb(float(e)) for e in v]
    )
    assert found is not None
    for t in (0.25, 0.5, 1.0):
        moved = HILLS.retract(tangent, begin + t * v @ tangent.forms.matrix)
        assert moved is not None
        value = found.value + t * found.slope + t * t / 2 * found.bend
        assert abs(value - HILLS.value_at(moved)).lower() < 1e-12
    assert found.is_above(found.value - 1)
    assert not found.is_above(found.value + 1)


def test_a_segment_across_a_zero_is_refused() -> None:
    """P = y is 0 half way from (3/5, -4/5) to (3/5, 4/5)."""
    plane = Ring(["x", "y"])
    flat = ChartedHeight(
        PolynomialSystem(plane), 2, plain_height(plane, [plane.gens[1]])
    )
    tangent = flat.tangent(np.array([0.6, -0.8]))
    change = tangent.forms.values([arb(0), arb(1.6)])
    over = [arb(0.6), arb(0, 0.81)]
    assert segment(flat, tangent, [arb(0.6), arb(-0.8)], over, change) is None


def test_proved_paths_between_points() -> None:
    """Round the equator past y = 0 where x != 0; not across x = 0."""
    angles = np.linspace(-1, 1, 9)
    places = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    a, b = (
        tuple(arb(v) for v in (arb(t).cos(), arb(t).sin(), arb(0))) for t in (-1, 1)
    )
    boxes = prove_path(SPHERE, 2, [x], a, places, b)
    assert boxes is not None
    assert all(box[0] > 0 for box in boxes)
    assert np.abs(middle(boxes[-1]) - places[-1]).max() < 0.5
    assert prove_path(SPHERE, 2, [y], a, places, b) is None
    assert prove_path(SPHERE, 2, [x], a, places, tuple(-v for v in b)) is None
