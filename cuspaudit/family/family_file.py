"""A family file: a robot file whose numbers may be names, and the names' values.

::

    family: orthogonal-3r
    robot: {convention: standard, joints: [{type: revolute, a: a2, ...}, ...]}
    parameters: {a2: {range: [0.2, 3], steps: 15}, d2: {values: [1/2, 1]}}
    derived: {reach: a2 + a3}
    constraints: ["a3 <= a2 + 3", reach > 1]
    adaptive: {parameters: [a2, a3], levels: 3, on: verdict}
    record: [cusps, nodes, aspects, max_postures]
    seed: 0

The numbers of the robot are those of a robot file, or expressions in the parameters and
the derived names (`expressions`); parsed, never evaluated. A sweep adds a
``provenance``, which is not part of the family.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path

from cuspaudit.errors import InvalidRobotError
from cuspaudit.family.conditions import Condition, parse_condition
from cuspaudit.family.expressions import NAME, WORDS, Expression, parse_expression
from cuspaudit.family.family import Adaptive, Family
from cuspaudit.family.parameters import Parameter, parse_parameter, parse_whole
from cuspaudit.robot.entries import check_known, word
from cuspaudit.robot.other_files import check_kind
from cuspaudit.robot.place import Place, listing, quoted
from cuspaudit.robot.robot import COUNTS
from cuspaudit.robot.tables import Table, read_mapping, table_from_mapping

__all__ = ["RECORDED", "read_family"]

RECORDED = (*COUNTS, "clearance", "tolerance", "within_limits")
_NAMED = ("verdict", *RECORDED)
_RESERVED = {
    *WORDS,
    *RECORDED,
    *("index", "verdict", "proof", "exact", "seconds", "error"),
}
_KEYS = (
    *("family", "robot", "parameters", "derived", "constraints", "adaptive"),
    *("record", "seed", "title", "source", "provenance"),
)
_CELLS = ("a", "alpha", "d", "theta", "qmin", "qmax")
_MOST_MEMBERS = 10**12
_TRIED = 20


def read_family(path: Path) -> Family:
    """The family in a YAML file, with the robot of one member read as a trial.

    Raises:
        InvalidRobotError: the file cannot be read as it stands.
    """
    place = Place(str(path))
    entries = read_mapping(path, place)
    check_kind(entries, "a family of robots", place)
    if "joints" in entries:
        found = "joints, and the other lines of a robot, beside its parameters"
        raise place.error(found, "move them, indented, below a line robot:")
    check_known(entries, _KEYS, place)
    entries.pop("provenance", None)
    text = json.dumps(entries)
    robot = entries.get("robot")
    if not isinstance(robot, Mapping):
        raise place.at("robot").error("no robot", "write robot: and its lines below")
    table = table_from_mapping(robot, place.at("robot"))
    seed = parse_whole(entries, "seed", place) if "seed" in entries else 0
    parameters = _parameters(entries.get("parameters"), seed, place.at("parameters"))
    derived = _derived(entries.get("derived"), parameters, place.at("derived"))
    known = {p.name for p in parameters} | set(derived)
    cells = _cells(table, known, place)
    conditions = _conditions(entries.get("constraints"), known, place.at("constraints"))
    record = _listed(entries.get("record"), _NAMED, place.at("record"))
    wanted = COUNTS if record is None else record
    wanted = tuple(name for name in wanted if name != "verdict")
    adaptive = _adaptive(entries.get("adaptive"), parameters, place.at("adaptive"))
    if adaptive is not None:
        times = 2**adaptive.levels
        parameters = tuple(
            p.refined(times) if p.name in adaptive.parameters else p for p in parameters
        )
        for column in adaptive.on:
            if column not in ("verdict", *wanted):
                found = f"{column} is compared and not recorded"
                raise place.at("adaptive").error(found, "add it to record")
    family = Family(
        name=word(entries, "family", place) or path.stem,
        file=str(path),
        text=text,
        hash=hashlib.sha256(text.encode()).hexdigest(),
        parameters=parameters,
        derived=derived,
        constraints=conditions,
        record=wanted,
        seed=seed,
        adaptive=adaptive,
        rows=table,
        cells=cells,
    )
    if family.size > _MOST_MEMBERS:
        raise place.error(f"{family.size} members", f"give at most {_MOST_MEMBERS}")
    _check_first(family)
    return family


def _check_first(family: Family) -> None:
    """Read the first members, so that a mistake in the robot shows before any work.

    Raises:
        InvalidRobotError: none of them can be read; the reason is that of the first.
    """
    reason: InvalidRobotError | None = None
    for index in range(min(family.size, _TRIED)):
        try:
            if family.values(index) is not None:
                family.robot(index)
                return
        except InvalidRobotError as error:
            reason = reason or error
    if reason is not None:
        raise reason


def _parameters(entry: object, seed: int, place: Place) -> tuple[Parameter, ...]:
    if not isinstance(entry, Mapping) or not entry:
        raise place.error("no parameters", "write a2: {range: [0.2, 3], steps: 15}")
    found = []
    for name, line in entry.items():
        here = _free_name(name, place)
        found.append(parse_parameter(name, line, seed, here))
    if len({p.size for p in found if p.seed is not None}) > 1:
        raise place.error("random parameters of different count", "give all one count")
    return tuple(found)


def _derived(
    entry: object, parameters: tuple[Parameter, ...], place: Place
) -> dict[str, Expression]:
    """Expressions in the parameters and in the names before them."""
    if entry in (None, "", "null"):
        return {}
    if not isinstance(entry, Mapping):
        raise place.error("no mapping", "write {reach: a2 + a3}")
    known = {p.name for p in parameters}
    found = {}
    for name, text in entry.items():
        here = _free_name(name, place)
        if name in known or not isinstance(text, str):
            raise here.error("no new name with an expression", "write reach: a2 + a3")
        found[name] = parse_expression(text, here)
        _check_names(found[name].names, known, here)
        known.add(name)
    return found


def _free_name(name: str, place: Place) -> Place:
    """Where ``name`` stands, when it may be a name.

    Raises:
        InvalidRobotError: it is no word, or has a meaning already.
    """
    here = place.at(name if NAME.fullmatch(name) else quoted(name))
    if not NAME.fullmatch(name) or name in _RESERVED or name.endswith("_exact"):
        raise here.error("not free as a name", "write a word such as a2 or length")
    return here


def _cells(
    table: Table, known: set[str], place: Place
) -> dict[tuple[int, str, int], Expression]:
    """The cells that hold names: row, column and, for limits, which end."""
    found = {}
    for number, row in enumerate(table.rows):
        texts = [(column, 0, row.get(column)) for column in _CELLS]
        if isinstance(limits := row.get("limits"), list):
            texts += [("limits", end, text) for end, text in enumerate(limits)]
        for column, part, text in texts:
            if not isinstance(text, str) or not set(NAME.findall(text)) & known:
                continue
            expression = parse_expression(
                text, place.at(f"robot row {number + 1} {column}")
            )
            _check_names(expression.names, known, expression.place)
            found[number, column, part] = expression
    return found


def _conditions(entry: object, known: set[str], place: Place) -> tuple[Condition, ...]:
    if entry in (None, "", "null"):
        return ()
    if not isinstance(entry, list) or not all(isinstance(x, str) for x in entry):
        raise place.error("no list of comparisons", 'write ["a3 <= a2 + 3"]')
    conditions = tuple(parse_condition(text, place) for text in entry)
    for condition in conditions:
        _check_names(condition.names, known, place)
    return conditions


def _check_names(names: frozenset[str], known: set[str], place: Place) -> None:
    """Check that every name is a parameter or derived from them.

    Raises:
        InvalidRobotError: one is not.
    """
    for name in sorted(names - known):
        found = f"the name {quoted(name)} is no parameter and not derived above"
        raise place.error(found, f"the names are {listing(sorted(known))}")


def _listed(
    entry: object, allowed: tuple[str, ...], place: Place
) -> tuple[str, ...] | None:
    if entry in (None, "", "null"):
        return None
    names = [entry] if isinstance(entry, str) else entry
    if not isinstance(names, list) or not set(names) <= set(allowed):
        raise place.error("an unknown name", f"write a list of {', '.join(allowed)}")
    return tuple(name for name in allowed if name in names)


def _adaptive(
    entry: object, parameters: tuple[Parameter, ...], place: Place
) -> Adaptive | None:
    if entry in (None, "", "null"):
        return None
    if not isinstance(entry, Mapping):
        raise place.error("no mapping", "write {parameters: [a2, a3], levels: 3}")
    check_known(entry, ("parameters", "levels", "on"), place)
    ranges = tuple(
        p.name for p in parameters if p.bounds and p.seed is None and p.size > 1
    )
    names = _listed(entry.get("parameters"), ranges, place.at("parameters"))
    levels = parse_whole(entry, "levels", place, least=1)
    if not names or levels > 12:
        raise place.error("no range to refine, or over 12 levels", "name two ranges")
    on = _listed(entry.get("on"), ("verdict", "within_limits", *COUNTS), place.at("on"))
    return Adaptive(names, levels, on or ("verdict",))
