"""What the page says to do, and why there is no verdict, in sentences."""

from __future__ import annotations

from typing import Any

import pytest

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.pictures.page import page_text
from cuspaudit.robot.library import open_robot
from cuspaudit.viz.advice import advice, file_name, margin_words, undecided_words

NEAR = {"name": "spherical wrist", "holds": False, "length": 1e-4, "angle": 0.0}
NEAR |= {"unit": "m", "verdict": "noncuspidal"}


def test_a_time_limit_is_named_and_more_time_advised() -> None:
    """An audit without time: the step, the limit, and what to type; no dump."""
    found = audit(open_robot("chablat-2022-3r"), Options(timeout=0))
    record = found.record()
    words = undecided_words(record)
    assert "because the time limit of 0 s has passed" in words
    assert "A verdict would come of more time (--timeout)." in words
    assert any("--timeout 600" in sentence for sentence in advice(record))
    page = page_text(record, found)
    assert words.replace("“", "“") in page
    assert "{&#39;" not in page
    assert "{'" not in page.split("<script")[0]


@pytest.mark.parametrize(
    "file", ["/home/me/arm.urdf", r"C:\robots\arm.urdf", "arm.urdf"]
)
def test_the_page_shows_the_name_of_a_file_and_not_its_folders(file: str) -> None:
    """Folders are those of one machine."""
    assert file_name({"robot": {"file": file}}) == "arm.urdf"


def test_a_cuspidal_arm_has_its_nearest_remedies() -> None:
    """The structure that ends it, and the limits that do, where the audit has them."""
    record: dict[str, Any] = {"verdict": "cuspidal", "structures": [NEAR]}
    assert any("a spherical wrist is 0.10 mm away" in s for s in advice(record))
    record |= {"limits": {"verdict": "noncuspidal"}}
    assert any("Within its joint limits" in s for s in advice(record))
    record["structures"] = [NEAR | {"verdict": "cuspidal"}, NEAR | {"holds": True}]
    assert not any("away" in s for s in advice(record))


@pytest.mark.parametrize("verdict", ["cuspidal", "noncuspidal", "undecided", None])
def test_an_audit_from_elsewhere_breaks_nothing(verdict: str | None) -> None:
    """Keys that are missing or of another kind leave sentences out."""
    strange: dict[str, Any] = {"verdict": verdict, "structures": 3, "limits": "no"}
    strange |= {"undecided": ["x"], "margin": {"joint_angle": "wide"}, "robot": None}
    assert advice(strange)
    assert undecided_words(strange) == margin_words(strange) == file_name(strange) == ""


def test_the_margin_is_in_degrees() -> None:
    """It is in rad in the JSON."""
    assert margin_words({"margin": {"joint_angle": 0.0698, "proved": True}}) == "4.0°"
