from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from visits import PHONE, Visit

from cuspaudit.auditing.audit import Options
from cuspaudit.pictures.landscape import picture_of
from cuspaudit.robot.library import open_robot
from cuspaudit.viz.plot.data import Landscape
from cuspaudit.viz.plot.files import save_plot
from cuspaudit.viz.plot.six_joints import landscape_sheet

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The figures of the paper's arm as a page."""
    path = tmp_path_factory.mktemp("plots") / "issac.html"
    drawn = picture_of(open_robot("chablat-2022-3r-mirror"), None, Options())
    save_plot(drawn, path)
    return path


@pytest.fixture(scope="module")
def landscape(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The landscape of a UR5 as a page."""
    path = tmp_path_factory.mktemp("plots") / "ur5.html"
    found = picture_of(open_robot("ur5"), None, Options())
    assert isinstance(found, Landscape)
    save_plot(landscape_sheet(found), path)
    return path


def point_at(visit: Visit, value: tuple[float, float]) -> str:
    """What is said when the pointer is at a value of the left plane."""
    box = visit.page.locator('#figure image[id^="cells-"]').bounding_box()
    window = visit.page.evaluate(
        "JSON.parse(document.getElementById('sheet').textContent).window"
    )
    across = (value[0] - window[0]) / (window[1] - window[0])
    down = (window[3] - value[1]) / (window[3] - window[2])
    visit.page.mouse.move(
        box["x"] + across * box["width"], box["y"] + down * box["height"]
    )
    return str(visit.page.inner_text("#says"))


def test_pointing_says_the_number_of_postures(
    browser: Any, page: Path, output: Path
) -> None:
    """The published values have 4 and 2 postures; beyond the curve there are none."""
    visit = Visit(browser, page)
    assert point_at(visit, (2.5, 0.5)).endswith("4 postures")
    assert point_at(visit, (1.0, 2.6)).endswith("2 postures")
    assert point_at(visit, (5.0, 3.0)).endswith("out of reach")
    visit.keep(output / "plot.png")
    visit.close()


def test_pointing_at_a_region_says_its_aspect(browser: Any, page: Path) -> None:
    """A region of the joint plane names its aspect and the sign of Delta."""
    visit = Visit(browser, page)
    region = visit.page.locator('#figure [id^="aspects-"]').first
    region.dispatch_event("pointermove", {"clientX": 900, "clientY": 400})
    assert visit.page.inner_text("#says").startswith("aspect 1, Delta")
    visit.close()


def test_layers_are_hidden_and_shown_again(browser: Any, page: Path) -> None:
    """Each box of the page hides the marks of its layer and no others."""
    visit = Visit(browser, page)
    mark, other = '[id^="samples-"]', '[id^="special-"]'
    assert visit.page.locator(mark).first.is_visible()
    visit.page.uncheck("#show-samples")
    assert not visit.page.locator(mark).first.is_visible()
    assert visit.page.locator(other).first.is_visible()
    visit.page.check("#show-samples")
    assert visit.page.locator(mark).first.is_visible()
    visit.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_phone_in_the_dark_shows_it_too(
    browser: Any, page: Path, scheme: str, output: Path
) -> None:
    """Nothing sticks out, dark is dark, and axe-core finds nothing serious."""
    visit = Visit(browser, page, viewport=PHONE, color_scheme=scheme)
    assert visit.width() <= 375
    assert (visit.brightness() < 150) == (scheme == "dark")
    found = Axe().run(visit.page).response["violations"]
    assert [v["id"] for v in found if v["impact"] in ("serious", "critical")] == []
    visit.keep(output / f"plot-phone-{scheme}.png")
    visit.close()


def test_a_landscape_is_read_and_dimmed_like_the_figures(
    browser: Any, landscape: Path, output: Path
) -> None:
    """A maximum says its level, layers can be hidden, axe-core has no complaint."""
    visit = Visit(browser, landscape, color_scheme="dark")
    maximum = visit.page.locator('#figure [id^="maxima-"]').first
    maximum.dispatch_event("pointermove", {"clientX": 100, "clientY": 300})
    assert visit.page.inner_text("#says").startswith("maximum of |det J|: 1.0000")
    visit.page.uncheck("#show-maxima")
    assert not maximum.is_visible()
    visit.page.check("#show-maxima")
    found = Axe().run(visit.page).response["violations"]
    assert [v["id"] for v in found if v["impact"] in ("serious", "critical")] == []
    visit.keep(output / "landscape-dark.png")
    visit.close()
