from __future__ import annotations

import pytest

from cuspaudit.algebra.points.macaulay import bezout_number, multiples_bound
from cuspaudit.algebra.ring import Polynomial, Ring

PLANE = Ring(["x", "y"])
X, Y = PLANE.gens
TORUS = Ring(["c", "s", "C", "S"])
C, S, BIG_C, BIG_S = TORUS.gens
CIRCLES = (C**2 + S**2 - 1, 3 - 3 * BIG_C**2 - 3 * BIG_S**2)


@pytest.mark.parametrize(
    ("equations", "dimension"),
    [
        ((X**2 - 2, Y**2 - 3), 4),
        ((X**2 + Y**2 - 1, X - Y), 2),
        ((X**2, X * Y, Y**2), 3),
        ((X * Y - 1, X**2 - Y), 3),
        ((X * Y - 1, X), 0),
        ((X**2 * Y - 1, Y**2 - X), 5),
    ],
)
def test_the_bound_is_the_dimension_of_the_quotient(
    equations: tuple[Polynomial, ...], dimension: int
) -> None:
    """The bound is proved for dim Q[x]/I, counted by hand, and not for one less."""
    assert multiples_bound(PLANE, equations, dimension, seconds=2)
    less = max(dimension - 1, 0)
    assert less == dimension or not multiples_bound(PLANE, equations, less, 0.02)


@pytest.mark.parametrize("equations", [(X * Y,), (X - Y, X**2 - Y**2), ()])
def test_a_curve_of_solutions_has_no_bound(equations: tuple[Polynomial, ...]) -> None:
    """Nothing is proved of systems with infinitely many solutions."""
    for points in range(1, 5):
        assert not multiples_bound(PLANE, equations, points, seconds=0.01)


def test_solutions_that_go_to_infinity_modulo_the_prime_do_not_deceive() -> None:
    """{p x = 1} has one solution over Q and none modulo p: 0 is not proved."""
    line = Ring(["x"])
    (x,) = line.gens
    equation = ((1 << 61) - 1) * x - 1
    assert not multiples_bound(line, [equation * (x - 3)], 1, seconds=0.2)


def test_bezout_in_space_and_on_the_torus() -> None:
    """Conic and cubic: 6. Forms of degree (1, 1) and (2, 1) on the torus: 12 = 4 * 3.

    On a product of two conics the classes h_i have h_1 h_2 = 4 and squares 0.
    """
    assert bezout_number(PLANE, [X**2 + Y - 1, Y**3 - X]) == 6
    two = (C * BIG_C - S, C * S * BIG_S - 1)
    assert bezout_number(TORUS, [*CIRCLES, *two]) == 12


def test_bezout_is_silent_where_it_does_not_hold() -> None:
    """Too many equations, or one that does not involve a circle: no bound."""
    assert bezout_number(PLANE, [X, Y, X - Y]) is None
    assert bezout_number(TORUS, [*CIRCLES, C - S, BIG_C - BIG_S]) is None
    assert bezout_number(TORUS, [*CIRCLES, C * BIG_C - 1]) is None
