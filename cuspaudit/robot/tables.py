"""Robot tables as text: YAML and JSON files read without any value in them.

Every scalar stays the text it is in the file: no float, date or boolean is made of
it. Duplicate keys, YAML aliases and deep nesting are refused.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import yaml

from cuspaudit.robot.other_files import check_kind
from cuspaudit.robot.place import Place, quoted

__all__ = ["Table", "read_mapping", "read_text", "table_from_mapping"]

_MOST_BYTES = 1_000_000
_MOST_DEPTH = 8


@dataclass(frozen=True, slots=True)
class Table:
    """A head of settings and one mapping a joint; scalars are text.

    Attributes:
        head: the entries beside the rows, under the names of the YAML form.
        rows: base to tip; a value is text, or a sequence of text.
    """

    head: Mapping[str, object]
    rows: Sequence[Mapping[str, object]]


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
    text = read_text(path, place)
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
    if "joints" not in head:
        check_kind(entries, "a robot", place)
    rows = head.pop("joints", None)
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        expected = "write a list of rows such as {type: revolute, a: 1, alpha: 0, d: 0}"
        raise place.at("joints").error("no list of joints", expected)
    return Table(head, rows)


def read_text(path: Path, place: Place, most: int = _MOST_BYTES) -> str:
    """The text of a file of at most ``most`` bytes, a megabyte, in UTF-8.

    Raises:
        InvalidRobotError: it cannot be read, or is longer, or is no such text.
    """
    try:
        with path.open("rb") as stream:
            content = stream.read(most + 1)
    except OSError as error:
        reason = error.strerror or "it cannot be read"
        raise place.error(reason, "give a readable file") from None
    if len(content) > most:
        raise place.error(f"more than {most} bytes", "give a shorter file")
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
