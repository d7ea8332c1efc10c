"""What to do with a verdict, and why there is none: sentences for the page."""

from __future__ import annotations

import math
import shlex
from collections.abc import Mapping
from pathlib import PurePosixPath, PureWindowsPath
from typing import Any

from cuspaudit.robot.distance_text import distance_text, structure_words

__all__ = ["advice", "file_name", "margin_words", "undecided_words"]

Audit = Mapping[str, Any]


def file_name(audit: Audit) -> str:
    """The last part of the robot's file: its folders are those of one machine."""
    file = str(_part(audit, "robot").get("file") or "")
    return PurePosixPath(PureWindowsPath(file).as_posix()).name


def margin_words(audit: Audit) -> str:
    """The margin in degrees, "" where there is none."""
    angle = _part(audit, "margin").get("joint_angle")
    if not isinstance(angle, int | float) or not math.isfinite(angle):
        return ""
    return f"{math.degrees(angle):.1f}°"


def undecided_words(audit: Audit) -> str:
    """Why there is no verdict, in sentences; "" where nothing is said of it."""
    reason = audit.get("undecided")
    if isinstance(reason, str):
        return _sentence(reason)
    if not isinstance(reason, Mapping):
        return ""
    step, why = str(reason.get("step") or ""), str(reason.get("why") or "")
    told = why.removeprefix(f"{step}: ") or "it could not go on"
    if reason.get("reason") == "time limit":
        words = [f"The search ended at the step “{step}”, because {told}."]
    else:
        words = [_sentence(told)]
    looked_for = [str(name) for name in reason.get("looked_for") or []]
    if looked_for:
        words.append(f"Looked for and not found: {', '.join(looked_for)}.")
    settle = reason.get("would_settle")
    if settle:
        words.append(f"A verdict would come of {settle}.")
    return " ".join(words)


def advice(audit: Audit) -> list[str]:
    """What to do now, a sentence or two each."""
    verdict = audit.get("verdict")
    if verdict == "cuspidal":
        return [
            "Plan and record motions in joint space. After each lap of a closed path "
            "compare all joints with where the lap began, not the tool alone; watching "
            "det J is no help.",
            *_ending(audit),
            *_within(audit),
        ]
    if verdict == "noncuspidal":
        return [
            "Watch det J, or the signs of its factors: as long as none changes, the "
            "posture is the one that the motion began with.",
            "The proof is about these dimensions. Audit again when one changes, or "
            "when the arm is calibrated.",
        ]
    return [*_next(audit), *_ending(audit), *_within(audit)]


def _ending(audit: Audit) -> list[str]:
    """The nearest structure that makes the arm noncuspidal."""
    entries = audit.get("structures")
    found = entries if isinstance(entries, list) else []
    for entry in found:
        if not isinstance(entry, Mapping) or entry.get("holds") is not False:
            continue
        if entry.get("verdict") == "noncuspidal":
            name = structure_words(str(entry.get("name")))
            length, angle = (entry.get(key) or 0 for key in ("length", "angle"))
            away = distance_text(length, angle, str(entry.get("unit") or "m"))
            return [
                f"If the design is still open: {name} is {away} away, and makes the "
                "arm noncuspidal."
            ]
    return []


def _within(audit: Audit) -> list[str]:
    if _part(audit, "limits").get("verdict") == "noncuspidal":
        return ["Within its joint limits the arm is noncuspidal: keep them."]
    return []


def _next(audit: Audit) -> list[str]:
    """What to type where there is no verdict."""
    command = f"cuspaudit audit {shlex.quote(file_name(audit) or 'ROBOT')}"
    if _part(audit, "undecided").get("reason") == "time limit":
        return [f"Give it more time: {command} --timeout 600, or leave the limit out."]
    return [
        f"Let it search elsewhere and longer: {command} --seed 1 --timeout 600.",
        "Treat the arm as if it were cuspidal until then.",
    ]


def _part(audit: Audit, key: str) -> Audit:
    value = audit.get(key)
    return value if isinstance(value, Mapping) else {}


def _sentence(text: str) -> str:
    text = text.strip()
    return f"{text[:1].upper()}{text[1:].rstrip('.')}." if text else ""
