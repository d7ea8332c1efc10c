"""A polynomial system and a map in a file: the input (f, R) without any robot.

::

    name: Whitney cusp                 # optional, like title and source
    variables: [x, y]
    equations: []                      # f; may be left out for V = R^n
    map: ["x^3 + x*y", "y"]            # R; an angle is written {angle: [c, s]}
    expect: {verdict: cuspidal, aspects: 2}    # optional
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeGuard

from cuspaudit.algebra.polynomial_text import VARIABLE, parse_polynomial
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import InvalidRobotError, InvalidSystemError
from cuspaudit.parallel.equations import Loops, loops
from cuspaudit.parallel.reading import is_mechanism, mechanism_from_entries
from cuspaudit.robot.other_files import check_kind
from cuspaudit.robot.place import Place, listing, quoted
from cuspaudit.robot.tables import read_mapping

__all__ = ["SystemFile", "read_system", "system_from_entries", "system_of"]

_KEYS = ("variables", "equations", "map", "name", "title", "source", "expect")
_WORDS = ("name", "title", "source")
_MOST = 30
_VERDICTS = ("cuspidal", "noncuspidal", "undecided")


@dataclass(frozen=True, eq=False)
class SystemFile:
    """A variety and a map, as a file has them.

    Attributes:
        file: where they come from.
        name: its ``name``, or the file's own.
        variety: V = {f = 0}.
        mapping: R.
        expect: what the file records about the answer.
        loops: the mechanism whose equations they are, or None.
    """

    file: str
    name: str
    variety: PolynomialSystem
    mapping: PolynomialMap
    expect: Mapping[str, str]
    loops: Loops | None = None


def read_system(path: Path) -> SystemFile:
    """The polynomial system and map in a YAML or JSON file.

    Raises:
        InvalidSystemError: the file cannot be read as it stands.
    """
    try:
        entries = read_mapping(path, Place(str(path)), "variables:, equations:, map:")
    except InvalidRobotError as error:
        raise InvalidSystemError(
            file=error.file,
            where=error.where,
            found=error.found,
            expected=error.expected,
        ) from None
    if is_mechanism(entries):
        return system_of(loops(mechanism_from_entries(str(path), entries)))
    return system_from_entries(str(path), entries)


def system_of(found: Loops) -> SystemFile:
    """The equations of a mechanism as a system of the same file."""
    own = found.mechanism
    return SystemFile(
        own.file, own.name, found.variety, found.mapping, own.expect, found
    )


def system_from_entries(file: str, entries: Mapping[str, object]) -> SystemFile:
    """The polynomial system and map in ``entries``, keyed as in a file.

    Raises:
        InvalidSystemError: they cannot be read as they stand.
    """
    return _Reader(file, entries).system()


@dataclass(frozen=True)
class _Reader:
    file: str
    entries: Mapping[str, object]

    def system(self) -> SystemFile:
        if "map" not in self.entries:
            check_kind(self.entries, "a polynomial system", Place(self.file))
        unknown = [key for key in self.entries if key not in _KEYS]
        if unknown:
            expected = f"known keys are {', '.join(_KEYS)}"
            raise self._error("", f"unknown key {listing(unknown)}", expected)
        ring = Ring(self._variables())
        equations = self._polynomials(ring, "equations", at_least=0)
        components, angles = self._map(ring)
        words = {key: self.entries.get(key, "") for key in _WORDS}
        for key, value in words.items():
            if not isinstance(value, str):
                raise self._error(key, "not a text", "write one line of text")
        return SystemFile(
            self.file,
            str(words["name"]) or Path(self.file).stem,
            PolynomialSystem(ring, tuple(p for p in equations if p != 0)),
            PolynomialMap(ring, components, angles),
            self._expect(),
        )

    def _variables(self) -> list[str]:
        names = self._list("variables", at_least=1)
        for name in names:
            if not VARIABLE.fullmatch(name):
                expected = "a letter, then letters, digits and _, at most 40"
                raise self._error("variables", quoted(name), expected)
            if names.count(name) > 1:
                raise self._error("variables", f"{quoted(name)} twice", "name it once")
        return names

    def _map(
        self, ring: Ring
    ) -> tuple[tuple[Polynomial, ...], tuple[tuple[Polynomial, Polynomial], ...]]:
        """The components and the angles of the map, either in the order of the file."""
        value = self.entries.get("map", [])
        plain, angles = list[object](), list[tuple[Polynomial, Polynomial]]()
        for i, entry in enumerate(value if isinstance(value, list) else []):
            if not isinstance(entry, dict):
                plain.append(entry)
                continue
            pair = entry.get("angle")
            if list(entry) != ["angle"] or not _are_two(pair):
                expected = "write {angle: [c, s]} with c^2 + s^2 = 1 on V"
                raise self._error(f"map[{i}]", "not an angle", expected)
            c, s = (
                parse_polynomial(ring, text, self.file, f"map[{i}] angle")
                for text in pair
            )
            angles.append((c, s))
        if not angles:
            return self._polynomials(ring, "map", at_least=1), ()
        read = replace(self, entries={**self.entries, "map": plain})
        return read._polynomials(ring, "map", at_least=0), tuple(angles)

    def _polynomials(
        self, ring: Ring, key: str, at_least: int
    ) -> tuple[Polynomial, ...]:
        texts = self._list(key, at_least)
        return tuple(
            parse_polynomial(ring, text, self.file, f"{key}[{i}]")
            for i, text in enumerate(texts)
        )

    def _list(self, key: str, at_least: int) -> list[str]:
        value = self.entries.get(key, [])
        if isinstance(value, str) and not value:
            value = []
        if not isinstance(value, list) or not all(isinstance(v, str) for v in value):
            raise self._error(key, "not a list of texts", f'write {key}: ["..."]')
        if not at_least <= len(value) <= _MOST:
            found = f"{len(value)} entries"
            raise self._error(key, found, f"give {at_least} to {_MOST}")
        return value

    def _expect(self) -> dict[str, str]:
        value = self.entries.get("expect", {})
        if not isinstance(value, dict):
            raise self._error("expect", "not a mapping", "write {verdict: cuspidal}")
        for key, entry in value.items():
            good = (
                entry in _VERDICTS
                if key == "verdict"
                else key in ("aspects", "max_postures") and str(entry).isdigit()
            )
            if not good:
                raise self._error(
                    f"expect {key}",
                    quoted(str(entry)),
                    "verdict: one of three; aspects, max_postures: a number",
                )
        return value

    def _error(self, where: str, found: str, expected: str) -> InvalidSystemError:
        return InvalidSystemError(
            file=self.file, where=where, found=found, expected=expected
        )


def _are_two(value: object) -> TypeGuard[list[str]]:
    return (
        isinstance(value, list)
        and len(value) == 2
        and all(isinstance(text, str) for text in value)
    )
