"""The page of an arm with a locked joint: its verdicts as a ring, one file, offline.

The ring is drawn here, so that it is there without a script; the arm moves where
JavaScript may run. A value is at its angle, 0 to the right, counterclockwise as a joint
turns; a range of more than a turn goes on in a smaller ring.
"""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from cuspaudit.viz.offline import asset, environment, policy

__all__ = ["Arc", "arcs_of", "render_lock_page"]

_TURN = 2 * math.pi
_OUTER, _WIDTH, _STEP = 150.0, 34.0, 42.0
_TICKS = tuple(range(0, 360, 30))
_WORDS = {"cuspidal": "cuspidal", "noncuspidal": "noncuspidal", "undecided": "open"}


@dataclass(frozen=True)
class Arc:
    """A piece of a ring.

    Attributes:
        stretch: its number in the record.
        verdict: one of three.
        path: of its outline, in SVG's words; the centre is 0.
        label: what it says to who cannot see it.
    """

    stretch: int
    verdict: str
    path: str
    label: str


def render_lock_page(
    record: Mapping[str, Any], drawing: Sequence[Sequence[Any] | None]
) -> str:
    """The page.

    Args:
        record: schema ``cuspaudit/free/1``.
        drawing: from `pictures.lock_ring.lock_drawing`.
    """
    scripts = [asset("sticks.js"), asset("lock.js")]
    text = json.dumps(record, indent=1)
    return (
        environment()
        .get_template("lock.html")
        .render(
            record=record,
            word=_WORDS[record["verdict"]] if record["verdict"] != "undecided" else "",
            arcs=sorted(arcs_of(record), key=lambda arc: arc.verdict == "undecided"),
            rings=_rings(record),
            ticks=[(t, *_point(math.radians(t), _OUTER + 20)) for t in _TICKS],
            shares=_shares(record),
            rows=[_row(record, k) for k in range(len(record["stretches"]))],
            drawing=list(drawing),
            certificates=[_certificate(each) for each in record["stretches"]],
            data_link=_link(text),
            style=Markup(asset("page.css") + asset("lock.css")),
            scripts=[Markup(script) for script in scripts],
            policy=policy(scripts),
        )
    )


def arcs_of(record: Mapping[str, Any]) -> Iterator[Arc]:
    """The pieces of the rings, each within one turn."""
    start = record["domain"]["lower"]
    for k, each in enumerate(record["stretches"]):
        lower, upper = each["lower"], each["upper"]
        word = _WORDS[each["verdict"]]
        label = f"{_degrees(lower)} to {_degrees(upper)}: {word}"
        turn = math.floor((lower - start) / _TURN + 1e-9)
        while lower < upper:
            end = min(upper, start + (turn + 1) * _TURN)
            outer = _OUTER - turn * _STEP
            yield Arc(k, each["verdict"], _sector(lower, end, outer), label)
            lower, turn = end, turn + 1


def _sector(lower: float, upper: float, outer: float) -> str:
    """The outline of a piece of a ring; a whole ring is two halves."""
    if upper - lower > _TURN - 1e-6:
        middle = (lower + upper) / 2
        return f"{_sector(lower, middle, outer)} {_sector(middle, upper, outer)}"
    inner, wide = outer - _WIDTH, int(upper - lower > math.pi)
    a, b = _at(lower, outer), _at(upper, outer)
    c, d = _at(upper, inner), _at(lower, inner)
    return (
        f"M{a} A{outer:g} {outer:g} 0 {wide} 0 {b} L{c} "
        f"A{inner:g} {inner:g} 0 {wide} 1 {d} Z"
    )


def _at(angle: float, radius: float) -> str:
    x, y = _point(angle, radius)
    return f"{x:.3f} {y:.3f}"


def _point(angle: float, radius: float) -> tuple[float, float]:
    return round(radius * math.cos(angle), 3), round(-radius * math.sin(angle), 3)


def _rings(record: Mapping[str, Any]) -> list[float]:
    """The middle radius of each ring that is drawn on."""
    domain = record["domain"]
    count = math.ceil((domain["upper"] - domain["lower"]) / _TURN - 1e-6)
    return [_OUTER - _WIDTH / 2 - k * _STEP for k in range(max(1, count))]


def _shares(record: Mapping[str, Any]) -> list[tuple[str, str, str]]:
    """Verdict, word and degrees of each share that is not 0."""
    degrees = record["degrees"]
    found = []
    for verdict, word in _WORDS.items():
        share = degrees["open" if verdict == "undecided" else verdict]
        if share > 0:
            found.append((verdict, word, f"{share:.4g}°"))
    return found


def _row(record: Mapping[str, Any], k: int) -> dict[str, Any]:
    each = record["stretches"][k]
    return {
        "number": k,
        "verdict": each["verdict"],
        "word": _WORDS[each["verdict"]],
        "lower": _degrees(each["lower"]),
        "upper": _degrees(each["upper"]),
        "why": each["why"],
        "has_path": each["witness"] is not None,
    }


def _certificate(stretch: Mapping[str, Any]) -> str | None:
    """A link to the certificate of a stretch."""
    if stretch["witness"] is None:
        return None
    return _link(json.dumps(stretch["witness"]["certificate"]))


def _degrees(value: float) -> str:
    return f"{math.degrees(value) + 0.0:.5g}°"


def _link(text: str) -> str:
    return "data:application/json;base64," + base64.b64encode(text.encode()).decode()
