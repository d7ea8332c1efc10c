"""Eighty recorded boxes of three-joint arms: verdict and aspects within limits."""

from __future__ import annotations

from typing import Any

import pytest
from joint_boxes import FACTS, arm_of, check_path, within, within_by_values

from cuspaudit.cuspidality.box_path import box_paths
from cuspaudit.cuspidality.verdict import Verdict

ROWS: list[dict[str, Any]] = FACTS["rows"]
#: the last has a limit at exactly 3 pi/4, where the singular curve touches it
FEW = (1, 21, 53, 60, 67)


def name_of(row: dict[str, Any]) -> str:
    """The arm and its limits."""
    return f"{row['arm']} {row['limits_deg']}"


def check(row: dict[str, Any], *, by_values: bool = False) -> None:
    """Hold one row against one of the two routes."""
    chain, limits = arm_of(row["arm"]), row["limits_deg"]
    found = (within_by_values if by_values else within)(chain, limits)
    assert (found.verdict is Verdict.CUSPIDAL) == row["cuspidal_within"]
    assert found.verdict is not Verdict.UNDECIDED
    assert found.aspects.count == row["aspects_in_box"]
    assert found.aspects.proved
    if found.couples:
        check_path(chain, limits, next(box_paths(found)))


@pytest.mark.parametrize("row", [ROWS[k] for k in FEW], ids=name_of)
def test_pairs_give_the_recorded_verdict(row: dict[str, Any]) -> None:
    """The pairs with limit walls give the recorded verdict and number of aspects."""
    check(row)


@pytest.mark.slow
@pytest.mark.parametrize("row", ROWS, ids=name_of)
def test_pairs_give_every_recorded_verdict(row: dict[str, Any]) -> None:
    """The same for all rows."""
    check(row)


@pytest.mark.slow
@pytest.mark.parametrize(
    "row",
    [row for row in ROWS if (ends := row["limits_deg"][0]) is None or ends[1] > 90],
    ids=name_of,
)
def test_sample_values_give_every_recorded_verdict(row: dict[str, Any]) -> None:
    """Cells of values with the images of the limits say the same."""
    check(row, by_values=True)
