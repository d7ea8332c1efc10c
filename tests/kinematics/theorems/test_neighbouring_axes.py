"""Three joints with two axes in a row that are parallel or meet, against the engine."""

from __future__ import annotations

import pytest
from short_tables import Number, arm, ask

from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.theorems.neighbouring_axes import (
    aspects_of_parallel_axes,
    neighbouring_axes,
)

Columns = tuple[tuple[Number, ...], tuple[Number, ...], tuple[Number, ...]]
HOLD: dict[str, Columns] = {
    "axes 1, 2 are parallel": ((1, 2, "3/2"), (0, 1, "1/3"), (0, 90, 0)),
    "axes 1, 2 meet": ((0, 2, "3/2"), (0, 1, "1/3"), (-90, 90, 0)),
    "axes 2, 3 are parallel": ((1, 2, "3/2"), (0, 1, "1/3"), (-60, 180, 0)),
    "axes 2, 3 meet": ((1, 0, "3/2"), (0, 1, "1/3"), (-90, 30, 0)),
}


@pytest.mark.parametrize("words", HOLD)
def test_such_arms_are_noncuspidal(words: str) -> None:
    """Algorithm 1, which knows no such theorem, says noncuspidal too."""
    chain = arm(*HOLD[words])
    assert neighbouring_axes(exact_model(chain)) == words
    assert ask(chain).verdict.value == "noncuspidal"


def test_other_arms_are_not_settled() -> None:
    """The cuspidal arm of the paper has no such axes, nor has one with a slide."""
    chain = arm((1, 2, "3/2"), (0, 1, 0), (90, -90, 0))
    assert ask(chain).verdict.value == "cuspidal"
    assert neighbouring_axes(exact_model(chain)) is None
    assert neighbouring_axes(exact_model(arm(*HOLD["axes 1, 2 meet"], "RRP"))) is None


@pytest.mark.parametrize(
    ("lengths", "count"), [((1, 2, "3/2"), 4), ((4, 2, "3/2"), 2), ((0, 2, 2), 4)]
)
def test_parallel_axes_have_so_many_aspects(
    lengths: tuple[Number, ...], count: int
) -> None:
    """As many as Algorithm 1 counts, if axis 1 is within reach and if it is not."""
    chain = arm(lengths, (0, 1, "1/3"), (-90, 180, 0))
    assert aspects_of_parallel_axes(exact_model(chain)) == count
    found = ask(chain).aspects
    assert found is not None
    assert found.count == count
