"""Walls at two points of a circle, and covers of the halves between them."""

from __future__ import annotations

import numpy as np
import pytest
from flint import arb, fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import reduce_on_circles
from cuspaudit.errors import UnableError
from cuspaudit.geometry.torus import halves as module
from cuspaudit.geometry.torus.components import TorusComponents, torus_components

RING = Ring(["c1", "s1", "c2", "s2"])
CIRCLES = [("c1", "s1"), ("c2", "s2")]
c1, s1, c2, s2 = RING.gens


def counted(function: Polynomial) -> TorusComponents:
    """The components, by covers where they are needed."""
    return torus_components(RING, CIRCLES, function, 20.0)


WALLS = [c1, s1, -c1, (3 * c1 + 4 * s1) / 5, (12 * s1 - 5 * c1) / 13]


@pytest.mark.parametrize("wall", WALLS)
def test_walls_and_at_most_one_component_on_each_side(wall: Polynomial) -> None:
    """Each sign of w + 2 c2 is connected on each side; w + c2 + 3 is positive."""
    assert counted(wall * (wall + 2 * c2)).number_of_components == 4
    assert counted(wall * (wall + c2 + 3)).number_of_components == 2


@pytest.mark.parametrize("wall", WALLS)
def test_the_folded_circle_covers_the_half(wall: Polynomial) -> None:
    """Along its middle a point is at cos(phi)^2, across at 2 sin(phi), over 1 + sin^2.

    So it stays on the circle, and w is 0 at the ends only.
    """
    found = module._middle(RING, CIRCLES, wall)
    assert found is not None
    circle, middle = found
    a, b = middle
    across = a * s1 - b * c1
    for function, expected in ((wall, c1**2), (across, 2 * s1)):
        folded = module._folded(RING, CIRCLES, circle, function, middle)
        assert reduce_on_circles(RING, CIRCLES, folded - expected) == 0


@pytest.mark.parametrize("wall", WALLS)
def test_a_component_that_no_wall_meets_is_not_counted(wall: Polynomial) -> None:
    """2 w + c2 + 5/2 is negative for w < -3/4 only: folded, there are two of it.

    With -w for w the same holds on the other side.
    """
    for sign in (1, -1):
        rest = 2 * sign * wall + c2 + RING.constant(fmpq(5, 2))
        with pytest.raises(UnableError, match="several components"):
            counted(wall * rest)


def test_labels_are_the_two_signs() -> None:
    """Points get as many labels as there are components, by the signs of w and g."""
    wall, rest = c1, c1 + 2 * c2
    found, labels = counted(wall * rest), {}
    for x, y in np.random.default_rng(0).uniform(-np.pi, np.pi, (40, 2)):
        label = found.component_at({CIRCLES[0]: x, CIRCLES[1]: y})
        signs = np.cos(x) > 0, np.cos(x) + 2 * np.cos(y) > 0
        assert labels.setdefault(signs, label) == label
    assert len(set(labels.values())) == 4
    assert found.component({"c1": arb(0, 1), "s1": arb(0, 1), "c2": 1, "s2": 0}) is None


def test_two_components_of_one_sign_are_not_told_apart() -> None:
    """4 s1^2 > 1 has two parts in the half circle c1 > 0."""
    with pytest.raises(UnableError, match="several components"):
        counted(c1 * (4 * s1**2 - 1 + c2 / 10))


def test_a_wall_in_an_irrational_direction_is_left_to_the_covers() -> None:
    """The middle of the half circle c1 + s1 > 0 is no rational point: not settled."""
    with pytest.raises(UnableError, match="not settled"):
        torus_components(RING, CIRCLES, (c1 + s1) * (c1 + 2 * c2), 1.0)
