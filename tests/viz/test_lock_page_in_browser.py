"""The page of a locked joint in a browser: the ring chooses what the arm shows."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from visits import DESK, PHONE, Visit

from cuspaudit.viz.lock_page import render_lock_page

pytestmark = [pytest.mark.browser, pytest.mark.slow]

FRAMES = [
    [[0, 0, 0], [0, 0, 1], [math.cos(k / 9), math.sin(k / 9), 1]] for k in range(41)
]


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page with two intervals that have a path and one that is open."""
    cuts = [-math.pi, -1.0, 1.0, math.pi]
    words = ("cuspidal", "undecided", "cuspidal")
    stretches = [
        {
            "lower": a,
            "upper": b,
            "verdict": word,
            "proof": "path" if word == "cuspidal" else "none",
            "why": "a path" if word == "cuspidal" else "nothing was met",
            "witness": {"certificate": {"n": a}} if word == "cuspidal" else None,
        }
        for a, b, word in zip(cuts, cuts[1:], words, strict=False)
    ]
    record = {
        "robot": {"name": "arm", "joints": ["a", "b"], "task": "pose"},
        "joint": "b",
        "within_limits": False,
        "domain": {"lower": cuts[0], "upper": cuts[-1]},
        "verdict": "cuspidal",
        "why": "of 360 deg of b: cuspidal 245 deg, open 115 deg",
        "degrees": {"cuspidal": 245.4, "noncuspidal": 0.0, "open": 114.6},
        "stretches": stretches,
        "stopped": None,
    }
    file = tmp_path_factory.mktemp("lock") / "lock.html"
    file.write_text(render_lock_page(record, [FRAMES, None, FRAMES]), "utf-8")
    return file


@pytest.mark.parametrize("size", [PHONE, DESK], ids=["phone", "desk"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_ring_chooses_the_witness(
    browser: Any, page: Path, size: dict[str, int], scheme: str
) -> None:
    """A click on an arc or its key shows the interval; an open one has no arm."""
    visit = Visit(browser, page, "svg .arc", viewport=size, color_scheme=scheme)
    shown = visit.page
    assert shown.is_visible("#arm")
    shown.click("tr[data-stretch='2'] button")
    assert shown.inner_text("#said").startswith("57.296° to 180°: cuspidal")
    assert shown.get_attribute("#proof", "href").startswith("data:application/json")
    shown.focus(".arc.undecided")
    shown.keyboard.press("Enter")
    assert not shown.is_visible("#arm")
    assert "open" in shown.inner_text("#said")
    wide = shown.evaluate("document.documentElement.scrollWidth - innerWidth")
    assert wide <= 0
    serious = [
        rule
        for rule in Axe().run(shown).response["violations"]
        if rule["impact"] in ("serious", "critical")
    ]
    assert serious == []
    assert visit.faults == []
    visit.close()
