"""Paths through the cells of a box: inside it, of one sign, between postures of one."""

from __future__ import annotations

import pytest
from joint_boxes import FACTS, arm_of, check_path, within, within_by_values
from short_tables import arm

from cuspaudit.cuspidality.box_path import box_paths

ROWS = [row for row in FACTS["rows"] if row["cuspidal_within"]]
FEW = (0, 3, 36, 42)
ISSAC = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))


@pytest.mark.parametrize("number", FEW)
def test_a_cuspidal_box_has_a_path(number: int) -> None:
    """The cells of a recorded box lead from one posture to the other."""
    row = ROWS[number]
    chain, limits = arm_of(row["arm"]), row["limits_deg"]
    check_path(chain, limits, next(box_paths(within(chain, limits))))


def test_sample_values_have_paths_too() -> None:
    """Couples over sample values lie in cells as well."""
    limits = (None, (-170, -30), (-40, 170))
    check_path(ISSAC, limits, next(box_paths(within_by_values(ISSAC, limits))))


def test_a_box_without_couples_has_no_path() -> None:
    """Nothing is proposed of a noncuspidal box."""
    assert list(box_paths(within(ISSAC, (None, (-20, 20), (-20, 20))))) == []
