"""What the site is made of besides its pages: pictures, and the texts of the root."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
ROBOTS = ("baili-2004-wt8", "fanuc-crx-10ia-l")


def on_pre_build(config: Any) -> None:
    """Draw what the gallery shows; a picture that is there is kept."""
    del config
    pictures = HERE / "pictures"
    pictures.mkdir(exist_ok=True)
    shutil.copy(HERE.parent / "families" / "orthogonal-3r.png", pictures)
    for robot in ROBOTS:
        picture = pictures / f"{robot}.png"
        if not picture.exists():
            command = [sys.executable, "-m", "cuspaudit", "plot", robot]
            subprocess.run([*command, "-o", str(picture)], check=True, timeout=600)


def on_page_markdown(markdown: str, **rest: Any) -> str:
    """The text of a page; one that names a text of the root is that text."""
    del rest
    name, _, more = markdown.strip().partition("\n")
    if more or not name.startswith("include "):
        return markdown
    text = (HERE.parent / name.removeprefix("include ")).read_text("utf-8")
    return text.replace("](docs/", "](")
