from __future__ import annotations

import pytest
from flint import fmpq

from cuspaudit.algebra.polynomial_text import parse_polynomial
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.geometry.fibers.degree import has_degree_at_most


def at_most(
    points: int, variables: str, equations: list[str], mapping: list[str], *value: int
) -> bool:
    """The answer for a map given as text, over a value in halves."""
    ring = Ring(variables.split())
    f = tuple(parse_polynomial(ring, text) for text in equations)
    r = tuple(parse_polynomial(ring, text) for text in mapping)
    halves = [fmpq(v, 2) for v in value]
    return has_degree_at_most(
        PolynomialSystem(ring, f), PolynomialMap(ring, r), halves, points, 2.0
    )


@pytest.mark.parametrize(("points", "expected"), [(2, False), (3, True)])
def test_a_whitney_cusp_has_three_points(points: int, expected: bool) -> None:
    """Three is proved, and two, which is false, is not."""
    assert at_most(points, "x y", [], ["x^3 + x*y", "y"], 3, 5) is expected


def test_a_fiber_with_fewer_points_proves_nothing() -> None:
    """The fiber of x y = 1 over x = 0 has no point, though other fibers have one."""
    assert not at_most(0, "x y", ["x*y - 1"], ["x"], 0)
    assert at_most(1, "x y", ["x*y - 1"], ["x"], 3)


def test_a_lost_constant_term_proves_nothing() -> None:
    """The map x^2 + 1 over 1 loses its constant term."""
    assert not at_most(2, "x", [], ["x^2 + 1"], 2)
    assert at_most(2, "x", [], ["x^2 + 1"], 3)
