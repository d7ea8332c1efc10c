from __future__ import annotations

from dataclasses import replace

import pytest
from short_tables import arm, shift
from surfaces import arm_map, cylinder, plane, torus

from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.surface.surface import Surface, product_factors
from cuspaudit.surface.value_circles import ValueCircles, value_circles

Map = tuple[PolynomialSystem, PolynomialMap]


def circles_of(pair: Map) -> ValueCircles:
    """The circles of a map."""
    return value_circles(oriented(*pair)[0], pair[1])


@pytest.mark.parametrize(
    ("a1", "twist", "squared"), [(1, -90, 4), (4, 90, 64), (1, 30, 16), (3, -60, 48)]
)
def test_the_metric_of_an_arm(a1: int, twist: int, squared: int) -> None:
    """In (|p|^2, z) the circles are stretched by 2 a1 / sin(alpha1)."""
    circles = circles_of(arm_map((a1, 2, "3/2"), (0, 1, "1/3"), (twist, 60, 0)))
    assert circles.metric == squared
    assert not circles.is_triangular


def test_where_the_second_frame_stands_on_its_axis_changes_no_metric() -> None:
    """A frame slid along axis 2 gives r_1 a multiple of r_2, which is taken off."""
    chain = arm((3, 2, "3/2"), (0, 1, "1/3"), (-60, 90, 0))
    first, second, third = chain.joints
    slid = replace(second, before=(*second.before, shift(0, 0, 5)))
    back = replace(third, before=(shift(0, 0, -5), *third.before))
    moved = reduced_map(exact_model(replace(chain, joints=(first, slid, back))))
    (k11, k12, _), (k21, k22, _) = map(
        oriented(*moved)[0].affine_parts, moved[1].components
    )
    assert k11 * k21 + k12 * k22 != 0
    assert circles_of(moved).metric == 48


@pytest.mark.parametrize(
    ("a", "alpha", "kinds"),
    [((0, 2, 1), (90, 90, 0), "RRR"), ((1, 2, 1), (0, 60, 0), "RRR")],
)
def test_axes_that_meet_or_are_parallel_are_triangular(
    a: tuple[int, ...], alpha: tuple[int, ...], kinds: str
) -> None:
    """With axes 1 and 2 meeting, or parallel, one coordinate ignores joint 2."""
    assert circles_of(arm_map(a, (0, 0, 0), alpha, kinds)).is_triangular


@pytest.mark.parametrize(
    ("pair", "why"),
    [
        (torus(lambda c, s, k, t: (k * t + 3 * c, t + 3 * s)), "high degree"),
        (cylinder(lambda c, s, q: (q**3 + 3 * c, q + 3 * s)), "high degree"),
        (plane(lambda x, y: (x**3 + x * y, y)), "affine"),
    ],
)
def test_other_maps_are_refused(pair: Map, why: str) -> None:
    """Centers on a curve of higher degree, or no circle of values at all."""
    with pytest.raises(UnableError, match=why):
        circles_of(pair)


def test_ellipses_of_several_shapes_are_refused() -> None:
    """Then Delta is not affine along the fiber."""
    variety, mapping = torus(lambda c, s, k, t: ((k + 2) * c + k, (k + 3) * s))
    surface = Surface(variety.ring, *product_factors(variety))
    with pytest.raises(UnableError, match="ellipses"):
        value_circles(surface, mapping)
