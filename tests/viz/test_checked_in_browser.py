"""The page checks its certificate itself, in headless Chromium from file://."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from drawn_arms import audit_of, issac_chain, issac_path
from visits import Visit, wait_until

from cuspaudit.viz import build_scene, render_page, sample_path

pytestmark = pytest.mark.browser

TRUE = Path(__file__).parents[2] / "certificates" / "accepted"


def opened(browser: Any, file: Path, certificate: str, *, scene: bool = True) -> Visit:
    """The page with a certificate, once it has given its answer."""
    chain = issac_chain()
    path = issac_path(chain)
    drawn = build_scene(chain, sample_path(chain, path)) if scene else None
    audit = audit_of(chain, "cuspidal", path)
    file.write_text(render_page(audit, drawn, certificate=certificate))
    visit = Visit(browser, file, "html[data-ready]" if scene else "#checked")
    found = "document.getElementById('checked').dataset.checked || ''"
    wait_until(visit.page, lambda: bool(visit.page.evaluate(found)))
    return visit


@pytest.mark.parametrize("name", ["issac-path", "crx-path", "universal-structure"])
def test_a_true_certificate_is_accepted(
    browser: Any, tmp_path: Path, name: str, output: Path
) -> None:
    """Checked when the page is opened, and the time it took stands there."""
    text = (TRUE / f"{name}.json").read_text()
    visit = opened(browser, tmp_path / "page.html", text, scene=name == "issac-path")
    said = visit.page.inner_text("#checked")
    assert said.startswith("accepted")
    assert "checked in your browser just now" in said
    assert said.endswith(" ms.")
    visit.page.locator("#checked").scroll_into_view_if_needed()
    visit.keep(output / f"checked-{name}.png")
    visit.close()


@pytest.mark.parametrize("old", ['"sign": 1', '"-0.742"', '"kind": "path"'])
def test_a_false_certificate_is_rejected_aloud(
    browser: Any, tmp_path: Path, old: str
) -> None:
    """The other sign, another posture, another kind: the reader is told not to rely."""
    text = (TRUE / "issac-path.json").read_text()
    new = {'"sign": 1': '"sign": -1', '"-0.742"': '"-0.741"'}.get(old, '"kind": "x"')
    visit = opened(browser, tmp_path / "page.html", text.replace(old, new, 1))
    said = visit.page.inner_text("#checked")
    assert said.startswith("REJECTED")
    assert "do not rely on the verdict" in said
    visit.close()


def test_what_a_certificate_says_is_text(browser: Any, tmp_path: Path) -> None:
    """A key with markup in it is shown as it stands, and runs nothing."""
    evil = '{"<img src=x onerror=alert(1)>": 1, "schema": 3}'
    visit = opened(browser, tmp_path / "page.html", evil)
    assert visit.page.inner_text("#checked").startswith("REJECTED")
    assert visit.page.locator("#checked img").count() == 0
    visit.close()
