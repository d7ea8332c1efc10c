"""The audit's numbers in words and rows, for the page."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from cuspaudit.robot.distance_text import distance_text, structure_words
from cuspaudit.robot.tolerance_text import tolerance_words
from cuspaudit.viz.advice import undecided_words
from cuspaudit.viz.scene.scene import Scene

__all__ = [
    "CountRow",
    "PostureRow",
    "StructureRow",
    "VerdictWords",
    "counts",
    "model_rows",
    "no_path_reason",
    "number",
    "part",
    "posture_rows",
    "proof_rows",
    "structure_rows",
    "verdict_words",
]

Audit = Mapping[str, Any]
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
VERDICTS = ("cuspidal", "noncuspidal", "undecided")


@dataclass(frozen=True, slots=True)
class VerdictWords:
    """The verdict as the page opens with it."""

    verdict: str
    name: str
    sentence: str
    meaning: str


@dataclass(frozen=True, slots=True)
class CountRow:
    """A counted thing; ``proved`` is None when the audit does not say."""

    what: str
    value: str
    proved: bool | None
    meaning: str


@dataclass(frozen=True, slots=True)
class PostureRow:
    """One joint in the postures of the audit."""

    joint: str
    unit: str
    values: tuple[str, ...]
    degrees: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class StructureRow:
    """A structure that would decide the arm, and what it takes to have it."""

    name: str
    way: str
    distance: str
    moves: str
    verdict: str
    aspects: str


def number(value: Any, digits: int = 6) -> str:
    """A number as text, with a true minus; other values as they are, null as a dash.

    >>> number(-0.5), number(None), number(1e-13)
    ('−0.5', '–', '1·10⁻¹³')
    """
    if value is None:
        return "–"
    if isinstance(value, bool) or not isinstance(value, int | float):
        return str(value)
    text = str(value) if isinstance(value, int) else f"{value + 0.0:.{digits}g}"
    mantissa, _, power = text.partition("e")
    if power:
        mantissa += "·10" + str(int(power)).translate(RAISED)
    return mantissa.replace("-", "−")


def part(audit: Audit, key: str) -> Audit:
    """The mapping under ``key``, empty when there is none."""
    value = audit.get(key)
    return value if isinstance(value, Mapping) else {}


def verdict_words(audit: Audit) -> VerdictWords:
    """The verdict in one sentence, and what it means for whoever builds the arm."""
    verdict = audit.get("verdict")
    verdict = verdict if verdict in VERDICTS else "undecided"
    robot = part(audit, "robot")
    name = str(robot.get("name") or "This system")
    task = str(robot.get("task"))
    place = "position" if task == "position" else "position and orientation"
    if task == "position-and-angle":
        place = "position at the same angle"
    if task.endswith("-axis"):
        place = f"position with its {task.split('-')[2]} axis in the same direction"
    sentences = {
        "cuspidal": (
            "It can change posture without meeting a singularity.",
            f"Two different postures hold the tool in the same {place}, and a motion "
            "joins them along which det J never vanishes. A controller that watches "
            "for singularities will not see the posture change: plan and record paths "
            "in joint space, and do not infer the posture from the tool alone.",
        ),
        "noncuspidal": (
            "Every change of posture crosses a singularity.",
            f"Whenever two different postures hold the tool in the same {place}, every "
            "motion from one to the other passes a point where det J = 0. The posture "
            "stays known as long as no singularity is crossed.",
        ),
        "undecided": (
            "Neither a singularity-free change of posture nor a proof that there is "
            "none was found.",
            "This is no verdict, and no reason to treat the arm as safe. The reason "
            "for stopping is given below.",
        ),
    }
    return VerdictWords(verdict, name, *sentences[verdict])


def proof_rows(audit: Audit) -> list[tuple[str, str]]:
    """The proof as label and text, what is null left out."""
    proof = part(audit, "proof")
    kinds = {
        "witness": "a path, certified in ball arithmetic",
        "exact": "an exact computation over the rational numbers",
        "reduction": "an exact reduction to a smaller arm",
        "none": "none",
    }
    kind = proof.get("kind")
    rows = [
        ("Kind of proof", kinds.get(str(kind), kind)),
        ("Reduction", proof.get("reduction")),
        ("Engine", proof.get("engine")),
        ("Rests on", ", ".join(map(str, proof.get("rests_on") or []))),
        ("Proved for", _NUMBERS.get(str(proof.get("model")))),
        ("Over a tolerance", _tolerance(audit)),
    ]
    return [(label, str(text)) for label, text in rows if text]


def _tolerance(audit: Audit) -> str | None:
    unit = str(part(audit, "robot").get("unit"))
    return tolerance_words(part(audit, "tolerance"), unit)


_NUMBERS = {
    "literal": "the numbers of the file",
    "snapped": "the snapped numbers, listed below",
    "near": "a model within 1e-12 of the numbers, and not for these",
}


def no_path_reason(audit: Audit) -> str:
    """Why no path is shown, when the audit holds none; else ""."""
    if part(audit, "witness").get("path"):
        return ""
    verdict = verdict_words(audit).verdict
    if verdict == "noncuspidal":
        return "No path is shown because none exists: that is what the verdict says."
    if verdict == "cuspidal":
        return "No path is shown because the audit's proof does not contain one."
    return f"No path is shown because none was found. {undecided_words(audit)}".strip()


def counts(audit: Audit) -> list[CountRow]:
    """Aspects, postures, cusps and nodes, each with what the audit says of proof."""
    singular = part(audit, "singular")

    def of_curve(name: str) -> dict[str, Any]:
        return {"count": singular.get(name), "proved": singular.get(f"{name}_proved")}

    found = [
        ("Aspects", audit.get("aspects"), "regions free of singularities"),
        ("Postures of one pose, at most", audit.get("postures"), "inverse solutions"),
        ("Cusps", of_curve("cusps"), "points where three postures meet"),
        ("Nodes", of_curve("nodes"), "crossings of the critical curve"),
    ]
    counted = [(what, *_counted(value), meaning) for what, value, meaning in found]
    return [CountRow(*row) for row in counted if row[1] != number(None)]


def model_rows(audit: Audit) -> list[tuple[str, str, bool]]:
    """(model, verdict, whether the verdict above is this one's), literal first."""
    models = part(audit, "models")
    rows = []
    for key, label in (
        ("literal", "Literal: the numbers as the file gives them"),
        ("snapped", "Snapped: rounded angles and lengths made exact"),
    ):
        value = models.get(key)
        rows.append((label, str(value or "not decided"), key == "snapped"))
    return rows if models else []


def posture_rows(audit: Audit, scene: Scene | None) -> list[PostureRow]:
    """The postures of the path that is shown, or those drawn, joint by joint."""
    inside = part(part(audit, "limits"), "witness")
    shown = inside or part(audit, "witness")
    postures: Sequence[Sequence[float]] = shown.get("postures") or []
    if not postures and scene is not None and not scene.shown.is_path:
        postures = scene.shown.postures.tolist()
    if not postures:
        return []
    rows = []
    for index in range(len(postures[0])):
        joint = scene.chain.joints[index] if scene else None
        turning = joint is None or joint.kind == "revolute"
        unit = "rad" if turning else (scene.chain.unit if scene else "")
        values = [float(posture[index]) for posture in postures]
        degrees = [_degrees(value) for value in values] if turning else []
        rows.append(
            PostureRow(
                joint.name if joint else str(index + 1),
                unit,
                tuple(number(value, 10) for value in values),
                tuple(degrees),
            )
        )
    return rows


def _degrees(value: float) -> str:
    return f"{round(math.degrees(value), 3) + 0.0:.3f}°".replace("-", "−")


def _counted(value: Any) -> tuple[str, bool | None]:
    """The number under count or max, and whether the audit calls it proved."""
    if not isinstance(value, Mapping):
        return number(None), None
    found = next((value[k] for k in ("count", "max") if k in value), None)
    proved = value.get("proved")
    return number(found), proved if isinstance(proved, bool) else None


def structure_rows(audit: Audit) -> list[StructureRow]:
    """The structures near the arm, nearest first."""
    return [
        StructureRow(
            structure_words(str(entry.get("name"))),
            str(entry.get("way") or ""),
            "it holds" if entry.get("holds") is True else _distance(entry, entry),
            ", ".join(
                f"axis {number(move.get('axis'))} by {_distance(move, entry)}"
                for move in _mappings(entry.get("moves"))
            ),
            str(entry.get("verdict") or "open"),
            f"{number(entry['aspects'])} aspects" if entry.get("aspects") else "",
        )
        for entry in _mappings(audit.get("structures"))
    ]


def _mappings(value: Any) -> list[Audit]:
    """The mappings of a list; an audit from elsewhere may hold anything."""
    entries = value if isinstance(value, list) else []
    return [entry for entry in entries if isinstance(entry, Mapping)]


def _distance(values: Audit, structure: Audit) -> str:
    length, angle = values.get("length"), values.get("angle")
    if not isinstance(length, int | float) or not isinstance(angle, int | float):
        return number(None)
    return distance_text(length, angle, str(structure.get("unit")))
