from __future__ import annotations

import warnings

import numpy as np
import pytest

from cuspaudit.geometry.torus.boxes import Boxes


def boxes(value: float) -> Boxes:
    """A plain box, and one on which the numbers are as large as ``value``."""
    shapes = ((2, 3), (2, 3, 2), (2, 3, 2, 2))
    values = [np.full(shape, 0.5) for shape in shapes]
    for array in values:
        array[1] = value
    return Boxes(0.01, 1e-12, *values, np.full((2, 2, 2, 2), 0.5))


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e308])
def test_what_floating_point_cannot_hold_is_no_answer(value: float) -> None:
    """A box whose numbers overflow is neither an error nor free of a maximum."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        found = boxes(value).no_maximum()
        plain = boxes(0.5).no_maximum()
    assert found[0] == plain[0]
    assert not found[1]
