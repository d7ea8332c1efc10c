"""Those elements of an XML robot file that place links and move them, as text.

A document type declaration is refused where it begins, so no entity is ever defined;
nothing outside the file is opened; a malformed file is never repaired. What a format
does not name is passed over with all that is in it, or refused by name where it may
bring a part of the arm from elsewhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from cuspaudit.robot.formats.urdf.xml import check_beginning, file_bytes
from cuspaudit.robot.place import Place, quoted

__all__ = ["Element", "Kinds", "looks_like", "read_elements"]

_MOST_DEPTH = 300
_MOST_ELEMENTS = 200_000
_MOST_TEXT = 10_000
_BEGINNING = 65536
_COMMENT = re.compile(rb"<!--.*?(-->|\Z)", re.DOTALL)
_ELEMENT = re.compile(rb"<([A-Za-z_][\w.:-]*)")


@dataclass(frozen=True, slots=True)
class Kinds:
    """What a format knows of its elements.

    Attributes:
        root: the name of the root.
        model: what such a file is, such as "an MJCF model".
        kept: the names that matter, the root's among them; others are passed over.
        refused: name to (what was found, what to do); FILE in it is the file.
    """

    root: str
    model: str
    kept: frozenset[str]
    refused: Mapping[str, tuple[str, str]]


@dataclass(slots=True)
class Element:
    """An element, with those of its children that matter.

    Attributes:
        tag: its name.
        line: where it begins.
        attributes: as text.
        children: in file order.
        text: what stands in it outside its children.
    """

    tag: str
    line: int
    attributes: Mapping[str, str]
    children: list[Element] = field(default_factory=list)
    text: str = ""

    def all(self, *tags: str) -> Iterator[Element]:
        """The children with one of these names."""
        return (child for child in self.children if child.tag in tags)

    def one(self, tag: str) -> Element | None:
        """The first child of this name, None if there is none."""
        return next(self.all(tag), None)

    def place(self, file: Place) -> Place:
        """Where it stands."""
        name = self.attributes.get("name", "")
        return file.at(
            f"{self.tag} {quoted(name) + ' ' if name else ''}(line {self.line})"
        )


def looks_like(path: Path, kinds: Kinds) -> bool:
    """Whether the first element of a file is the root of this kind."""
    try:
        with path.open("rb") as stream:
            beginning = _COMMENT.sub(b"", stream.read(_BEGINNING))
    except OSError:
        return False
    first = _ELEMENT.search(beginning)
    return first is not None and first[1] == kinds.root.encode()


def read_elements(path: Path, place: Place, kinds: Kinds) -> Element:
    """The root of a file.

    Raises:
        InvalidRobotError: it is not a well-formed file of this kind, on its own.
    """
    return _Reader(place, kinds).read(file_bytes(path, place))


class _Reader:
    """One pass over one file; handlers called by expat."""

    def __init__(self, place: Place, kinds: Kinds) -> None:
        self.place = place
        self.kinds = kinds
        self.root: Element | None = None
        self.open: list[Element | None] = []
        self.count = 0
        self.parser = expat.ParserCreate()
        self.parser.StartDoctypeDeclHandler = self._doctype
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text

    def read(self, content: bytes) -> Element:
        check_beginning(content, self.place)
        try:
            self.parser.Parse(content, True)
        except expat.ExpatError as error:
            found = expat.ErrorString(error.code) or "not XML"
            here = self.place.at(f"line {error.lineno} column {error.offset + 1}")
            raise here.error(found, "give well-formed XML") from None
        except (LookupError, ValueError):
            raise self.place.error(
                "its encoding is unknown", "save the file as UTF-8"
            ) from None
        assert self.root is not None, "a well-formed file has a root"
        return self.root

    def _here(self) -> Place:
        return self.place.at(f"line {self.parser.CurrentLineNumber}")

    def _doctype(self, *rest: object) -> None:
        found = "a document type declaration"
        raise self._here().error(found, f"remove it: {self.kinds.model} has none")

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        self.count += 1
        if len(self.open) >= _MOST_DEPTH or self.count > _MOST_ELEMENTS:
            found = f"more than {_MOST_DEPTH} nested or {_MOST_ELEMENTS} elements"
            raise self._here().error(found, "give the model of one arm")
        if self.root is None and tag != self.kinds.root:
            found = f"the root element is {quoted(tag)}, not {self.kinds.root}"
            raise self._here().error(found, f"give {self.kinds.model}")
        if tag in self.kinds.refused:
            found, expected = self.kinds.refused[tag]
            expected = expected.replace("FILE", str(self.place.file))
            raise self._here().error(found, expected)
        above = self.open[-1] if self.open else None
        element = None
        if tag in self.kinds.kept and (above is not None or self.root is None):
            line = self.parser.CurrentLineNumber
            element = Element(tag, line, attributes)
            if above is not None:
                above.children.append(element)
            else:
                self.root = element
        self.open.append(element)

    def _text(self, text: str) -> None:
        element = self.open[-1] if self.open else None
        if text.isspace():
            text = " "
            if element is None or element.text[-1:] in ("", " "):
                return
        if element is not None:
            if len(element.text) + len(text) > _MOST_TEXT:
                found = f"more than {_MOST_TEXT} characters of text"
                raise element.place(self.place).error(found, "write numbers or a name")
            element.text += text

    def _end(self, tag: str) -> None:
        self.open.pop()
