"""What an audit says of a tolerance, in one line, for the terminal and the page."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

__all__ = ["tolerance_words"]


def tolerance_words(entry: Mapping[str, Any] | None, unit: str) -> str | None:
    """The key ``tolerance`` of an audit in words; None where none was asked for.

    >>> box = {"lengths": 1e-4, "angles": 1e-4}
    >>> tolerance_words({**box, "verdict": "undecided", "why": "not proved"}, "m")
    'undecided within 0.0001 m and 0.0001 rad: not proved'
    """
    if not entry:
        return None
    numbers = entry.get("numbers")
    about = [_box(entry, unit)] if entry["lengths"] or entry["angles"] else []
    if numbers:
        about.append(", ".join(f"{n['where']} +- {n['within']:.3g}" for n in numbers))
    said = [f"{entry.get('verdict')} within {', '.join(about)}: {entry.get('why')}"]
    for key, words in (("largest", "proved up to"), ("fails", "this proof fails at")):
        if entry.get(key):
            box = entry[key]
            times = f"{box['factor']:.3g} times that"
            said.append(f"{words} {times if numbers else _box(box, unit)}")
    worst = entry.get("sensitive")
    if worst:
        along = "about" if worst["kind"] == "turn" else "along"
        off = "rad" if worst["kind"] == "turn" else unit
        said.append(
            f"most sensitive: a {worst['kind']} of {worst['where']} {along} "
            f"{worst['direction']}, alone proved up to {worst['largest']:.3g} {off}"
        )
    return "; ".join(said)


def _box(entry: Mapping[str, Any], unit: str) -> str:
    return f"{entry['lengths']:.3g} {unit} and {entry['angles']:.3g} rad"
