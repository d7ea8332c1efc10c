"""What docstrings cite stands in the repository."""

from __future__ import annotations

import re
from pathlib import Path

import cuspaudit

ROOT = Path(cuspaudit.__file__).parents[1]
CITED = re.compile(r"\[(mathematics|facts)(?:\s+([\d., \n]+))?(?:,\s+erratum\s+(\d+))?")


def citations() -> set[tuple[str, str]]:
    """(page, number of the section or erratum) of all citations, "" for a page."""
    found = set()
    for folder in ("cuspaudit", "tests"):
        for file in (ROOT / folder).rglob("*.py"):
            if file == Path(__file__):
                continue
            for page, sections, erratum in CITED.findall(file.read_text()):
                numbers = re.findall(r"\d+(?:\.\d+)?", sections) or [erratum]
                found |= {(page, number) for number in numbers}
    return found


def test_cited_sections_and_errata_exist() -> None:
    """Each section of the mathematics and each erratum that is cited is there."""
    mathematics, facts = (
        (ROOT / "docs" / f"{page}.md").read_text() for page in ("mathematics", "facts")
    )
    sections = set(re.findall(r"^##+ (\d+(?:\.\d+)?)\.? ", mathematics, re.MULTILINE))
    errata = set(re.findall(r"^(\d+)\. ", facts, re.MULTILINE))
    known = {"mathematics": sections | {""}, "facts": errata | {""}}
    cited = citations()
    assert len(cited) > 8
    assert [c for c in sorted(cited) if c[1] not in known[c[0]]] == []
