"""The pages of three audited arms: a 3R, a cobot whose meshes are missing, a UR5."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from drawn_arms import crx_urdf
from visits import PHONE, Visit, wait_until

from cuspaudit.cli.running import run_audit
from cuspaudit.pictures.page import page_text
from cuspaudit.robot.library import open_robot

pytestmark = [pytest.mark.browser, pytest.mark.slow]
ARMS = ("issac", "crx", "ur5")
SERIOUS = ("serious", "critical")


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The page of each audit, as ``cuspaudit audit --html`` writes it."""
    folder = tmp_path_factory.mktemp("audited")
    urdf = folder / "crx.urdf"
    urdf.write_text(crx_urdf(), "utf-8")
    sources = {"issac": "chablat-2022-3r", "crx": str(urdf), "ur5": "ur5_robot"}
    files = {}
    for name, source in sources.items():
        result = run_audit(open_robot(source), 0, None, "default")
        html = page_text(result.record(), result)
        files[name] = folder / f"{name}.html"
        files[name].write_text(html, "utf-8")
    return files


def audit_on(visit: Visit) -> Any:
    """The audit that the page offers as a download."""
    link = visit.page.get_attribute("a[download='audit.json']", "href")
    script = "async link => atob(link.split(',')[1])"
    return json.loads(visit.page.evaluate(script, link))


@pytest.mark.parametrize("name", ARMS)
def test_a_page_is_small_and_opens_at_once(
    browser: Any, pages: dict[str, Path], name: str
) -> None:
    """At most 5 MB, and the arm is drawn in under 3 s; the best of three is taken."""
    assert pages[name].stat().st_size < 5e6
    times = []
    for _ in range(3):
        visit = Visit(browser, pages[name])
        times.append(int(visit.page.get_attribute("html", "data-ready")))
        visit.close()
    assert min(times) < 3000


@pytest.mark.parametrize("name", ARMS)
def test_the_page_shows_its_audit(
    browser: Any, pages: dict[str, Path], name: str, output: Path
) -> None:
    """Verdict, strip, and the arm, which the slider moves; nothing goes wrong."""
    visit = Visit(browser, pages[name])
    page, audit = visit.page, audit_on(visit)
    assert page.inner_text(".verdict .word") == audit["verdict"]
    assert page.is_visible("#strip svg")
    first = visit.picture()
    assert len(np.unique(first.reshape(-1, 3), axis=0)) > 200
    visit.slide(0.5)
    assert (np.abs(first - visit.picture()).max(axis=2) > 24).mean() > 0.005
    assert page.is_visible("#play") == (audit["witness"] is not None)
    visit.keep(output / f"audited-{name}.png")
    visit.close()


@pytest.mark.parametrize("name", ["issac", "crx"])
def test_the_strip_keeps_off_zero_when_a_witness_is_shown(
    browser: Any, pages: dict[str, Path], name: str
) -> None:
    """Both ends hold the tool in one place, and the curve has one side of the line."""
    visit = Visit(browser, pages[name])
    page, audit = visit.page, audit_on(visit)
    if audit["witness"] is None:
        pytest.skip(f"the audit of {name} has no witness: {audit['verdict']}")
    heights = np.array(json.loads(page.inner_text("#heights")))
    zero = float(page.get_attribute(".zero", "y1"))
    assert abs(np.sign(heights - zero).sum()) == len(heights)
    for share, end in ((0.0, "A"), (1.0, "B")):
        visit.slide(share)
        said = page.inner_text("#status")
        assert said == f"Posture {end}: tool at the marked place"
    visit.close()


def test_missing_meshes_are_named(browser: Any, pages: dict[str, Path]) -> None:
    """A URDF without its meshes is drawn as tubes, and the page says so."""
    visit = Visit(browser, pages["crx"])
    assert "their meshes are not at hand" in visit.page.inner_text(".stage")
    visit.close()


def test_the_postures_of_one_pose_stand_side_by_side(
    browser: Any, pages: dict[str, Path]
) -> None:
    """Eight pictures of a UR5, all different, each in the colour of its aspect."""
    visit = Visit(browser, pages["ur5"])
    page = visit.page
    page.wait_for_selector("#gallery[data-ready]")
    sources = page.eval_on_selector_all("#gallery img", "all => all.map(i => i.src)")
    borders = page.eval_on_selector_all(
        "#gallery button", "all => all.map(b => b.style.borderColor)"
    )
    assert len(sources) == len(set(sources)) == len(set(borders)) == 8
    page.click("#gallery li:nth-child(5) button")
    assert page.input_value("#slider") == "4"
    assert page.inner_text("#status") == "Posture 5 of 8, aspect 5"
    visit.close()


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_phone_shows_all_of_it(
    browser: Any, pages: dict[str, Path], name: str, scheme: str, output: Path
) -> None:
    """At 375 pixels nothing sticks out, in the dark neither, and dark is dark."""
    visit = Visit(browser, pages[name], viewport=PHONE, color_scheme=scheme)
    assert visit.width() <= 375
    assert (visit.brightness() < 150) == (scheme == "dark")
    visit.keep(output / f"audited-{name}-phone-{scheme}.png")
    visit.close()


@pytest.mark.parametrize("name", ARMS)
def test_paper_gets_the_pictures(
    browser: Any, pages: dict[str, Path], name: str, output: Path
) -> None:
    """Printed, the page has a still of the arm and no buttons to press."""
    visit = Visit(browser, pages[name])
    visit.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    visit.page.emulate_media(media="print")
    width = "document.getElementById('still').naturalWidth"
    wait_until(visit.page, lambda: visit.page.evaluate(width) > 100)
    assert visit.page.is_visible("#still")
    assert not visit.page.is_visible("#reset")
    visit.keep(output / f"audited-{name}-print.png")
    visit.close()


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [375, 1280])
def test_axe_finds_no_serious_fault(
    browser: Any, pages: dict[str, Path], name: str, scheme: str, width: int
) -> None:
    """axe-core, in both schemes and on both widths, finds nothing serious."""
    viewport = {"width": width, "height": 800}
    visit = Visit(browser, pages[name], viewport=viewport, color_scheme=scheme)
    found = Axe().run(visit.page).response
    serious = [v for v in found["violations"] if v["impact"] in SERIOUS]
    assert len(found["passes"]) > 30
    assert [(v["id"], v["nodes"][0]["html"]) for v in serious] == []
    visit.close()
