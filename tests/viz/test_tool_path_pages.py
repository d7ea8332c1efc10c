from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from visits import DESK, PHONE

import cuspaudit as cu
from cuspaudit.api.tool_paths import Trace
from cuspaudit.pictures.tool_path import postures_drawing
from cuspaudit.toolpath.postures import list_postures, postures_record
from cuspaudit.toolpath.traced_arm import traced_arm
from cuspaudit.toolpath.waypoints import Pose
from cuspaudit.viz.tool_path import render_postures

FLIP = [
    *((2.5, 0, 0.37), (1.2, 0, 0.37), (1.2, 0, 2.2)),
    *((3.2, 0, 2.2), (3.2, 0, 0.37), (2.5, 0, 0.37)),
]


@pytest.fixture(scope="module")
def flip() -> Trace:
    """A closed path of the paper's arm that changes posture."""
    return cu.trace(cu.load("chablat-2022-3r"), [{"position": p} for p in FLIP])


@pytest.fixture(scope="module")
def page(flip: Trace, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Its page."""
    file = tmp_path_factory.mktemp("trace") / "trace.html"
    flip.save_html(file)
    return file


def test_the_page_of_a_trace_says_what_becomes_of_every_run(page: Path) -> None:
    """Deaths, the changed posture and the run to start in stand in its text."""
    text = page.read_text()
    assert "2 of 4 starts reach the end" in text and "the arm is cuspidal" in text
    assert text.count("dies at a singularity at 0.742996") == 4  # table and choice
    assert len(re.findall(r"<polyline", text)) == 3 * 4
    assert "http" not in re.sub(r"http-equiv|http://www.w3.org/\S+", "", text)


def test_the_page_of_postures_has_one_card_each() -> None:
    """Names from a file are escaped, and each posture has its aspect."""
    robot = cu.load("chablat-2022-3r")
    arm = traced_arm(robot.chain)
    pose = Pose((Fraction(5, 2), Fraction(0), Fraction(37, 100)))
    found = list_postures(arm, pose)
    record = postures_record(found, "<b>arm</b>", "arm.yaml")
    text = render_postures(record, postures_drawing(found))
    assert text.count("<canvas") == 4
    assert "<b>arm</b>" not in text and "&lt;b&gt;arm" in text
    assert text.count("aspect 1 ") == text.count("aspect 2 ") == 2


@pytest.mark.browser
@pytest.mark.parametrize(("size", "scheme"), [(DESK, "light"), (PHONE, "dark")])
def test_the_arm_moves_along_the_path(
    browser: Any, page: Path, size: dict[str, int], scheme: str
) -> None:
    """The page asks for nothing, meets no error, fits a phone, and draws the arm."""
    visit = browser.new_page(viewport=size, color_scheme=scheme)
    said, asked = [], []
    visit.on("console", lambda message: said.append(message.text))
    visit.on("pageerror", lambda error: said.append(str(error)))
    visit.on("request", lambda request: asked.append(request.url))
    visit.goto(page.as_uri())
    before = visit.evaluate("document.getElementById('arm').toDataURL()")
    visit.evaluate(
        "() => { const s = document.getElementById('along'); s.value = 500;"
        " s.dispatchEvent(new Event('input')); }"
    )
    after = visit.evaluate("document.getElementById('arm').toDataURL()")
    assert before != after
    assert visit.inner_text("#says").startswith("at 2.5")
    visit.select_option("#run", "2")
    assert visit.get_attribute("tr[data-run='2']", "class") == "chosen"
    assert visit.evaluate("document.documentElement.scrollWidth") <= size["width"]
    assert said == [] and [url for url in asked if not url.startswith("file:")] == []
    visit.close()
