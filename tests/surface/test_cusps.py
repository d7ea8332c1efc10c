from __future__ import annotations

import pytest
from flint import fmpq
from short_tables import Number
from surfaces import Build, arm_map, cylinder, decided, plane, torus

from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.count import Count
from cuspaudit.surface.cusps import cusps
from cuspaudit.surface.surface import ROTATIONS

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


@pytest.mark.parametrize(
    ("a2", "a3", "d2"), [(2, 1, 1), ("5/2", 2, "1/2"), ("5/4", 1, "1/2"), (10, 2, 2)]
)
def test_a_cusp_at_theta3_180_degrees_is_counted(
    a2: Number, a3: Number, d2: Number
) -> None:
    """With a2 = a3 (1 + d2^2) two of the four cusps stand where a chart has no point.

    There theta2 = +-90 degrees; on the critical curve k . grad Delta is a multiple of
    a2 - a3 (1 + d2^2).
    """
    assert count(arm_map((1, a2, a3), (0, d2, 0), (-90, 90, 0))) == Count(4, True)


def test_no_chart_hides_a_cusp() -> None:
    """The Whitney cusp of a torus, turned so that it stands at any special angle."""
    wanted = count(turned_cusp(fmpq(1), fmpq(0)))
    assert wanted.count > 0
    for c, s in ROTATIONS:
        for cosine, sine in ((c, s), (-c, -s), (-s, c)):
            assert count(turned_cusp(cosine, sine)) == wanted


def turned_cusp(cosine: fmpq, sine: fmpq) -> Pair:
    """The ISSAC-like arm with a cusp at theta3 = 180 degrees, its zero turned."""
    variety, mapping = arm_map((1, 2, 1), (0, 1, 0), (-90, 90, 0))
    ring = variety.ring
    c2, s2, c3, s3 = ring.gens
    place = (c2, s2, cosine * c3 - sine * s3, sine * c3 + cosine * s3)
    components = (r.compose(*place, ctx=ring.context) for r in mapping.components)
    return variety, PolynomialMap(ring, tuple(components))
