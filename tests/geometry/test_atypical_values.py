from __future__ import annotations

import pytest
from flint import fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.geometry.atypical_values import atypical_values
from cuspaudit.geometry.crit import crit

PLANE = Ring(["x", "y"])
X, Y = PLANE.gens
R2 = PolynomialSystem(PLANE)


def product(variety: PolynomialSystem, *mapping: Polynomial) -> Polynomial:
    """The polynomial of Q[y_1..y_d] whose zeros are those of all g."""
    values = atypical_values(variety, PolynomialMap(variety.ring, mapping))
    first, second = values.polynomials
    return first * second


@pytest.mark.parametrize(
    "mapping",
    [
        (X**3 + X * Y, Y),
        (X**2 - Y, X * Y + Y**2),
        (X**2 + X * Y**2, Y**3 - 2 * X),
        (X, X * Y**2),
    ],
)
def test_every_critical_value_is_a_zero(mapping: tuple[Polynomial, ...]) -> None:
    """g(R(x, y)) is divisible by every factor of Delta: its zeros contain R(crit)."""
    atypical = product(R2, *mapping)
    (delta,) = crit(R2, PolynomialMap(PLANE, mapping))
    pulled = atypical.compose(PLANE.gens[0], *mapping, ctx=PLANE.context)
    for factor, _ in delta.factor()[1]:
        assert divmod(pulled, factor)[1] == 0


@pytest.mark.parametrize(
    ("variety", "mapping", "value"),
    [
        (PolynomialSystem(PLANE, (X * Y - 1,)), (X,), (0,)),
        (PolynomialSystem(PLANE, (X * Y**2 - Y + 1,)), (X,), (0,)),
        (R2, (X, X * Y), (0, 7)),
    ],
)
def test_values_that_points_reach_from_infinity_are_zeros(
    variety: PolynomialSystem, mapping: tuple[Polynomial, ...], value: tuple[int, ...]
) -> None:
    """The value is a limit of R along a way to infinity on V: R is not proper there."""
    atypical = product(variety, *mapping)
    assert atypical(fmpq(0), *map(fmpq, value)) == 0


def test_a_proper_map_without_critical_points_has_no_atypical_values() -> None:
    """An automorphism of the plane: g is a constant."""
    assert product(R2, X + Y**2, Y).is_constant()
