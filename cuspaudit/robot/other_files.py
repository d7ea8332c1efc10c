"""Files of ours given to the wrong command: what they are, and who reads them."""

from __future__ import annotations

from collections.abc import Mapping

from cuspaudit.robot.place import Place

__all__ = ["check_kind", "kind_of"]

_SCHEMAS = {
    "cuspaudit/audit/": ("an audit", "cuspaudit show"),
    "cuspaudit/certificate/": ("a certificate", "cuspaudit verify"),
    "cuspaudit/record/": ("the record of a run", ""),
}
_KEYS = (
    ({"variables", "map"}, "a polynomial system", "cuspaudit decide"),
    ({"parameters", "robot"}, "a family of robots", "cuspaudit sweep -o DIR"),
    ({"parameters", "joints"}, "a family of robots", "cuspaudit sweep -o DIR"),
    ({"legs"}, "a parallel mechanism", "cuspaudit audit"),
    ({"joints"}, "a robot", "cuspaudit audit"),
)


def kind_of(entries: Mapping[str, object]) -> tuple[str, str] | None:
    """What a mapping read from a file is, and the command for it; None for another's.

    The command is "" where none reads it.

    >>> kind_of({"variables": ["x"], "map": ["x^2"]})
    ('a polynomial system', 'cuspaudit decide')
    """
    schema = entries.get("schema")
    for start, known in _SCHEMAS.items():
        if isinstance(schema, str) and schema.startswith(start):
            return known
    for keys, name, command in _KEYS:
        if keys <= entries.keys():
            return name, command
    return None


def check_kind(entries: Mapping[str, object], wanted: str, place: Place) -> None:
    """Refuse a file of another kind by the name of the command that reads it.

    Args:
        entries: the file.
        wanted: what the command reads, as `kind_of` names it.
        place: the file.

    Raises:
        InvalidRobotError: it is something else of ours.
    """
    found = kind_of(entries)
    if found is not None and found[0] != wanted:
        name, command = found
        expected = f"type: {command} {place.file}" if command else f"give {wanted}"
        raise place.error(f"this is {name}, not {wanted}", expected)
