"""A page opened in headless Chromium, watched for errors and requests."""

from __future__ import annotations

import io
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

FLAGS = [
    *("--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader"),
    *("--enable-unsafe-swiftshader", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--disable-quic"),
    "--no-first-run",
]
SET_SLIDER = """share => {
    const slider = document.getElementById("slider");
    slider.value = Math.round(share * slider.max);
    slider.dispatchEvent(new Event("input"));
    return new Promise(done => requestAnimationFrame(() =>
        requestAnimationFrame(() => requestAnimationFrame(done))));
}"""
GROUND = "getComputedStyle(document.body).backgroundColor"
PHONE = {"width": 375, "height": 720}
DESK = {"width": 1280, "height": 900}


def chromium() -> str:
    """Where Chromium is; without it the test is skipped, and says so."""
    found = os.environ.get("CUSPAUDIT_CHROMIUM") or shutil.which("chromium")
    if not found:
        pytest.skip("no chromium: apt-get install chromium, or set CUSPAUDIT_CHROMIUM")
    return found


def wait_until(page: Any, holds: Callable[[], bool]) -> None:
    """Wait up to 20 s; playwright's own waiting is refused by the page's policy."""
    for _ in range(200):
        if holds():
            return
        page.wait_for_timeout(100)
    pytest.fail("waited in vain")


class Visit:
    """A page opened in the browser, with what went wrong on it.

    Attributes:
        faults: what the console said, and each request that leaves the file.
    """

    def __init__(
        self, browser: Any, file: Path, ready: str = "html[data-ready]", **options: Any
    ) -> None:
        options = {"reduced_motion": "reduce", "viewport": DESK, **options}
        self.context = browser.new_context(**options)
        self.page = self.context.new_page()
        self.faults: list[str] = []
        self.page.on("console", self._heard)
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("dialog", lambda dialog: self.faults.append(dialog.message))
        self.page.on("request", self._asked)
        self.page.goto(file.as_uri())
        self.page.wait_for_selector(ready)

    def _heard(self, message: Any) -> None:
        # the software renderer grumbles about the speed of our own screenshots
        if message.type == "error" or "GPU stall" not in message.text:
            self.faults.append(message.text)

    def _asked(self, request: Any) -> None:
        if not request.url.startswith(("file:", "data:", "blob:")):
            self.faults.append(request.url)

    def picture(self) -> Any:
        """The canvas as (height, width, 3) numbers."""
        blob = self.page.locator("#pane canvas").screenshot()
        return np.asarray(Image.open(io.BytesIO(blob)).convert("RGB")).astype(int)

    def slide(self, share: float) -> None:
        """Move the slider, and wait until the arm is drawn."""
        self.page.evaluate(SET_SLIDER, share)

    def brightness(self) -> int:
        """Of the page's ground: 0 black to 765 white."""
        ground = self.page.evaluate(GROUND)
        return sum(int(x) for x in ground[4:-1].split(","))

    def width(self) -> int:
        """How wide the page is with all that sticks out."""
        return int(self.page.evaluate("document.documentElement.scrollWidth"))

    def keep(self, file: Path) -> None:
        """Write a screenshot of the whole page."""
        self.page.screenshot(path=str(file), full_page=True)

    def close(self) -> None:
        """Hold that nothing went wrong, and leave."""
        assert self.faults == []
        self.context.close()
