from __future__ import annotations

import random

import pytest

from cuspaudit.algebra.points.plane_bound import plane_bound
from cuspaudit.algebra.points.zero_dimensional import PLANE, solve_zero_dimensional
from cuspaudit.algebra.polynomial_text import parse_polynomial
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.geometry.routing import morse_graph

RING = Ring(["x", "y"])
X, Y = RING.gens
ONE = RING.constant(1)

#: the boundary of the synchronous states of three coupled oscillators (Kuramoto)
KURAMOTO = """
314928*x^8*y^4 + 1259712*x^7*y^5 + 1889568*x^6*y^6 + 1259712*x^5*y^7 + 314928*x^4*y^8
+ 139968*x^10 + 699840*x^9*y + 1277208*x^8*y^2 + 909792*x^7*y^3 - 279936*x^6*y^4
- 1084752*x^5*y^5 - 279936*x^4*y^6 + 909792*x^3*y^7 + 1277208*x^2*y^8 + 699840*x*y^9
+ 139968*y^10 - 96957*x^8 - 387828*x^7*y - 226962*x^6*y^2 + 676512*x^5*y^3
+ 1128249*x^4*y^4 + 676512*x^3*y^5 - 226962*x^2*y^6 - 387828*x*y^7 - 96957*y^8
+ 22680*x^6 + 68040*x^5*y - 20844*x^4*y^2 - 155088*x^3*y^3 - 20844*x^2*y^4
+ 68040*x*y^5 + 22680*y^6 - 2298*x^4 - 4596*x^3*y - 6894*x^2*y^2 - 4596*x*y^3
- 2298*y^4 + 96*x^2 + 96*x*y + 96*y^2 - 1
"""


def read(text: str) -> Polynomial:
    """The polynomial in x and y."""
    return parse_polynomial(RING, " ".join(text.split()))


@pytest.mark.parametrize(
    ("first", "second", "nonzero", "bound"),
    [
        ("x^2 + y^2 - 4", "x*y - 1", "1", 4),
        ("x^2 + y^2 - 4", "x*y - 1", "x - y", 4),
        ("x^2 - 1", "y^2 - 1", "x - y", 2),
        ("x^2 - 1", "y^2 - 1", "x*y", 4),
        ("x*y", "x + y^2 - 1", "y", 2),
        ("y^2", "x*y - x^2", "1", 1),
        ("y^2", "x*y - x^2", "y", 0),
        ("x*y - 1", "x", "1", 0),
        ("x", "y", "0", 0),
        ("x*y", "x*(y - 1)", "1", None),
        ("x", "x^2", "1", None),
        ("x", "x - 1", "1", None),
    ],
)
def test_the_bound_is_met_where_it_can_be(
    first: str, second: str, nonzero: str, bound: int | None
) -> None:
    """Points by hand: with and without h, at infinity, with multiplicity, on a line."""
    assert plane_bound(RING, read(first), read(second), read(nonzero)) == bound


def test_no_random_curves_have_more_points() -> None:
    """The exact solver finds at most as many points, and as many of simple ones."""
    chance = random.Random(4)
    for _ in range(6):
        a, b, h = (
            RING.total(
                chance.randint(-3, 3) * X**i * Y**j for i in range(3) for j in range(3)
            )
            + 7
            for _ in range(3)
        )
        found = solve_zero_dimensional(PolynomialSystem(RING, (a, b * h)), nonzero=h)
        assert plane_bound(RING, a, b, h) == found.degree


@pytest.mark.slow
def test_the_curve_of_three_oscillators_has_nine_regions() -> None:
    """The complement of a curve of degree 12 with singular points: nine components."""
    found = morse_graph(PolynomialSystem(RING), 2, [read(KURAMOTO)])
    assert found.number_of_components == 9
    assert found.grounds == (PLANE,)
