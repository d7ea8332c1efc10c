from __future__ import annotations

from math import prod

import pytest
from surfaces import arm_map, cylinder, plane

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import NotSquareError
from cuspaudit.geometry.crit import crit, without_units
from cuspaudit.surface.surface import Surface, product_factors


def test_the_paper_s_determinant() -> None:
    """On the ISSAC arm Delta is a multiple of (3 c3 + 4)(c2 c3 - 2 c2 s3 - s3)."""
    variety, mapping = arm_map((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
    (delta,) = crit(variety, mapping)
    surface = Surface(variety.ring, *product_factors(variety))
    c2, _, c3, s3 = variety.ring.gens
    page = surface.reduce((3 * c3 + 4) * (c2 * c3 - 2 * c2 * s3 - s3))
    found = surface.reduce(delta)
    ratio = found.leading_coefficient() / page.leading_coefficient()
    assert found == ratio * page


def test_a_fold_is_critical_on_its_line() -> None:
    """(x^2, y) is critical at x = 0."""
    variety, mapping = plane(lambda x, y: (x**2, y))
    assert crit(variety, mapping) == (2 * variety.ring.gen("x"),)


def test_too_few_rows_are_an_error() -> None:
    """A map to a line from the plane has no square Jacobian matrix."""
    with pytest.raises(NotSquareError, match="1 equations") as error:
        crit(*plane(lambda x, y: (x,)))
    assert (error.value.rows, error.value.variables) == (1, 2)


def test_more_rows_give_every_minor_that_is_not_zero() -> None:
    """With one equation too many all minors are returned, zeros left out."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    system = PolynomialSystem(ring, (x - 1, 2 * x - 2))
    assert crit(system, PolynomialMap(ring, (y,))) == (
        ring.constant(1),
        ring.constant(2),
    )


def test_a_change_of_value_coordinates_multiplies_delta() -> None:
    """R followed by an affine map of determinant k has k times the Delta."""
    (first,) = crit(*cylinder(lambda c, s, q: (c * q, s + q)))
    (second,) = crit(*cylinder(lambda c, s, q: (2 * c * q + s + q, 3 * (s + q) - 1)))
    assert second == 6 * first


@pytest.mark.parametrize("d", [1, 2, 3, 4])
def test_the_power_map_is_critical_on_the_coordinate_planes(d: int) -> None:
    """(x_1^2, ..., x_d^2) on R^d has Delta = 2^d x_1 ... x_d."""
    ring = Ring([f"x{i}" for i in range(d)])
    squares = PolynomialMap(ring, tuple(x * x for x in ring.gens))
    (delta,) = crit(PolynomialSystem(ring), squares)
    assert delta == prod(ring.gens) * 2**d


@pytest.mark.parametrize("d", [1, 2, 3])
def test_height_directions_of_the_sphere(d: int) -> None:
    """The projection of the unit sphere of R^(d+1) to R^d is critical where x_0 = 0."""
    ring = Ring([f"x{i}" for i in range(d + 1)])
    sphere = PolynomialSystem(ring, (ring.total(x * x for x in ring.gens) - 1,))
    (delta,) = crit(sphere, PolynomialMap(ring, ring.gens[1:]))
    assert delta == 2 * ring.gens[0]


def test_singular_points_are_critical_for_every_map() -> None:
    """All the minors vanish at the vertex of the cone over the twisted cubic.

    Three equations in C^4 for a surface: ten minors of size 4 of five rows and more.
    """
    ring = Ring(["a", "b", "c", "d"])
    a, b, c, d = ring.gens
    cone = PolynomialSystem(ring, (a * c - b**2, a * d - b * c, b * d - c**2))
    minors = crit(cone, PolynomialMap(ring, (a + 2 * d, b - c + 3 * a)))
    vertex = dict.fromkeys(ring.variables, 0)
    smooth = dict.fromkeys(ring.variables, 1)
    assert minors and all(ring.substitute(p, vertex) == 0 for p in minors)
    assert any(ring.substitute(p, smooth) != 0 for p in minors)


def test_an_equation_given_twice_gives_no_minor_twice() -> None:
    """The circle written twice has the one minor of the circle."""
    ring = Ring(["c", "s"])
    c, s = ring.gens
    circle = c**2 + s**2 - 1
    once = crit(PolynomialSystem(ring, (circle,)), PolynomialMap(ring, (c,)))
    twice = crit(PolynomialSystem(ring, (circle, circle)), PolynomialMap(ring, (c,)))
    assert once == twice == (-2 * s,)


def test_a_constant_component_leaves_no_minor() -> None:
    """Where every point is critical there is nothing to cut V with."""
    assert crit(*plane(lambda x, y: (x, 0 * x))) == ()


def test_circles_leave_no_constant_factor() -> None:
    """c^2 + s^2 is r on c^2 + s^2 = r, in any power; on other curves it stays."""
    ring = Ring(["c", "s", "x", "y"])
    c, s, x, y = ring.gens
    square = c**2 + s**2
    circle = PolynomialSystem(ring, (3 * square - 6, x * y - 1))
    assert without_units(circle, (square**2 * (x - c), x * square)) == (x - c, x)
    for other in (3 * square + 6, c**2 + 2 * s**2 - 1, square - x):
        variety = PolynomialSystem(ring, (other,))
        assert without_units(variety, (square * x,)) == (square * x,)
