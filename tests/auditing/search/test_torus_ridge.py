"""Maxima of a function on the torus, passes, and the widest ways between maxima."""

import numpy as np
import pytest

from cuspaudit.auditing.search.torus_determinant import TorusDeterminant
from cuspaudit.auditing.search.torus_path import height_of
from cuspaudit.auditing.search.torus_ridge import Ridge
from cuspaudit.geometry.torus.critical import FAST, climb, critical_sheets

COS_2, COS_5 = (5, 0), (0, 1)
COS_4, COS_DOUBLE_4 = (0, 3), (0, 9)


def of_terms(terms: dict[tuple[int, int], float]) -> TorusDeterminant:
    """A function from entries of its table, by (row, column)."""
    table = np.zeros((15, 15))
    for at, value in terms.items():
        table[at] = value
    return TorusDeterminant(table)


def starts(count: int = 64) -> np.ndarray:
    """Random points of the torus."""
    return np.random.default_rng(3).uniform(-np.pi, np.pi, (count, 4))


DOUBLE = of_terms({(5, 0): 1.0, (1, 0): 1.0, (0, 9): 1.0, (0, 1): 1.0, (0, 0): 5.0})
"""cos 2 + cos 3 + cos(2 theta4) + cos 5 + 5: two equal maxima, 9, joined over 7."""


def test_the_table_is_read_as_meant() -> None:
    """The sum of cos theta2, cos theta3, cos 2 theta4, cos theta5 and 5."""
    x = starts(5)
    expected = np.cos(x[:, 0]) + np.cos(x[:, 1]) + np.cos(2 * x[:, 2]) + np.cos(x[:, 3])
    assert DOUBLE(x) == pytest.approx(expected + 5)


def test_critical_points_are_critical() -> None:
    """The gradient vanishes and the function does not."""
    found = critical_sheets(DOUBLE, starts())
    assert len(found) > 30
    assert np.abs(DOUBLE.gradient(found)).max() < 1e-6
    assert np.abs(DOUBLE(found)).min() > 0


def test_the_widest_way_is_over_the_pass() -> None:
    """The two maxima of ``DOUBLE`` are joined at height 7, that of the pass."""
    ridge = Ridge(DOUBLE, 1.0, critical_sheets(DOUBLE, starts(256)))
    assert DOUBLE(ridge.peaks)[:2] == pytest.approx([9.0, 9.0])
    tops = np.array([[0, 0, 0, 0], [0, 0, np.pi, 0]])
    assert ridge.levels(tops)[0, 1] == pytest.approx(7.0, abs=0.01)
    assert ridge.levels(tops)[0, 0] == np.inf


def test_a_path_over_the_ridge_keeps_its_ends_and_the_height() -> None:
    """Its first point is the start, its last the end modulo whole turns."""
    ridge = Ridge(DOUBLE, 1.0, critical_sheets(DOUBLE, starts(256)))
    ends = np.array([[0.5, 0.2, 0.4, -0.3], [-0.4, 0.3, 2.9, 0.6]])
    ways = climb(DOUBLE, ends, FAST)
    path = ridge.path(ways[:, 0], ways[::-1, 1])
    turns = (path[-1] - ends[1]) / (2 * np.pi)
    assert path[0] == pytest.approx(ends[0])
    assert turns == pytest.approx(np.round(turns), abs=1e-9)
    assert np.abs(np.diff(path, axis=0)).max() < 3.2
    assert height_of(DOUBLE, 1.0, path) >= 7.0 - 1e-3


def test_a_hair_between_two_factors_is_a_pass() -> None:
    """With h = cos 2 cos 5 + e the two positive parts are joined over e alone.

    The quadrants where both cosines are positive and where both are negative meet at
    the crossings, where h = e; the negative parts stay apart.
    """
    hair = of_terms({(5, 1): 1.0, (0, 0): 1e-6})
    critical = critical_sheets(hair, starts(256))
    positive, negative = (Ridge(hair, sign, critical) for sign in (1.0, -1.0))
    tops = np.array([[0, 0, 0, 0], [np.pi, 0, 0, np.pi]])
    assert positive.levels(tops)[0, 1] == pytest.approx(1e-6, rel=1e-3)
    tops = np.array([[np.pi, 0, 0, 0], [0, 0, 0, np.pi]])
    assert negative.levels(tops)[0, 1] == 0


def test_a_sign_that_does_not_occur_has_no_peaks() -> None:
    """Nothing is negative in ``DOUBLE``."""
    assert len(Ridge(DOUBLE, -1.0, critical_sheets(DOUBLE, starts())).peaks) == 0
