"""The verdict within joint limits as the page has it."""

from __future__ import annotations

import math
from typing import Any

from cuspaudit.viz.limit_rows import cut_rows, limit_rows, limit_words
from cuspaudit.viz.page_rows import posture_rows

PATH = [[0.0, 0.5], [1.0, -0.25]]


def audit(verdict: str, within: str, witness: bool = False) -> dict[str, Any]:
    """As much of an audit as the page needs."""
    limits = {
        "verdict": within,
        "why": "none lie in one aspect",
        "joints": [
            {"name": "a", "lower": -math.pi / 2, "upper": math.pi / 4},
            {"name": "b", "lower": None, "upper": None},
        ],
        "witness": {"path": PATH} if witness else None,
        "of_the_free_witness": {"inside": False, "leaves": "a at 1 rad, limit 0.785"},
    }
    return {
        "verdict": verdict,
        "limits": limits,
        "witness": {"path": PATH},
        "robot": {"joint_types": ["revolute", "prismatic"]},
    }


def test_two_verdicts_stand_side_by_side() -> None:
    """The headline names both, and who leaves the limits is said."""
    words = limit_words(audit("cuspidal", "noncuspidal"))
    assert words is not None
    assert words.headline == (
        "cuspidal as geometry, noncuspidal within its joint limits"
    )
    assert words.why.startswith("None lie")
    assert "which is shown here, leaves them: a at 1 rad" in words.paths
    same = limit_words(audit("cuspidal", "cuspidal", witness=True))
    assert same is not None
    assert same.headline == "cuspidal as geometry and within its joint limits"
    assert same.paths.startswith("The path shown stays inside them.")


def test_without_limits_there_is_nothing_to_say() -> None:
    """No words and no rows."""
    assert limit_words({"verdict": "cuspidal", "limits": None}) is None
    assert limit_rows({"verdict": "cuspidal"}) == []


def test_cuts_are_shares_of_a_range() -> None:
    """In percent; a dash where nothing was proved, nothing without cuts."""
    found = audit("cuspidal", "cuspidal")
    assert cut_rows(found) == []
    found["limits"]["cuts"] = [
        {"joint": "a", "noncuspidal_to": 0.375, "cuspidal_from": 0.40625},
        {"joint": "b", "noncuspidal_to": None, "cuspidal_from": 1.0},
    ]
    rows = [(row.joint, row.least, row.most) for row in cut_rows(found)]
    assert rows == [("a", "38 %", "41 %"), ("b", "–", "100 %")]


def test_room_is_the_distance_to_the_nearer_limit() -> None:
    """In degrees where a joint turns, below zero outside; a dash without limits."""
    first, second = limit_rows(audit("cuspidal", "noncuspidal"))
    assert (first.lower, first.upper, first.unit) == ("−90", "45", "°")
    assert (first.least, first.most) == ("0", "57.3")
    assert first.room == "−12.3"
    assert (second.lower, second.room, second.most, second.unit) == (
        *("–", "–", "0.5"),
        "",
    )


def test_the_postures_are_those_of_the_path_that_is_shown() -> None:
    """Of the path inside the limits where there is one, else of the one without."""
    found = audit("cuspidal", "cuspidal", witness=True)
    found["witness"]["postures"] = [[5.0, 5.0], [6.0, 6.0]]
    found["limits"]["witness"]["postures"] = [[0.0, 0.5], [1.0, -0.25]]
    assert [row.values for row in posture_rows(found, None)] == [
        ("0", "1"),
        ("0.5", "−0.25"),
    ]
    found["limits"]["witness"] = None
    assert posture_rows(found, None)[0].values == ("5", "6")
