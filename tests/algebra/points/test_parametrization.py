from __future__ import annotations

from dataclasses import replace

import pytest
from flint import arb, fmpq, fmpq_poly

from cuspaudit.algebra.points.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
    empty_set,
)
from cuspaudit.algebra.ring import Ring
from cuspaudit.errors import InvalidSystemError

RING = Ring(["x", "y"])
X, Y = RING.gens
T = fmpq_poly([0, 1])


def square_roots() -> ZeroDimensionalParametrization:
    """The two points (x, y) = (±√2, ±√2 + 1), with x for the form."""
    omega, slope = T**2 - 2, 2 * T
    rho = (2 * fmpq_poly([2]), slope + 4)
    return ZeroDimensionalParametrization(
        RING.variables, omega, rho, (fmpq(1), fmpq(0)), ("by hand",)
    )


@pytest.mark.parametrize(
    "change",
    [
        {"omega": 2 * T**2 - 4},
        {"omega": (T**2 - 2) ** 2},
        {"omega": T**2 - 3},
        {"omega": fmpq_poly([0])},
        {"rho": (fmpq_poly([4]), T**2)},
        {"rho": (fmpq_poly([5]), fmpq_poly([4, 2]))},
        {"rho": (fmpq_poly([4]),)},
        {"form": (fmpq(0), fmpq(1))},
        {"form": (fmpq(1),)},
    ],
)
def test_the_definition_is_checked(change: dict[str, object]) -> None:
    """Data that break one condition of the definition are refused."""
    with pytest.raises(InvalidSystemError, match="zero-dimensional parametrization"):
        replace(square_roots(), **change)


def test_the_balls_are_as_small_as_asked() -> None:
    """The coordinates ±√2 and ±√2 + 1 lie in balls of radius at most 2^-200."""
    low, high = (point.ball(200) for point in square_roots().real_points())
    for ball, sign in ((low, -1), (high, 1)):
        assert all(side.rad() <= arb(2) ** -200 for side in ball.values())
        assert abs(float(ball["x"].mid()) - sign * 2**0.5) < 1e-15
        assert (ball["x"] + 1).overlaps(ball["y"])


def test_zero_is_recognised() -> None:
    """x^2 - 2 and y - x - 1 are 0 at both points, x^2 - 2 + 10^-60 is positive."""
    for point, sign in zip(square_roots().real_points(), (-1, 1), strict=True):
        assert point.sign(X**2 - 2, RING) == 0 == point.sign(Y - X - 1, RING)
        assert point.sign(X**2 - 2 + fmpq(1, 10**60), RING) == 1
        assert point.sign(X**3, RING) == sign == point.sign(X, RING)
        assert point.sign(RING.constant(-3), RING) == -1


def test_zero_at_one_conjugate_factor_only() -> None:
    """Over omega = t (t^2 - 2) the polynomial x is 0 at one point of three."""
    omega = T * (T**2 - 2)
    slope = omega.derivative()
    rho = (T * slope % omega, fmpq_poly([0]))
    found = ZeroDimensionalParametrization(
        RING.variables, omega, rho, (fmpq(1), fmpq(0))
    )
    assert [p.sign(X, RING) for p in found.real_points()] == [-1, 0, 1]
    assert [p.sign(X**2 - 2, RING) for p in found.real_points()] == [0, -1, 0]
    assert found.vanishes(RING, X * (X**2 - 2))
    assert not found.vanishes(RING, X**2 - 2)


def test_complex_points_are_not_real() -> None:
    """{x^2 = -1, y = 0} has two points and no real one."""
    rho = (fmpq_poly([-2]), fmpq_poly([0]))
    found = ZeroDimensionalParametrization(
        RING.variables, T**2 + 1, rho, (fmpq(1), fmpq(0))
    )
    assert found.degree == 2
    assert found.real_points() == ()


def test_rational_membership() -> None:
    """(3, 4) belongs to {(3, 4)}; (3, 5) and points of the empty set do not."""
    single = ZeroDimensionalParametrization(
        RING.variables,
        T - 3,
        (fmpq_poly([3]), fmpq_poly([4])),
        (fmpq(1), fmpq(0)),
    )
    assert single.contains((3, 4))
    assert not single.contains((3, 5))
    assert not single.contains((4, 4))
    assert not empty_set(RING.variables).contains((3, 4))
    assert not square_roots().contains((fmpq(7, 5), fmpq(12, 5)))


def test_equality_does_not_depend_on_the_form() -> None:
    """The points (±√2, ±√2 + 1) with y for the form are the same two points."""
    first = square_roots()
    omega = (T - 1) ** 2 - 2
    slope = omega.derivative()
    rho = ((T - 1) * slope % omega, T * slope % omega)
    second = ZeroDimensionalParametrization(
        RING.variables, omega, rho, (fmpq(0), fmpq(1))
    )
    assert first.same_points(second)
    assert second.same_points(first)
    mirrored = replace(first, rho=(first.rho[0], 2 * T - 4))
    assert not first.same_points(mirrored)
    assert empty_set(RING.variables).is_subset(first)
    assert not first.is_subset(empty_set(RING.variables))


def test_points_are_hashable_and_named_by_their_root() -> None:
    """The same real point asked for twice is one element of a set."""
    found = square_roots()
    points = {*found.real_points(), *found.real_points()}
    assert len(points) == 2
    assert all(isinstance(point, RealPoint) for point in points)
