"""The bound by elements of bounded degree, against systems whose zeros are known."""

from __future__ import annotations

import pytest
from flint import fmpq

from cuspaudit.algebra.points import border_bound as module
from cuspaudit.algebra.points.border_bound import border_bound, is_dimension_below
from cuspaudit.algebra.ring import Polynomial, Ring


def three() -> tuple[Ring, list[Polynomial]]:
    """A line through a circle, and a third curve that falls in degree."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    return ring, [x**2 + y**2 - 5, (x**2 + y**2) * (x - 2) + y - 1]


def test_the_bound_is_met_and_no_smaller_one() -> None:
    """x^2 + y^2 = 5 and 5 (x - 2) + y = 1 have two points; one is not all."""
    ring, equations = three()
    assert border_bound(ring, equations, 2)
    assert not border_bound(ring, equations, 1)


def test_multiplicities_count() -> None:
    """x^2 = y, y^2 = 0 is one point four times."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    assert border_bound(ring, [x**2 - y, y**2], 4)
    assert not border_bound(ring, [x**2 - y, y**2], 3)


def test_no_solution_is_the_bound_0() -> None:
    """1 is found among the elements."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    assert border_bound(ring, [x * y - 1, x * y**2, x**2 + y], 0)


def test_curves_have_no_bound() -> None:
    """A circle alone, and two curves with a line in common."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    assert not border_bound(ring, [x**2 + y**2 - 1], 100)
    assert not border_bound(ring, [x * (y - 1), x * (x - y)], 100)


def test_a_prime_that_hides_terms_proves_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """P x^2 + x - 1 has two zeros; modulo p it seems to have one."""
    monkeypatch.setattr(module, "_PRIME", 101)
    ring = Ring(["x"])
    (x,) = ring.gens
    assert not border_bound(ring, [101 * x**2 + x - 1], 1)
    assert border_bound(ring, [102 * x**2 + x - 1], 2)


def test_numbers_that_grow() -> None:
    """The points of a weighted cubic: coefficients of many digits on the way."""
    ring = Ring(["x", "y", "z"])
    x, y, z = ring.gens
    equations = [
        x**2 + 3 * y * z - fmpq(7, 11) * x + 1,
        y**2 - fmpq(5, 13) * x * z + y - 2,
        z**2 + x * y - fmpq(3, 17) * z + fmpq(9, 4),
    ]
    assert border_bound(ring, equations, 8)
    assert not border_bound(ring, equations, 7)


def test_dimensions_are_bounded_from_above() -> None:
    """Points and curves where they are, and no less; empty sets have -1."""
    ring = Ring(["x", "y", "z"])
    x, y, z = ring.gens
    cubic = [y - x**2, z - x**3]
    assert is_dimension_below(ring, cubic, 2)
    assert not is_dimension_below(ring, cubic, 1)
    assert is_dimension_below(ring, [*cubic, x + y + z - 1], 1)
    assert not is_dimension_below(ring, [*cubic, x + y + z - 1], 0)
    assert is_dimension_below(ring, [x * y - 1, x * z, y * z, z - 1], 0)
    # two planes that meet in a line, and a point off it
    assert not is_dimension_below(ring, [x * y * (z - 1), x * y * (x - 1)], 2)
