from __future__ import annotations

import pytest
from surfaces import Build, arm_map, cylinder, decided, plane, torus

from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.geometry.cusps import Count, cusps

Pair = tuple[PolynomialSystem, PolynomialMap]


def count(pair: Pair) -> Count:
    """The cusps of a map."""
    decision = decided(pair)
    return cusps(decision.roadmap, pair[1], decision.delta)


PLANE: dict[str, tuple[Build, Count]] = {
    "fold": (lambda x, y: (x**2, y), Count(0, True)),
    "Whitney cusp": (lambda x, y: (x**3 + x * y, y), Count(1, True)),
    "Whitney cusp, exchanged": (lambda x, y: (y**3 + x * y, x), Count(1, True)),
    "two folds": (lambda x, y: (x**3 - 3 * x, y), Count(0, True)),
    "swallowtail section": (lambda x, y: (x**4 + x * y, y), Count(0, False)),
    "identity": (lambda x, y: (x, y), Count(0, True)),
}


@pytest.mark.parametrize("name", ["Whitney cusp", "Whitney cusp, exchanged"])
def test_normal_forms(name: str) -> None:
    """The normal form of a cusp has one."""
    build, wanted = PLANE[name]
    assert count(plane(build)) == wanted


@pytest.mark.parametrize("name", ["fold", "two folds", "identity"])
def test_folds_have_none(name: str) -> None:
    """Folds have no cusp, proved or not."""
    build, wanted = PLANE[name]
    assert count(plane(build)).count == wanted.count


def test_a_degenerate_tangency_is_not_proved() -> None:
    """(x^4 + x y, y): the tangency at 0 is double, no cusp, and no claim of proof."""
    build, _ = PLANE["swallowtail section"]
    assert count(plane(build)).proved is False


ARMS = [
    # a, d, alpha, cusps [Robotica 2007; MMT 2022]
    ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0), 4),
    ((1, 3, 4), (0, 3, 0), (-90, 90, 0), 2),
    ((1, ".7", ".7"), (0, ".3", ".9"), (-90, 90, 0), 8),
    ((1, 2, 1), (0, 1, 0), (-30, 90, 0), 4),
    ((1, ".5", ".8"), (0, ".2", 0), (-90, 90, 0), 0),
]


@pytest.mark.parametrize(("a", "d", "alpha", "wanted"), ARMS)
def test_arms(
    a: tuple[int, ...], d: tuple[int, ...], alpha: tuple[int, ...], wanted: int
) -> None:
    """The published numbers of cusps, proved."""
    assert count(arm_map(a, d, alpha)) == Count(wanted, True)


@pytest.mark.parametrize(("a", "d", "alpha", "wanted"), ARMS)
def test_cusps_do_not_depend_on_the_coordinates_of_values(
    a: tuple[int, ...], d: tuple[int, ...], alpha: tuple[int, ...], wanted: int
) -> None:
    """An affine change of (u, v) moves cusps and makes none."""
    variety, mapping = arm_map(a, d, alpha)
    u, v = mapping.components
    other = PolynomialMap(mapping.ring, (2 * u + v - 3, u - v))
    assert count((variety, other)).count == wanted


def test_a_determinant_constant_along_fibers_is_a_matter_of_walls() -> None:
    """Where Delta does not depend on the fiber, D vanishes and the count still ends."""
    # fibers are lines here, on which no wall is looked at: no claim
    assert count(plane(lambda x, y: (x, y**2 + x))) == Count(0, False)
    assert count(cylinder(lambda c, s, q: (q, c))).count == 0


def test_walls_are_looked_at() -> None:
    """Beside a wall whose image is one point, or a whole ellipse, the proof stands."""
    pair = arm_map((1, 3, 4), (0, 3, 0), (-90, 90, 0))
    assert decided(pair).roadmap.walls
    assert count(pair) == Count(2, True)
    # over s3 = 0 the fiber is critical, and its image is an ellipse
    ellipse = torus(lambda c2, s2, c3, s3: (c2 * (2 + c3), s2 * (2 + c3)))
    assert count(ellipse).count == 0
