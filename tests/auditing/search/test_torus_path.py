"""Paths on the torus that keep a function away from zero."""

import numpy as np
import pytest

from cuspaudit.auditing.search.torus_determinant import TorusDeterminant
from cuspaudit.auditing.search.torus_path import height_of, straight, tidy
from cuspaudit.geometry.torus.critical import FAST, climb


def of_terms(terms: dict[tuple[int, int], float]) -> TorusDeterminant:
    """A function from entries of its table, by (row, column)."""
    table = np.zeros((15, 15))
    for at, value in terms.items():
        table[at] = value
    return TorusDeterminant(table)


HEIGHT = of_terms({(5, 0): 1.0, (0, 0): 0.5})
"""cos theta2 + 1/2: the sign is positive for |theta2| < 120 degrees."""
FLAT = of_terms({(0, 0): 1.0})


def test_the_long_way_round_is_taken_where_it_is_higher() -> None:
    """From -100 to 100 degrees the short way crosses zero, the long one does not."""
    start = np.array([np.radians(-100), 0, 0, 0])
    end = np.array([np.radians(100), 0, 0, 0])
    target, low = straight(HEIGHT, np.array(1.0), start, end)
    assert target - start == pytest.approx([np.radians(200), 0, 0, 0])
    assert low == pytest.approx(0.5 + np.cos(np.radians(100)), abs=1e-9)


def test_the_height_of_a_path_is_its_lowest_point() -> None:
    """A path over theta2 = 90 degrees has height 1/2, and -3/2 for the other sign."""
    path = np.array([[0, 0, 0, 0], [np.pi / 2, 0, 1, 0], [0.1, 2, 0, 0]])
    assert height_of(HEIGHT, 1.0, path) == pytest.approx(0.5)
    assert height_of(HEIGHT, -1.0, path) == pytest.approx(-1.5)


def test_ascents_never_fall() -> None:
    """|h| rises along every way, to the maximum at 0 or the one at 180 degrees."""
    starts = np.random.default_rng(0).uniform(-np.pi, np.pi, (20, 4))
    values = np.abs(HEIGHT(climb(HEIGHT, starts, FAST)))
    assert (np.diff(values, axis=0) >= 0).all()
    assert set(np.round(values[-1], 6)) <= {1.5, 0.5}


def test_a_narrow_dip_between_samples_is_seen() -> None:
    """Two zeros 2e-4 rad apart, far less than the distance of samples, are found.

    h = (cos theta4)^2 - 1e-8 dips below zero at 90 degrees; with + 1e-8 it does not.
    """
    path = np.array([[0.3, 0, 0.1, 0], [0.3, 0, 2.9, 0]])
    dip, touch = (
        of_terms({(0, 9): 0.5, (0, 0): 0.5 + shift}) for shift in (-1e-8, 1e-8)
    )
    sampled = dip(path[0] + np.linspace(0, 1, 281)[:, None] * (path[1] - path[0]))
    assert sampled.min() > 0
    assert height_of(dip, 1.0, path) < 0
    assert height_of(touch, 1.0, path) == pytest.approx(1e-8, abs=1e-9)


def test_tidy_makes_a_detour_straight() -> None:
    """Where nothing is in the way two points are left, the ends of the path."""
    detour = np.array([[0, 0, 0, 0], [1, 2, 0, 0], [0, 0, 2, 1], [1, 1, 1, 1.0]])
    assert tidy(FLAT, 1.0, detour) == pytest.approx(detour[[0, -1]])


def test_tidy_keeps_most_of_the_height() -> None:
    """A corner that is needed stays, rounded; the path is hardly lower."""
    h = of_terms({(5, 0): 1.0, (5, 3): 0.0, (0, 3): 1.0})
    path = np.array(
        [[1.5, 0, 0, 0], [0.0, 0, 0, 0], [0, 0, 1.5, 0], [0.2, 0, 1.5, 1.0]]
    )
    shorter = tidy(h, 1.0, path)
    assert shorter[[0, -1]] == pytest.approx(path[[0, -1]])
    assert height_of(h, 1.0, shorter) >= 0.9 * height_of(h, 1.0, path)
