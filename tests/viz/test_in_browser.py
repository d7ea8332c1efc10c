"""The page in headless Chromium, from file://, watched for errors and requests."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from drawn_arms import (
    CRX_COUPLE,
    audit_of,
    crx_chain,
    issac_chain,
    issac_path,
    slider_chain,
)
from visits import PHONE, Visit, wait_until

from cuspaudit.viz import build_scene, render_page, sample_path, sample_postures

pytestmark = pytest.mark.browser
CURSOR = """() => parseFloat(document.getElementById("cursor").style.left)"""


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """One page a kind: a path of a 3R, of a 6R, postures only, and no scene."""
    issac, crx, slider = (
        issac_chain("<script>alert(1)</script>"),
        crx_chain(),
        slider_chain(),
    )
    path = issac_path(issac)
    couple = [list(posture) for posture in CRX_COUPLE]
    single = [[0.0, 0.0, 100.0], [1.0, 200.0, 300.0], [2.0, 50.0, -150.0]]
    rendered = {
        "issac": render_page(
            audit_of(issac, "cuspidal", path),
            build_scene(issac, sample_path(issac, path)),
            certificate="{}",
        ),
        "crx": render_page(
            audit_of(crx, "cuspidal", couple),
            build_scene(crx, sample_path(crx, couple)),
        ),
        "slider": render_page(
            audit_of(slider, "noncuspidal", None),
            build_scene(slider, sample_postures(slider, single)),
        ),
        "none": render_page(audit_of(crx, "undecided", None)),
    }
    folder = tmp_path_factory.mktemp("pages")
    files = {name: folder / f"{name}.html" for name in rendered}
    for name, html in rendered.items():
        files[name].write_text(html, "utf-8")
    return files


@pytest.mark.parametrize("name", ["issac", "crx", "slider"])
def test_the_arm_is_drawn_and_moves(
    browser: Any, pages: dict[str, Path], name: str, output: Path
) -> None:
    """The canvas is not blank, the slider moves arm and cursor, nothing goes wrong."""
    visit = Visit(browser, pages[name])
    visit.slide(0.0)
    first, cursor = visit.picture(), visit.page.evaluate(CURSOR)
    assert len(np.unique(first.reshape(-1, 3), axis=0)) > 200
    visit.keep(output / f"{name}-start.png")
    visit.slide(0.5)
    middle = visit.picture()
    changed = np.abs(first - middle).max(axis=2) > 24
    assert changed.mean() > 0.005
    assert visit.page.evaluate(CURSOR) > cursor + 30
    visit.keep(output / f"{name}-middle.png")
    visit.slide(1.0)
    visit.keep(output / f"{name}-end.png")
    visit.close()


@pytest.mark.parametrize("name", ["issac", "crx"])
def test_both_ends_hold_the_tool_in_one_place(
    browser: Any, pages: dict[str, Path], name: str
) -> None:
    """The page says that the tool is at the marked place at A and B, not between."""
    visit = Visit(browser, pages[name])
    said = []
    for share in (0.0, 0.5, 1.0):
        visit.slide(share)
        said.append(visit.page.inner_text("#status"))
    assert said[0] == "Posture A: tool at the marked place"
    assert said[1].startswith("On the way: tool ")
    assert said[2] == "Posture B: tool at the marked place"
    visit.close()


def test_play_moves_and_pause_stops(browser: Any, pages: dict[str, Path]) -> None:
    """The button plays, the slider and the table follow, the button pauses."""
    visit = Visit(browser, pages["issac"])
    page = visit.page
    before = page.inner_text("#joints .nowvalue >> nth=1")
    page.click("#play")
    wait_until(page, lambda: int(page.input_value("#slider")) > 30)
    page.click("#play")
    held = page.input_value("#slider")
    page.wait_for_timeout(300)
    assert page.input_value("#slider") == held
    assert page.inner_text("#joints .nowvalue >> nth=1") != before
    visit.close()


def test_it_plays_by_itself_unless_motion_is_unwanted(
    browser: Any, pages: dict[str, Path]
) -> None:
    """The animation starts alone, and not for who asked for less motion."""
    small = {"width": 420, "height": 320}
    still = Visit(browser, pages["issac"], viewport=small)
    moving = Visit(
        browser, pages["issac"], viewport=small, reduced_motion="no-preference"
    )
    assert moving.page.inner_text("#play") == "Pause"
    assert still.page.inner_text("#play") == "Play"
    moving.page.click("#play")
    moving.close()
    still.close()


def test_dark_is_dark(browser: Any, pages: dict[str, Path], output: Path) -> None:
    """With a dark system the page is dark and the arm still drawn."""
    visit = Visit(browser, pages["issac"], color_scheme="dark")
    visit.slide(0.3)
    assert visit.brightness() < 150
    assert len(np.unique(visit.picture().reshape(-1, 3), axis=0)) > 200
    visit.keep(output / "issac-dark.png")
    visit.close()


@pytest.mark.parametrize("name", ["issac", "crx", "slider", "none"])
def test_a_phone_needs_no_sideways_scrolling(
    browser: Any, pages: dict[str, Path], name: str, output: Path
) -> None:
    """At 375 pixels nothing sticks out."""
    ready = "footer" if name == "none" else "html[data-ready]"
    visit = Visit(browser, pages[name], ready, viewport=PHONE)
    assert visit.width() <= 375
    visit.keep(output / f"{name}-phone.png")
    visit.close()


def test_paper_gets_a_picture(
    browser: Any, pages: dict[str, Path], output: Path
) -> None:
    """Printing puts a still of the arm in the canvas's place."""
    visit = Visit(browser, pages["crx"])
    visit.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    visit.page.emulate_media(media="print")
    width = "document.getElementById('still').naturalWidth"
    wait_until(visit.page, lambda: visit.page.evaluate(width) > 100)
    assert visit.page.is_visible("#still")
    assert not visit.page.is_visible("#play")
    visit.keep(output / "crx-print.png")
    visit.close()


def test_without_webgl_the_numbers_still_follow(
    browser: Any, pages: dict[str, Path]
) -> None:
    """A browser that cannot draw says so, and table and strip work."""
    visit = Visit(browser, pages["none"], "footer")
    visit.page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    visit.page.goto(pages["issac"].as_uri())
    visit.page.wait_for_selector("html[data-ready]")
    assert visit.page.is_visible("#failure")
    visit.slide(1.0)
    assert visit.page.evaluate(CURSOR) == 100
    visit.faults.clear()  # three.js complains, rightly
    visit.close()
