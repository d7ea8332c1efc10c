from __future__ import annotations

from flint import arb, ctx

from cuspaudit.algebra.evaluation import Differentiable
from cuspaudit.algebra.ring import Ring
from cuspaudit.geometry.lifts.lifting import Chart, contains, lift, sharpen

RING = Ring(["c", "s"])
c, s = RING.gens
CIRCLE = Chart(Differentiable(RING, [c**2 + s**2 - 1]), Differentiable(RING, [c]))


def test_the_lift_of_an_interval_to_the_circle() -> None:
    """Over c in [-0.1, 0.1] near (0, 1): sqrt(1 - c^2), enclosed; below likewise."""
    for side in (1, -1):
        found = lift(CIRCLE, [arb(0), arb(side)], [arb(0, 0.1)])
        assert found is not None
        for at in (arb(-0.1), arb(0.03), arb(0.1)):
            point = (at, side * (1 - at * at).sqrt())
            assert contains(found.image, point)
        assert contains(found.box, found.image)


def test_no_lift_where_the_chart_folds() -> None:
    """Over an interval that reaches c = 1 there are two points, or none."""
    assert lift(CIRCLE, [arb(0.95), arb(0.31)], [arb(0.95, 0.06)]) is None
    assert lift(CIRCLE, [arb(1), arb(0)], [arb(1)]) is None
    assert lift(CIRCLE, [arb(2), arb(0)], [arb(2, 0.1)]) is None


def test_the_box_reaches_as_far_as_asked() -> None:
    """X holds the point it is asked to hold, unless that would be two points."""
    asked = [arb(0), arb(0.9)]
    found = lift(CIRCLE, [arb(0), arb(1)], [arb(0, 0.01)], asked)
    assert found is not None
    assert contains(found.box, asked)
    assert lift(CIRCLE, [arb(0), arb(1)], [arb(0)], [arb(0), arb(-1)]) is None


def test_sharpening_inside_a_lift() -> None:
    """The point over 3/5 inside the lift of [0.5, 0.7] is (3/5, 4/5)."""
    with ctx.workprec(106):
        found = lift(CIRCLE, [arb(0.6), arb(0.8)], [arb(0.6, 0.1)])
        assert found is not None
        sharp = sharpen(CIRCLE, found, [arb(3) / 5])
        assert sharp is not None
        assert abs(sharp[1] - arb(4) / 5) < 1e-25
        assert found.holds([arb(3) / 5], sharp)
        assert sharpen(CIRCLE, found, [arb(-3) / 5]) is None
