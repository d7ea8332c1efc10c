"""Robot tables as text: YAML, JSON and CSV files read without any value in them.

Every scalar stays the text it is in the file: no float, date or boolean is made of
it. Duplicate keys, YAML aliases and deep nesting are refused.
"""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import yaml

from cuspaudit.robot.place import Place, quoted

__all__ = ["Table", "read_mapping", "read_table", "table_from_mapping"]

_MOST_BYTES = 1_000_000
_MOST_DEPTH = 8
_MOST_ROWS = 5000
_SETTING = re.compile(r"\b(convention|angles|lengths|task)\s*=\s*([\w-]+)")


@dataclass(frozen=True, slots=True)
class Table:
    """A head of settings and one mapping a joint; scalars are text.

    Attributes:
        head: the entries beside the rows, under the names of the YAML form.
        rows: base to tip; a value is text, or a sequence of text.
    """

    head: Mapping[str, object]
    rows: Sequence[Mapping[str, object]]


def read_table(path: Path, columns: Collection[str], place: Place) -> Table:
    """The table in ``path``, by the ending of its name.

    Args:
        path: a .csv or .json file; any other is read as YAML.
        columns: the column names that a CSV header may hold.
        place: the file, for messages.

    Raises:
        InvalidRobotError: it cannot be read, decoded or parsed.
    """
    if path.suffix.lower() == ".csv":
        return _from_csv(_text(path, place), columns, place)
    return table_from_mapping(read_mapping(path, place), place)


def read_mapping(
    path: Path, place: Place, example: str = "name:, convention:, joints: ..."
) -> dict[str, object]:
    """The mapping in a YAML or .json file; every scalar is text.

    Args:
        path: the file.
        place: the same, for messages.
        example: the keys such a file has, for the message when it has none.

    Raises:
        InvalidRobotError: it cannot be read, decoded or parsed, or is no mapping.
    """
    text = _text(path, place)
    is_json = path.suffix.lower() == ".json"
    entries = _json(text, place) if is_json else _yaml(text, place)
    if not isinstance(entries, dict):
        found = "the file is not a mapping of keys to values"
        raise place.error(found, f"write {example}")
    return entries


def table_from_mapping(entries: Mapping[str, object], place: Place) -> Table:
    """The table in a mapping as `read_mapping` returns it.

    Raises:
        InvalidRobotError: it has no list of joints.
    """
    head = dict(entries)
    rows = head.pop("joints", None)
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        expected = "write a list of rows such as {type: revolute, a: 1, alpha: 0, d: 0}"
        raise place.at("joints").error("no list of joints", expected)
    return Table(head, rows)


def _text(path: Path, place: Place) -> str:
    try:
        with path.open("rb") as stream:
            content = stream.read(_MOST_BYTES + 1)
    except OSError as error:
        reason = error.strerror or "it cannot be read"
        raise place.error(reason, "give a readable file") from None
    if len(content) > _MOST_BYTES:
        raise place.error(f"more than {_MOST_BYTES} bytes", "give a shorter table")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        found = f"byte {error.start + 1} is not UTF-8"
        raise place.error(found, "save the file as UTF-8") from None


class _TextLoader(yaml.BaseLoader):
    """PyYAML's loader of plain text, with aliases and duplicate keys refused."""

    depth = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        """The next node, unless it is an alias or too deep."""
        event = self.peek_event()  # type: ignore[no-untyped-call] # as in its stubs
        if isinstance(event, yaml.AliasEvent) or getattr(event, "anchor", None):
            _refuse(event, "an anchor or alias", "write the value itself")
        if self.depth > _MOST_DEPTH:
            _refuse(event, "too many levels", "nest at most three levels")
        self.depth += 1
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node

    def construct_mapping(self, node: Any, deep: bool = False) -> Any:
        """The mapping of ``node``, unless a key stands twice."""
        seen = set()
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode):
                _refuse(key, "a key that is no word", "write one word before the colon")
            if key.value in seen:
                _refuse(key, f"the key {quoted(key.value)} twice", "write it once")
            seen.add(key.value)
        return super().construct_mapping(node, deep=True)


def _refuse(spot: Any, found: str, expected: str) -> NoReturn:
    raise yaml.MarkedYAMLError(
        problem=found, problem_mark=spot.start_mark, note=expected
    )


def _yaml(text: str, place: Place) -> object:
    try:
        return yaml.load(text, _TextLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        here = place.at(f"line {mark.line + 1}") if mark else place
        found = error.problem or "not YAML"
        raise here.error(found, error.note or "write plain YAML") from None
    except yaml.YAMLError as error:
        found = str(error).splitlines()[0]
        raise place.error(found, "write plain YAML") from None


def _json(text: str, place: Place) -> object:
    def mapping(pairs: list[tuple[str, object]]) -> dict[str, object]:
        result = dict(pairs)
        if len(result) != len(pairs):
            raise place.error("a key stands twice in one object", "write it once")
        return result

    def constant(name: str) -> NoReturn:
        raise place.error(f"{name} is not a number", "write a finite number")

    try:
        return json.loads(
            text,
            parse_float=str,
            parse_int=str,
            parse_constant=constant,
            object_pairs_hook=mapping,
        )
    except json.JSONDecodeError as error:
        here = place.at(f"line {error.lineno} column {error.colno}")
        raise here.error(error.msg, "write plain JSON") from None
    except RecursionError:
        raise place.error("too many levels", "nest at most three levels") from None


def _from_csv(text: str, columns: Collection[str], place: Place) -> Table:
    lines = text.splitlines()
    start = next(
        (k for k, line in enumerate(lines) if line.strip() and line.lstrip()[0] != "#"),
        len(lines),
    )
    header = lines[start] if start < len(lines) else ""
    delimiter = next((d for d in ("\t", ";") if d in header), ",")
    body = io.StringIO("\n".join(lines[start:]))
    try:
        cells = [
            [cell.strip() for cell in row]
            for row in csv.reader(body, delimiter=delimiter, strict=True)
            if any(cell.strip() for cell in row)
        ]
    except csv.Error as error:
        raise place.error(str(error), "write one joint a line") from None
    if not cells:
        raise place.error("the file is empty", "write a line of column names")
    return Table(_settings(lines[:start]), _rows(cells, columns, place))


def _rows(
    cells: list[list[str]], columns: Collection[str], place: Place
) -> list[Mapping[str, object]]:
    names = [name.lower() for name in cells[0]]
    for name in names:
        if name not in columns:
            found = f"the column name {quoted(name)} is unknown"
            expected = f"begin with a line of names out of {', '.join(sorted(columns))}"
            raise place.at("header").error(found, expected)
    if len(set(names)) < len(names):
        found = f"a column name stands twice: {quoted(', '.join(names))}"
        raise place.at("header").error(found, "write it once")
    if len(cells) > _MOST_ROWS:
        raise place.error(f"{len(cells) - 1} rows", "give a shorter table")
    for number, row in enumerate(cells[1:], 1):
        if len(row) != len(names):
            found = f"{len(row)} cells under {len(names)} column names"
            raise place.at(f"row {number}").error(found, "write one cell a column")
    return [
        {name: cell for name, cell in zip(names, row, strict=True) if cell}
        for row in cells[1:]
    ]


def _settings(comments: list[str]) -> dict[str, object]:
    """The settings in the comments above the header, as the YAML form names them."""
    found = dict(_SETTING.findall("\n".join(comments)))
    head: dict[str, object] = {}
    for word, name in (("convention", "convention"), ("task", "task")):
        if word in found:
            head[name] = found[word]
    units = {
        name: found[word]
        for word, name in (("lengths", "length"), ("angles", "angle"))
        if word in found
    }
    if units:
        head["units"] = units
    return head
