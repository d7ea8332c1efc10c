from __future__ import annotations

import pytest
from surfaces import arm_map, cylinder, plane

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import NotSquareError
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.surface import Surface, product_factors


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
