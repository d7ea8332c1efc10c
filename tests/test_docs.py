"""The documentation is whole: what is public has a page, each link leads somewhere."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import yaml

import cuspaudit

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
TEXTS = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]


def listed(entry: object) -> list[str]:
    """The pages of a part of the site's navigation."""
    if isinstance(entry, str):
        return [entry]
    parts = entry.values() if isinstance(entry, dict) else entry
    assert isinstance(parts, list) or not isinstance(parts, str)
    return [page for part in parts for page in listed(part)]  # type: ignore[union-attr]


def test_every_page_is_in_the_navigation() -> None:
    """No page is written and not found, and none is listed twice."""
    text = (ROOT / "mkdocs.yml").read_text("utf-8")
    pages = listed(yaml.safe_load(text)["nav"])
    assert sorted(pages) == sorted(path.name for path in DOCS.glob("*.md"))


def test_every_public_name_has_its_page() -> None:
    """`docs/python.md` or `docs/results.md` shows each name of the package."""
    text = "".join((DOCS / f"{page}.md").read_text() for page in ("python", "results"))
    for name in set(cuspaudit.__all__) - {"__version__"}:
        assert re.search(rf"\b{name}\b", text), name


@pytest.mark.parametrize("path", [*TEXTS, *DOCS.glob("*.md")], ids=lambda p: p.name)
def test_every_link_to_a_file_leads_somewhere(path: Path) -> None:
    """Links between the texts of the repository; pictures of the gallery are made."""
    text = re.sub(r"```.*?```|`[^`]*`", "", path.read_text("utf-8"), flags=re.DOTALL)
    for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", text):
        if not target.startswith(("http", "pictures/")):
            assert (path.parent / target).exists(), f"{path.name} links {target}"


def test_the_readme_is_one_screen() -> None:
    """What it is, a picture, how to install and three commands; the rest is linked."""
    assert len((ROOT / "README.md").read_text("utf-8").splitlines()) < 60


def test_one_version_everywhere() -> None:
    """The package, the citation and the changes agree."""
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert citation["version"] == cuspaudit.__version__
    assert f"## {cuspaudit.__version__}" in (ROOT / "CHANGELOG.md").read_text("utf-8")
