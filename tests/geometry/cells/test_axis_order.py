"""The axis with the smallest projection is projected first; no answer changes."""

from __future__ import annotations

from itertools import permutations

import pytest

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.decision import decide
from cuspaudit.geometry.cells.axis_order import axis_order
from cuspaudit.geometry.fibers.generic_fiber import generic_fiber

RING = Ring(["x", "y", "z"])
X, Y, Z = RING.gens


def test_a_surface_of_revolution_is_projected_across_its_axis() -> None:
    """Of G(x^2 + y^2, z) a coordinate across the axis of revolution comes last."""
    w = X**2 + Y**2
    for names in permutations("xyz"):
        order = axis_order(RING, [w**2 + Z**3 * w - Z * w - 2 * Z**4 - 1], names)
        assert sorted(order) == [0, 1, 2]
        assert names[order[-1]] in "xy"


def test_one_axis_stays() -> None:
    """On a line there is nothing to order."""
    assert axis_order(RING, [X**2 - 2], ["x"]) == (0,)


def test_a_reordered_fiber_is_that_of_the_reordered_map() -> None:
    """Reordering the values gives the generic fiber of the reordered map."""
    mapping = PolynomialMap(RING, (X**3 + X * Y, Y, Z + X))
    fiber = generic_fiber(PolynomialSystem(RING), mapping)
    moved = fiber.reordered((2, 0, 1))
    assert moved.mapping.components == (Z + X, X**3 + X * Y, Y)
    for value in ([1, 2, 5], [-1, -3, 2]):
        here, there = fiber.over(value), moved.over([value[2], value[0], value[1]])
        assert here == there


@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_the_order_of_components_changes_no_answer(order: tuple[int, ...]) -> None:
    """A cusp times a line has one verdict and one couple in every order."""
    components = (X**3 + X * Y, Y, Z)
    mapping = PolynomialMap(RING, tuple(components[i] for i in order))
    run = decide(PolynomialSystem(RING), mapping)
    assert (run.verdict.value, run.components) == ("cuspidal", 2)
    assert run.couple is not None
    for point in run.couple.points:
        for r, q in zip(mapping.components, run.couple.value, strict=True):
            assert point.sign(r - q, RING) == 0
