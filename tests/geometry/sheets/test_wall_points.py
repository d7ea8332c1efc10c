from __future__ import annotations

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.geometry.cells.open_cells import open_cells
from cuspaudit.geometry.fibers.generic_fiber import generic_fiber
from cuspaudit.geometry.sheets.sheet_crossing import cross
from cuspaudit.geometry.sheets.wall_points import WallPoints

SPACE = Ring(["x", "y", "z"])
X, Y, Z = SPACE.gens


def counts(f: list[Polynomial], mapping: list[Polynomial]) -> list[tuple[int, int]]:
    """At each wall, the points counted over it and the sheets that continue."""
    variety = PolynomialSystem(SPACE, tuple(f))
    fiber = generic_fiber(variety, PolynomialMap(SPACE, tuple(mapping)))
    cells = open_cells(fiber.ring, [fiber.leading, fiber.discriminant], fiber.values)
    points = WallPoints(fiber, 60.0, 1)
    found = []
    for contact in cells.contacts:
        if contact.is_wall:
            near = contact.shrunk(
                (contact.ends[1][0] - contact.ends[0][0]) ** 2 / 16 + 1
            )
            pairs = cross(fiber, near, lambda near=near: points.regular(near))
            found.append((points.regular(contact), len(pairs)))
    return found


def test_points_over_a_wall_are_the_sheets_that_continue() -> None:
    """On the cubic cylinder, as many sheets continue as there are regular points."""
    found = counts([Y**3 - 3 * Y - X], [X, Z])
    assert found
    assert all(points == sheets == 1 for points, sheets in found)


def test_no_sheet_continues_at_an_inflection() -> None:
    """Over x = y^3 all points over x = 0 are critical."""
    assert counts([Y**3 - X], [X, Z]) == [(0, 0)]
