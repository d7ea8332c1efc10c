from __future__ import annotations

import sys

import pytest
from flint import ctx, fmpq, fmpq_poly
from surfaces import arm_map, decided, plane

from cuspaudit.algebra.univariate import Univariate, real_roots
from cuspaudit.errors import PrecisionError
from cuspaudit.surface.sample_points import isolated_real_roots, sample_points

#: the module; its name in the package is the function's
MODULE = sys.modules[sample_points.__module__]
ARMS = [
    ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
    ((1, 2, 1), (0, 1, 0), (-30, 90, 0)),
    ((1, "3/2", 1), (0, 1, "1/2"), (45, -45, 0)),
]


@pytest.mark.parametrize("table", ARMS)
def test_postures_hold_the_value(table: tuple[tuple[int, ...], ...]) -> None:
    """R of every posture is the value, to 100 digits."""
    pair = arm_map(*table)
    decision = decided(pair)
    saved, ctx.prec = ctx.prec, 400
    for fiber in decision.samples[:12]:
        for posture in fiber.postures:
            at = posture.coordinates(400)
            for component, wanted in zip(pair[1].components, fiber.value, strict=True):
                error = pair[0].ring.evaluate(component, at) - wanted
                assert error.contains(0)
                assert error.rad() < 1e-30
    ctx.prec = saved


@pytest.mark.parametrize("table", ARMS)
def test_real_roots_are_counted_by_sign_changes(
    table: tuple[tuple[int, ...], ...],
) -> None:
    """As many postures as exact isolation over the norm counts."""
    for fiber in decided(arm_map(*table)).samples[:12]:
        assert len(fiber.postures) == len(real_roots(fiber.polynomial))


def test_parity() -> None:
    """A compact torus: over each value as many postures of either sign."""
    for table in ARMS:
        decision = decided(arm_map(*table))
        numerator, _ = decision.surface.chart(decision.delta)
        for fiber in decision.samples:
            assert sum(p.sign(numerator) for p in fiber.postures) == 0


def test_postures_narrow_with_the_bits() -> None:
    """More bits, narrower balls, over Q and over Q(sqrt m)."""
    for table in ARMS:
        decision = decided(arm_map(*table))
        posture = next(f for f in decision.samples if f.postures).postures[0]
        wide, narrow = posture.chart(128), posture.chart(512)
        assert all(b.rad() < 1e-60 for b in narrow)
        assert all(a.overlaps(b) for a, b in zip(wide, narrow, strict=True))
        assert posture.chart(128) is wide


def test_roots_over_a_quadratic_field() -> None:
    """(t^2 - 2)(t - sqrt 3 + 2) has its three real roots, refined."""
    # t^3 + (2 - sqrt 3) t^2 - 2 t - 2 (2 - sqrt 3)
    polynomial = Univariate(fmpq_poly([-4, -2, 2, 1]), fmpq_poly([2, 0, -1]), 3)
    before = ctx.prec
    ctx.prec = 300
    balls = isolated_real_roots(polynomial)
    ctx.prec = before
    wanted = [-(2**0.5), 3**0.5 - 2, 2**0.5]
    assert [float(ball.mid()) for ball in balls] == pytest.approx(wanted)
    assert all(ball.rad() < 1e-40 for ball in balls)


def test_a_double_root_over_the_field_is_not_isolated(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A value that is not regular ends in a PrecisionError, not in a wrong count."""
    monkeypatch.setattr(MODULE, "PRECISIONS", (64, 128))
    double = Univariate(fmpq_poly([3, 0, 1]), fmpq_poly([0, -2]), 3)
    with pytest.raises(PrecisionError, match="fiber polynomial"):
        isolated_real_roots(double)


def test_a_sign_that_is_zero_is_not_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """The sign of a function that vanishes at a posture is a PrecisionError."""
    monkeypatch.setattr(MODULE, "PRECISIONS", (64, 128))
    decision = decided(plane(lambda x, y: (x**2, y)))
    fiber = sample_points(decision.fibers, (fmpq(2), fmpq(1)))
    ring = decision.fibers.ring
    # chart coordinates y, x are x, y of the plane
    zero = ring.gen("y") ** 2 - 2 * ring.gen("x")
    with pytest.raises(PrecisionError, match="sign of Delta"):
        fiber.postures[0].sign(zero)
    assert [p.sign(ring.gen("y")) for p in fiber.postures] == [-1, 1]


def test_an_undetermined_second_coordinate_is_a_precision_error() -> None:
    """Where the linear equation vanishes the chart cannot be enclosed."""
    decision = decided(plane(lambda x, y: (x * (x * y - 1) + y, x * y)))
    fiber = sample_points(decision.fibers, (fmpq(3), fmpq(0)))
    failures = 0
    for posture in fiber.postures:
        try:
            posture.chart(128)
        except PrecisionError:
            failures += 1
    assert failures >= 1
    values = [f.value for f in decision.samples]
    assert all(v != 0 for _, v in values)
