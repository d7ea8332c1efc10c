"""What the commands print on a terminal, plain in a pipe."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from cuspaudit.robot.distance_text import distance_text, structure_words
from cuspaudit.robot.tolerance_text import tolerance_words

__all__ = ["print_import", "print_summary"]

_LONGEST_FACTOR = 600
COLOUR = {"cuspidal": "bold red", "noncuspidal": "bold green", "undecided": "yellow"}


def print_summary(record: Mapping[str, Any], files: Mapping[str, Any]) -> None:
    """The audit in a few aligned lines."""
    console = Console(highlight=False, soft_wrap=True)
    robot, verdict = record["robot"], record["verdict"]
    proof, models = record["proof"], record["models"]
    witness, singular = record["witness"], record["singular"]
    table = Table.grid(padding=(0, 2))
    rows = {
        "robot": f"{robot['name']}: {robot['joints']} joints, {robot['task']} of "
        f"{robot['tip']} from {robot['base']}",
        "locked": ", ".join(f"{k} = {v}" for k, v in robot.get("locked", {}).items()),
        "verdict": f"[{COLOUR[verdict]}]{verdict}[/]",
        "why": proof["why"],
        "proof": ", ".join([proof["kind"], *proof["rests_on"]]) + _of_model(proof),
        "within limits": _within(record.get("limits")),
        "over tolerance": tolerance_words(record.get("tolerance"), robot["unit"]),
        "literal": f"{models['literal']} for the numbers exactly as the file has them"
        + _hair(record.get("literal_witness"), record.get("literal_why")),
        "snapped": f"{len(robot['snapped'])} numbers; see `cuspaudit import`"
        if robot["snapped"]
        else None,
        "aspects": _count(record["aspects"]["count"], record["aspects"]["proved"]),
        "postures": _count(record["postures"]["max"], record["postures"]["proved"]),
        "cusps": _count(singular["cusps"], singular["cusps_proved"]),
        "nodes": _count(singular["nodes"], singular["nodes_proved"]),
        "det J": " · ".join(_factor(f) for f in singular["factors"]),
        "cross-check": _check_line(record["crosscheck"]),
        "pigeon-hole": _crowd(record.get("crowd")),
        "pairs": _pairs((record["undecided"] or {}).get("pairs")),
        "nearest": _nearest(record.get("structures")),
        "settled by": (record["undecided"] or {}).get("would_settle"),
    }
    if witness and witness["clearance"] is not None:
        rows["clearance"] = f"{witness['clearance']:.3g} of the largest |det J|"
    if record.get("margin"):
        angle = math.degrees(record["margin"]["joint_angle"])
        rows["margin"] = f"{angle:.1f} deg of joint motion, or more (proved)"
    rows |= {name: file for name, file in files.items() if file}
    rows["time"] = f"{record['seconds']['total']:.2f} s"
    for name, value in rows.items():
        if value not in (None, ""):
            markup = name == "verdict"
            text = Text.from_markup(str(value)) if markup else Text(str(value))
            table.add_row(Text(name, style="dim"), text)
    console.print(table)


def _within(limits: Mapping[str, Any] | None) -> str | None:
    """The verdict within joint limits, and what the free witness does with them."""
    if limits is None:
        return None
    free, witness = limits["of_the_free_witness"], limits["witness"]
    text = f"{limits['verdict']} ({limits['proof']['kind']}): {limits['why']}"
    count = limits["aspects"]
    if count["count"] is not None:
        text += (
            f"; {count['count']} aspects{'' if count['proved'] else ' (not proved)'}"
        )
    if witness is not None:
        text += f"; a path keeps {witness['slack']:.3g} from every limit"
    if free is not None and not free["inside"]:
        text += f"; the path without limits leaves them: {free['leaves']}"
    return text


def _of_model(proof: Mapping[str, Any]) -> str:
    """The model that the proof is about, where that is not the arm."""
    if proof.get("model") != "near":
        return ""
    return "; for a model within 1e-12 of the numbers, not for these"


def _hair(witness: Mapping[str, Any] | None, why: str | None) -> str:
    """How little, when the numbers of the file have a witness of their own.

    Where they are undecided, the structure that they are nearest to.
    """
    if why:
        return f", {why}"
    if witness is None or witness["clearance"] is None:
        return ""
    return f", with clearance {witness['clearance']:.1e}"


def _nearest(structures: Sequence[Mapping[str, Any]] | None) -> str | None:
    """The nearest structure that the arm does not have, and what it would decide."""
    away = next((s for s in structures or () if not s["holds"]), None)
    if away is None:
        return None
    distance = distance_text(away["length"], away["angle"], away["unit"])
    return (
        f"{structure_words(away['name'])} is {distance} away: "
        f"{away['verdict'] or 'its verdict is open'}"
    )


def _crowd(crowd: Mapping[str, Any] | None) -> str | None:
    """How many postures of a pose share an aspect."""
    if crowd is None:
        return None
    return (
        f"{crowd['in_one_aspect']} of the {crowd['count']} postures of one pose lie in "
        "one aspect (proved)"
    )


def _pairs(met: Mapping[str, Any] | None) -> str | None:
    """How much of the evidence by pairs may be missing."""
    if met is None or met["missed"] is None:
        return None
    return (
        f"{len(met['maxima'])} maxima met by {met['pairs']} ascents, {met['together']} "
        f"within one aspect; one more ascent would end elsewhere with an estimated "
        f"chance of {met['missed']:.0%} (evidence, not proof)"
    )


def _factor(text: str) -> str:
    """A factor in brackets, or its size where it would fill the screen."""
    if len(text) <= _LONGEST_FACTOR:
        return f"({text})"
    return f"({text.count(' + ') + text.count(' - ') + 1} terms)"


def _count(value: int | None, proved: bool | None) -> str | None:
    if value is None:
        return None
    return f"{value} ({'proved' if proved else 'not proved'})"


def _check_line(check: Mapping[str, Any]) -> str:
    return (
        f"{check['engine']}, {check['samples']} postures, relative error "
        f"{check['max_relative_error']:.1e}, {check['singular_points_checked']} "
        "singular points"
    )


def print_import(found: Mapping[str, Any]) -> None:
    """The chain as a table, and what snapping changes."""
    console = Console(highlight=False, soft_wrap=True)
    console.print(
        f"{found['name']}: {found['task']} of {found['tip']} from {found['base']}, "
        f"lengths in {found['unit']}",
        markup=False,
    )
    for note in found["notes"]:
        console.print(f"note: {note}", markup=False)
    table = Table("joint", "type", "axis", "before it", "limits", box=None)
    for joint in found["joints"]:
        cells = (joint[key] for key in ("name", "type", "axis", "before", "limits"))
        table.add_row(*(_plain(cell) for cell in cells))
    table.add_row("tool", "", "", _plain(found["tool"]), "")
    console.print(table)
    for entry in found["snapped"]:
        console.print(
            f"snapped: {entry['where']}: {_given(entry)} -> {entry['used']} "
            f"(difference {entry['difference']:.2e})"
            + (f": {entry['effect']}" if entry["effect"] else ""),
            markup=False,
        )
    if not found["snapped"]:
        console.print("snapped: nothing; the model is the file's")
    for entry in found["approximated"]:
        console.print(
            f"approximated: {entry['where']}: by a rational point of the circle or "
            f"sphere within {entry['difference']:.0e} rad",
            markup=False,
        )
    _print_map(console, found["map"])


def _given(entry: Mapping[str, Any]) -> str:
    """What stood there, with the error of an invariant."""
    if entry["error"] is None:
        return repr(entry["given"])
    return f"{entry['given']:.12g} +- {entry['error']:.1e}"


def _print_map(console: Console, entries: Mapping[str, Any]) -> None:
    """The polynomial map in full when it is short, else its size."""
    console.print(f"polynomial map over {entries['ring']}:", markup=False)
    for polynomial in entries["f"]:
        console.print(f"  {polynomial} = 0", markup=False)
    if len(entries["R"]) == 3:
        for name, polynomial in zip("xyz", entries["R"], strict=True):
            console.print(f"  {name} = {polynomial}", markup=False)
    else:
        console.print(f"  R: {len(entries['R'])} functions; --to poly prints them")
    if entries["determinant"] is None:
        console.print("det J: none; the task does not fit the joints (lock some)")
    else:
        factors = " · ".join(f"({f})" for f in entries["factors"])
        console.print(f"det J, up to a constant: {factors}", markup=False)


def _plain(cell: Any) -> str:
    return escape(cell if isinstance(cell, str) else "")
