from __future__ import annotations

from itertools import islice

import numpy as np

from cuspaudit.algebra.polynomial_text import parse_polynomial
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.geometry.heights.guessed_ways import GuessedWays, random_points
from cuspaudit.geometry.heights.height import plain_height


def circle(function: str) -> ChartedHeight:
    """The height log |h|^2 on the unit circle."""
    ring = Ring(["c", "s"])
    variety = PolynomialSystem(ring, (parse_polynomial(ring, "c^2 + s^2 - 1"),))
    return ChartedHeight(
        variety, 1, plain_height(ring, [parse_polynomial(ring, function)])
    )


def test_random_points_lie_on_the_variety() -> None:
    """They are on V, differ, and come near the zeros of what is given besides."""
    landscape = circle("c")
    points = list(islice(random_points(landscape.variety, 1), 20))
    assert all(abs(c * c + s * s - 1) < 1e-12 for c, s in points)
    assert len({round(c, 6) for c, _ in points}) == 20
    near = islice(random_points(landscape.variety, 1, [landscape.height.base]), 5)
    assert all(abs(c) < 1e-9 for c, _ in near)


def test_maxima_of_one_component_are_joined_over_a_saddle() -> None:
    """2 + c^2 has the maxima c = +-1 on one circle; the way crosses |s| = 1."""
    ways = GuessedWays(circle("2 + c^2"))
    first, second = (ways.climbed(np.array([c, 0.6])) for c in (0.8, -0.8))
    assert first is not None
    assert second is not None
    assert (first[0], second[0]) == (0, 1)
    assert ways.between(0, 1) is None
    ways.join(random_points(ways.landscape.variety, 2))
    way = ways.between(0, 1)
    assert way is not None
    assert np.allclose(way[[0, -1]], [[1, 0], [-1, 0]], atol=1e-6)
    assert abs(way[:, 1]).max() > 0.999


def test_maxima_of_two_components_stay_apart() -> None:
    """The maxima of |c| are parted by c = 0."""
    ways = GuessedWays(circle("c"))
    for c in (0.8, -0.8):
        ways.climbed(np.array([c, 0.6]))
    ways.join(random_points(ways.landscape.variety, 2))
    assert len(ways.tops) == 2
    assert ways.between(0, 1) is None
