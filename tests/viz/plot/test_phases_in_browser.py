from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from visits import Visit, wait_until

from cuspaudit.viz.plot.phase import draw_phases, phase_page

pytestmark = pytest.mark.browser

ROWS = [
    {"index": k, "a": k / 4, "b": (k * k) % 3, "verdict": verdict, "error": None}
    for k, verdict in enumerate(("cuspidal", "noncuspidal", "cuspidal"))
]


@pytest.fixture
def page(tmp_path: Path) -> Path:
    """A map of three members, the first of them audited."""
    (tmp_path / "0.html").write_text("<html data-ready><title>the audit</title></html>")
    svg = draw_phases(ROWS, "a", "b", "verdict", "svg")
    files = {k: f"name: arm-{k} <b>\\n" for k in range(3)}
    file = tmp_path / "map.html"
    file.write_text(phase_page(svg, "arms", files, {0: "0.html"}, "plot out"))
    return file


def test_a_member_opens_its_audit(browser: Any, page: Path) -> None:
    """A click on an audited member leads to the page of its audit."""
    visit = Visit(browser, page)
    visit.page.locator("#member-0").click()
    wait_until(visit.page, lambda: visit.page.title() == "the audit")
    visit.close()


def test_a_member_without_audit_says_how_to_make_it(
    browser: Any, page: Path, output: Path
) -> None:
    """A member chosen by key shows its file, to keep, and the command of its audit."""
    visit = Visit(browser, page)
    visit.page.locator("#member-2").focus()
    visit.page.keyboard.press("Enter")
    assert visit.page.inner_text("#command") == "plot out --audit 2"
    assert "arm-2 <b>" in visit.page.inner_text("#text")
    assert visit.page.get_attribute("#file", "download") == "member-2.yaml"
    visit.keep(output / "phases.png")
    visit.close()
