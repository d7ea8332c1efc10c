"""One-dimensional parametrizations: the definition is held to, membership is exact."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from flint import arb, fmpq, fmpq_poly

from cuspaudit.algebra.points.one_dimensional import OneDimensionalParametrization
from cuspaudit.algebra.points.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.ring import Ring
from cuspaudit.errors import InvalidSystemError, UnableError

PLANE = Ring(["u", "v"])
U, V = PLANE.gens
ONE, ZERO = fmpq(1), fmpq(0)
#: the circle, x = u and y = v: omega_u x = 2 u^2 = 2 - 2 v^2
CIRCLE = OneDimensionalParametrization(
    *(("x", "y"), PLANE, U**2 + V**2 - 1, (2 - 2 * V**2, 2 * U * V)),
    ((ONE, ZERO), (ZERO, ONE)),
)
#: the curve (x, y, z) = (s^2 - 1, s^3 - s, s), whose image is a nodal cubic
NODE = U**2 - V**3 - V**2


def set_of(*points: tuple[fmpq, fmpq]) -> ZeroDimensionalParametrization:
    """Rational points of the plane with parameter x."""
    t, omega = fmpq_poly([0, 1]), fmpq_poly([1])
    for x, _ in points:
        omega *= t - x
    rho = [fmpq_poly([0]), fmpq_poly([0])]
    for x, y in points:
        rest = omega // (t - x)
        rho = [r + rest * c for r, c in zip(rho, (x, y), strict=True)]
    return ZeroDimensionalParametrization(
        ("x", "y"), omega, (rho[0], rho[1]), (ONE, ZERO)
    )


@pytest.mark.parametrize(
    "wrong",
    [
        {"omega": 2 * U**2 + V**2 - 1},
        {"omega": U * V - 1},
        {"omega": U**2 * V + V**2 - 1},
        {"omega": U**2 - V},
        {"omega": (U**2 + V**2 - 1) ** 2},
        {"omega": U * 0},
        {"rho": (2 * U**2, 2 * U * V)},
        {"rho": (2 - 2 * V**2, U * V)},
        {"rho": (2 - 2 * V**2,)},
        {"forms": ((ZERO, ONE), (ONE, ZERO))},
        {"forms": ((ONE,), (ZERO,))},
    ],
)
def test_the_definition_is_checked(wrong: dict[str, Any]) -> None:
    """Monic in both, square-free, reduced, and both forms the parameters."""
    with pytest.raises(InvalidSystemError):
        replace(CIRCLE, **wrong)


def test_points_over_a_value_are_on_the_curve() -> None:
    """Over v = 3/5 the circle has (-4/5, 3/5) and (4/5, 3/5)."""
    over = CIRCLE.over(fmpq(3, 5))
    assert over.degree == 2
    assert over.contains((fmpq(4, 5), fmpq(3, 5)))
    assert over.contains((fmpq(-4, 5), fmpq(3, 5)))
    x, y = CIRCLE.point(arb(4) / 5, arb(3) / 5)
    assert x.contains(fmpq(4, 5))
    assert y.contains(fmpq(3, 5))


def test_a_critical_value_has_no_parametrized_fiber() -> None:
    """Over v = 1 omega has a double root."""
    with pytest.raises(InvalidSystemError):
        CIRCLE.over(fmpq(1))


def test_numerators_are_the_function_on_the_curve() -> None:
    """X^2 + y^2 - 1 is 0 on the circle; x y is rho_1 rho_2 / omega_u^2."""
    ring = Ring(["y", "x"])
    y, x = ring.gens
    assert CIRCLE.numerator(ring, x**2 + y**2 - 1) == 0
    product = CIRCLE.numerator(ring, x * y) - CIRCLE.rho[0] * CIRCLE.rho[1]
    assert CIRCLE.remainder(product) == 0


def test_membership_is_exact() -> None:
    """Pythagorean points are on the circle; one off by 10^-30 is not."""
    on = set_of((fmpq(3, 5), fmpq(4, 5)), (fmpq(5, 13), fmpq(-12, 13)))
    assert CIRCLE.contains(on)
    near = fmpq(4, 5) + fmpq(1, 10**30)
    assert not CIRCLE.contains(set_of((fmpq(3, 5), near)))
    assert not CIRCLE.contains(replace(on, variables=("x", "z")))


def test_membership_where_the_slope_is_zero_is_not_guessed() -> None:
    """(0, 1) has omega_u = 0 and fits the identities: not told; (0, 2) does not."""
    with pytest.raises(UnableError):
        CIRCLE.contains(set_of((ZERO, ONE)))
    assert not CIRCLE.contains(set_of((ZERO, fmpq(2))))
