"""The verdict within joint limits in words and rows, for the page."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from cuspaudit.viz.page_rows import VERDICTS, number, part

__all__ = [
    "CutRow",
    "LimitRow",
    "LimitWords",
    "cut_rows",
    "limit_rows",
    "limit_words",
]

Audit = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class LimitWords:
    """The verdict within limits as the page opens with it."""

    verdict: str
    headline: str
    why: str
    paths: str


@dataclass(frozen=True, slots=True)
class LimitRow:
    """One joint: its range, and where the shown path goes in it."""

    joint: str
    unit: str
    lower: str
    upper: str
    least: str
    most: str
    room: str


@dataclass(frozen=True, slots=True)
class CutRow:
    """What scaling one joint's range does."""

    joint: str
    least: str
    most: str


def limit_words(audit: Audit) -> LimitWords | None:
    """The verdict within limits beside the one without; None without limits."""
    limits = part(audit, "limits")
    if not limits:
        return None
    within = limits.get("verdict")
    within = within if within in VERDICTS else "undecided"
    free = audit.get("verdict")
    same = "as geometry and within its joint limits"
    headline = (
        f"{within} {same}"
        if within == free
        else f"{free} as geometry, {within} within its joint limits"
    )
    why = str(limits.get("why") or "")
    return LimitWords(within, headline, why[:1].upper() + why[1:], _of_paths(limits))


def _of_paths(limits: Audit) -> str:
    """What the paths within and without limits do with them."""
    path, inside = part(limits, "of_the_free_witness"), bool(limits.get("witness"))
    said = "The path shown stays inside them. " if inside else ""
    if path.get("inside") is False:
        shown = "" if inside else ", which is shown here,"
        said += f"The path without limits{shown} leaves them: {path.get('leaves')}."
    return said.strip()


def limit_rows(audit: Audit) -> list[LimitRow]:
    """A row for each joint; where a path is shown, how near it comes to a limit."""
    limits = part(audit, "limits")
    path = part(limits, "witness").get("path") or part(audit, "witness").get("path")
    kinds = part(audit, "robot").get("joint_types") or []
    rows = []
    for k, joint in enumerate(limits.get("joints") or []):
        turns = k >= len(kinds) or kinds[k] == "revolute"
        rows.append(_row(joint, [row[k] for row in path or []], turns))
    return rows


def cut_rows(audit: Audit) -> list[CutRow]:
    """A row for each joint whose range was scaled."""
    found = []
    for cut in part(audit, "limits").get("cuts") or []:
        least, most = cut.get("noncuspidal_to"), cut.get("cuspidal_from")
        found.append(CutRow(str(cut.get("joint")), _share(least), _share(most)))
    return found


def _share(scale: float | None) -> str:
    return "–" if scale is None else f"{100 * scale:.0f} %"


def _row(joint: Mapping[str, Any], column: Sequence[float], turns: bool) -> LimitRow:
    lower, upper = joint.get("lower"), joint.get("upper")  # both or none
    least, most = (min(column), max(column)) if column else (None, None)
    room = None
    if column and lower is not None and upper is not None:
        room = min(min(column) - lower, upper - max(column))
    values = [lower, upper, least, most, room]
    if turns:
        values = [None if v is None else math.degrees(v) for v in values]
    texts = [number(v, 4) for v in values]
    return LimitRow(str(joint.get("name")), "°" if turns else "", *texts)
