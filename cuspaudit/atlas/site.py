"""The site: what is kept of an earlier build, what is made anew, and the table of all.

::

    SITE/index.html                  the table, cards, search
    SITE/atlas.json                  its lines, for programs and for the next build
    SITE/arms/NAME.html, NAME.json   the audit's page, and the audit
    SITE/certificates/NAME.json      its certificate, where it has one

No time and no path of this machine goes into a file: the same robots give the same
site. A file that a run did not finish is not there, and the next run makes it.
"""

from __future__ import annotations

import json
import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from cuspaudit.atlas.arm import AtlasArm, Made, arm_key
from cuspaudit.atlas.entry import Entry
from cuspaudit.atlas.index import index_html
from cuspaudit.atlas.workers import made_here, made_on_cluster
from cuspaudit.errors import InvalidInputError
from cuspaudit.robot.library import library
from cuspaudit.runtime.writing import write_text

__all__ = ["Built", "build_site"]

SCHEMA = "cuspaudit/atlas/1"
Report = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Built:
    """What a build did.

    Attributes:
        entries: all lines of the table, by slug.
        made: how many robots were audited anew; one may have several arms.
    """

    entries: Sequence[Entry]
    made: int


def build_site(
    sources: Sequence[str],
    site: Path,
    *,
    title: str = "Atlas of robot arms",
    workers: int = 1,
    scheduler: str | None = None,
    timeout: float | None = 60.0,
    seed: int = 0,
    report: Report = lambda done, all_, name: None,
) -> Built:
    """Build, or bring up to date, the site of these robots.

    Args:
        sources: robot files, and names of the library.
        site: the folder; made if it is not there.
        title: of the table.
        workers: processes of this machine.
        scheduler: address of a Dask cluster that works instead.
        timeout: seconds after which no further step of an audit begins.
        seed: of every random choice.
        report: called when a robot is: how many are, of how many, and its name.

    Raises:
        InvalidInputError: no robot, or the folder holds something else.
    """
    if not sources:
        raise InvalidInputError(
            file=str(site), found="no robot", expected="name files or folders of robots"
        )
    kept = _kept(site)
    arms = [
        AtlasArm(source, slug, timeout, seed)
        for source, slug in zip(sources, _slugs(sources), strict=True)
    ]
    keys = {arm.slug: arm_key(arm, _content(arm.source)) for arm in arms}
    whole = {
        arm.slug: kept[arm.slug]
        for arm in arms
        if all(_is_whole(site, entry, keys[arm.slug]) for entry in kept[arm.slug])
    }
    work = [(arm, keys[arm.slug]) for arm in arms if not whole.get(arm.slug)]
    entries = [entry for group in whole.values() for entry in group]
    made = made_on_cluster(work, scheduler) if scheduler else made_here(work, workers)
    for count, group in enumerate(made, 1):
        for each in group:
            _write_arm(site, each)
        entries += [each.entry for each in group]
        _write_table(site, title, entries)
        report(count, len(work), group[0].entry.group)
    entries.sort(key=lambda entry: entry.slug)
    _write_table(site, title, entries)
    _clear(site, {entry.slug for entry in entries})
    return Built(entries, len(work))


def _slugs(sources: Iterable[str]) -> list[str]:
    """A name for each source, of letters, digits and -, no two alike."""
    found: list[str] = []
    for source in sources:
        stem = Path(source).stem if Path(source).suffix else source
        plain = re.sub(r"[^a-z0-9]+", "-", stem.lower()).strip("-") or "arm"
        slug, number = plain, 1
        while slug in found:
            number += 1
            slug = f"{plain}-{number}"
        found.append(slug)
    return found


def _content(source: str) -> bytes:
    path = Path(source)
    if not path.is_file():
        path = dict(library()).get(source, path)
    return path.read_bytes() if path.is_file() else b""


def _kept(site: Path) -> dict[str, list[Entry]]:
    """The lines of the last build by robot, none if there was none.

    Raises:
        InvalidInputError: the folder holds files, and not those of an atlas.
    """
    table = site / "atlas.json"
    if not table.is_file():
        if site.is_dir() and any(site.iterdir()):
            raise InvalidInputError(
                file=str(site),
                found="files that are not of an atlas",
                expected="name an empty or a new folder",
            )
        return defaultdict(list)
    found: dict[str, list[Entry]] = defaultdict(list)
    try:
        for row in json.loads(table.read_text("utf-8"))["arms"]:
            found[row["group"]].append(Entry(**row))
    except (ValueError, KeyError, TypeError):
        return defaultdict(list)  # of another version, or damaged: made again
    return found


def _is_whole(site: Path, entry: Entry, key: str) -> bool:
    """Whether the entry is of this key, and all of its files are there."""
    if entry.key != key:
        return False
    files = [] if entry.error else [site / "arms" / f"{entry.slug}.html"]
    if entry.certificate:
        files.append(site / "certificates" / f"{entry.slug}.json")
    return all(file.is_file() for file in files)


def _write_arm(site: Path, made: Made) -> None:
    slug = made.entry.slug
    for folder, name, text in (
        ("arms", f"{slug}.html", made.page),
        ("arms", f"{slug}.json", made.record),
        ("certificates", f"{slug}.json", made.certificate),
    ):
        if text:
            (site / folder).mkdir(parents=True, exist_ok=True)
            write_text(site / folder / name, text)


def _write_table(site: Path, title: str, entries: Iterable[Entry]) -> None:
    ordered = sorted(entries, key=lambda entry: entry.slug)
    rows = [asdict(entry) for entry in ordered]
    text = json.dumps({"schema": SCHEMA, "arms": rows}, indent=1, allow_nan=False)
    site.mkdir(parents=True, exist_ok=True)
    write_text(site / "atlas.json", text + "\n")
    write_text(site / "index.html", index_html(title, ordered))


def _clear(site: Path, slugs: set[str]) -> None:
    """Remove the files of arms that are no longer asked for."""
    for folder in ("arms", "certificates"):
        for file in sorted((site / folder).glob("*")):
            if file.suffix in (".html", ".json") and file.stem not in slugs:
                file.unlink()
