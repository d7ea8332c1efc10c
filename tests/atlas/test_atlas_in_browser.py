"""The atlas in headless Chromium, from file://, watched for errors and requests."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "viz"))

from visits import Visit, wait_until

from cuspaudit.atlas.site import build_site

pytestmark = pytest.mark.browser

NAMES = ["adept-cobra-600", "anthropomorphic-offset", "baili-2004-wt8", "puma-560-arm"]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Five arms, one of them cuspidal."""
    folder = tmp_path_factory.mktemp("atlas")
    build_site([*NAMES, "chablat-2022-3r"], folder, timeout=20)
    return folder


def shown(visit: Visit) -> list[str]:
    """The arms that are to be seen, in their order."""
    return [
        row.get_attribute("id")
        for row in visit.page.locator("#arms tbody tr").all()
        if row.is_visible()
    ]


@pytest.fixture(scope="module")
def browser() -> Any:
    """A browser, as the pages of audits are tested with."""
    from playwright.sync_api import sync_playwright
    from visits import FLAGS, chromium

    with sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=chromium(), args=FLAGS)
        yield launched
        launched.close()


def test_the_table_is_searched_filtered_and_sorted(
    browser: Any, site: Path, output: Path
) -> None:
    """Words, choices and the heads of columns do what they say."""
    visit = Visit(browser, site / "index.html")
    page = visit.page
    assert len(shown(visit)) == 5
    page.fill("#search", "offset")
    assert shown(visit) == ["anthropomorphic-offset"]
    assert page.inner_text("#shown") == "1 arm"
    page.fill("#search", "")
    page.select_option("#verdict", "cuspidal")
    assert shown(visit) == ["chablat-2022-3r"]
    page.select_option("#verdict", "")
    page.click("[data-sort=joints]")
    assert shown(visit)[-1] == "adept-cobra-600"
    page.click("[data-sort=joints]")
    assert shown(visit)[0] == "adept-cobra-600"
    page.click("[data-sort=clearance]")
    assert shown(visit)[0] == "chablat-2022-3r", "arms without a number come last"
    visit.keep(output / "atlas.png")
    page.check("#cards")
    assert len(shown(visit)) == 5
    visit.keep(output / "atlas-cards.png")
    visit.close()


def test_an_arm_leads_to_its_page_which_checks_its_proof(
    browser: Any, site: Path
) -> None:
    """From the table to the page, where the browser proves the verdict again."""
    visit = Visit(browser, site / "index.html")
    visit.page.click("th a[href='arms/puma-560-arm.html']")
    found = (
        "(document.getElementById('checked') || {dataset: {}}).dataset.checked || ''"
    )
    wait_until(visit.page, lambda: visit.page.evaluate(found) == "yes")
    assert "accepted" in visit.page.inner_text("#checked")
    visit.close()
