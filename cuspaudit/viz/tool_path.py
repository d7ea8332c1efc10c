"""The pages of a traced tool path and of the postures of a pose: one file, offline.

The curves are drawn here, so that they are there without a script; the arm moves where
JavaScript may run. What the records do not call proved is not called proved.
"""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from cuspaudit.viz.offline import asset, environment, policy

__all__ = ["render_postures", "render_trace"]

_WIDE, _HIGH = 1000.0, 120.0
_DEGREES = 180 / math.pi
_SIGNS = {1: "plus", -1: "minus"}


@dataclass(frozen=True)
class RunCurve:
    """A run in one panel.

    Attributes:
        points: of its polyline.
        sign: "plus", "minus" or "none".
        run: its number.
        end: "reached", "singular", "limit" or "undecided".
        x: where it ends.
        y: likewise.
    """

    points: str
    sign: str
    run: int
    end: str
    x: float
    y: float


@dataclass(frozen=True)
class Panel:
    """A joint against the parameter of the path.

    Attributes:
        name: of the joint.
        low: the text of the lowest value drawn.
        high: of the highest.
        curves: the runs.
        limits: heights of the limits that lie inside.
    """

    name: str
    low: str
    high: str
    curves: tuple[RunCurve, ...]
    limits: tuple[float, ...]


def render_trace(record: Mapping[str, Any], drawing: Mapping[str, Any]) -> str:
    """The page of a trace.

    Args:
        record: schema ``cuspaudit/trace/1``.
        drawing: from `pictures.tool_path.trace_drawing`.
    """
    scripts = [asset("sticks.js"), asset("trace.js")]
    return (
        environment()
        .get_template("trace.html")
        .render(
            record=record,
            panels=[_panel(record, drawing, k) for k in range(len(drawing["joints"]))],
            rows=[_row(record, k) for k in range(len(record["runs"]))],
            legs=drawing["legs"],
            drawing=drawing,
            sentence=_sentence(record),
            data_link=_link(record),
            style=Markup(asset("page.css") + asset("trace.css")),
            scripts=[Markup(script) for script in scripts],
            policy=policy(scripts),
        )
    )


def render_postures(record: Mapping[str, Any], drawing: Mapping[str, Any]) -> str:
    """The page of the postures of a pose, side by side, one colour an aspect.

    Args:
        record: schema ``cuspaudit/postures/1``.
        drawing: from `pictures.tool_path.postures_drawing`.
    """
    scripts = [asset("sticks.js"), asset("postures.js")]
    return (
        environment()
        .get_template("postures.html")
        .render(
            record=record,
            drawing={**drawing, "groups": [_group(p) for p in record["postures"]]},
            rows=[_posture(p) for p in record["postures"]],
            data_link=_link(record),
            style=Markup(asset("page.css") + asset("trace.css")),
            scripts=[Markup(script) for script in scripts],
            policy=policy(scripts),
        )
    )


def _panel(record: Mapping[str, Any], drawing: Mapping[str, Any], k: int) -> Panel:
    joint, runs, legs = drawing["joints"][k], drawing["runs"], drawing["legs"]
    values = [value[k] for run in runs for value in run["values"]] or [0.0]
    low, high = min(values), max(values)
    room = 0.08 * ((high - low) or 1.0)
    low, high = low - room, high + room

    def place(s: float, value: float) -> tuple[float, float]:
        x, y = _WIDE * s / legs, _HIGH * (high - value) / (high - low)
        return round(x, 2), round(y, 2)

    curves = []
    for number, run in enumerate(runs):
        own = record["runs"][number]
        dots = [
            place(s, value[k]) for s, value in zip(run["s"], run["values"], strict=True)
        ]
        curves.append(
            RunCurve(
                " ".join(f"{x},{y}" for x, y in dots),
                _SIGNS.get(own["sign"], "none"),
                number,
                own["end"],
                *dots[-1],
            )
        )
    limits = [x for x in joint["limits"] or () if low < x < high]
    heights = tuple(place(0, x)[1] for x in limits)
    unit = _DEGREES if joint["kind"] == "revolute" else 1.0
    mark = "°" if joint["kind"] == "revolute" else f" {record['robot']['unit']}"
    least, most = (f"{x * unit:.4g}{mark}" for x in (low, high))
    return Panel(joint["name"], least, most, tuple(curves), heights)


def _row(record: Mapping[str, Any], k: int) -> dict[str, Any]:
    """A run in words."""
    run, to = record["runs"][k], (record["permutation"] or {})
    at = f"{run['at']:.6g}"
    words = {
        "reached": "reaches the end",
        "singular": f"dies at a singularity at {at}",
        "limit": f"meets a limit of {run['joint']} at {at}",
        "undecided": f"undecided near {at}",
    }[run["end"]]
    if to and to[k] is not None:
        words += f" in run {to[k]}"
        turns = record["turns"][k]
        if any(turns):
            words += ", turned by " + ", ".join(str(turn) for turn in turns)
    if not run["inside"]:
        words = f"begins outside the limits; without them it {words}"
    margin = run["margin"]["singular"]
    near = "" if margin is None or run["end"] != "reached" else _angle(margin)
    return {
        "number": k,
        "sign": _SIGNS.get(run["sign"], "none"),
        "end": run["end"],
        "words": words,
        "near": near,
        "start": _values(run["start"]),
        "proved": run["proved"],
    }


def _posture(posture: Mapping[str, Any]) -> dict[str, Any]:
    near, least = posture["nearest_singular"], posture["nonsingular_within"]
    return {
        "joints": _values(posture["values"]),
        "determinant": f"{posture['determinant']:.4g}",
        "sign": {1: "+", -1: "−", 0: "0"}.get(posture["sign"], "?"),
        "aspect": posture["aspect"],
        "inside": posture["inside"],
        "windings": len(posture["windings"]),
        "near": "" if near is None else _angle(near),
        "least": "" if least is None else f"{math.floor(least * 572.9577) / 10}°",
    }


def _group(posture: Mapping[str, Any]) -> int:
    """The number of its colour: the aspect, or else the sign."""
    if posture["aspect"] is not None:
        return int(posture["aspect"]) - 1
    return 0 if posture["sign"] == 1 else 1


def _sentence(record: Mapping[str, Any]) -> str:
    runs = [run for run in record["runs"] if run["inside"]]
    reach = sum(run["end"] == "reached" for run in runs)
    if not runs:
        return "No posture of the first pose lies within the limits."
    text = f"{reach} of {len(runs)} starts reach the end of the path."
    if record["verdict_from_path"]:
        text += " A start ends in another posture: the arm is cuspidal."
    if record["recommended"] is not None:
        text += f" Start in run {record['recommended']}: it keeps the most room."
    return text


def _values(values: Sequence[float]) -> str:
    return ", ".join(f"{value:.4f}" for value in values)


def _angle(value: float) -> str:
    return f"{value * _DEGREES:.1f}°"


def _link(record: Mapping[str, Any]) -> str:
    text = json.dumps(record, indent=1)
    return "data:application/json;base64," + base64.b64encode(text.encode()).decode()
