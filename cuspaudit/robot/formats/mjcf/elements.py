"""The elements of an MJCF file that place bodies and move them, as text.

A document type declaration is refused where it begins and nothing outside the file is
opened: what an <include> or a plugin would bring may be part of the arm, so the file is
refused. Meshes, contacts, actuators and the like are passed over.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from cuspaudit.robot.formats.urdf.xml import check_beginning, file_bytes
from cuspaudit.robot.place import Place, quoted

__all__ = ["Element", "looks_like_mjcf", "read_elements"]

_MOST_DEPTH = 300
_MOST_ELEMENTS = 200_000
_BEGINNING = 65536
_KEPT = {
    *("mujoco", "compiler", "default", "joint", "freejoint", "worldbody", "body"),
    *("frame", "site", "equality", "connect", "weld", "tendon"),
}
_SAVE = (
    'let MuJoCo save it whole: python -c "import mujoco as m; m.mj_saveLastXML('
    "'whole.xml', m.MjModel.from_xml_path('FILE'))\", and give whole.xml"
)
_OUTSIDE = {
    "include": ("an <include>", _SAVE),
    "attach": ("an <attach>", _SAVE),
    "replicate": ("a <replicate>", _SAVE),
    "composite": ("a <composite>", "leave it out: an arm has none"),
    "flexcomp": ("a <flexcomp>", "leave it out: an arm has none"),
}


@dataclass(slots=True)
class Element:
    """An element, with those of its children that matter.

    Attributes:
        tag: its name.
        line: where it begins.
        attributes: as text.
        children: in file order.
    """

    tag: str
    line: int
    attributes: Mapping[str, str]
    children: list[Element] = field(default_factory=list)

    def all(self, *tags: str) -> Iterator[Element]:
        """The children with one of these names."""
        return (child for child in self.children if child.tag in tags)

    def place(self, file: Place) -> Place:
        """Where it stands."""
        name = self.attributes.get("name", "")
        return file.at(
            f"{self.tag} {quoted(name) + ' ' if name else ''}(line {self.line})"
        )


def looks_like_mjcf(path: Path) -> bool:
    """Whether a file begins as an MJCF model does."""
    try:
        with path.open("rb") as stream:
            return b"<mujoco" in stream.read(_BEGINNING)
    except OSError:
        return False


def read_elements(path: Path, place: Place) -> Element:
    """The root <mujoco> of a file.

    Raises:
        InvalidRobotError: it is not a well-formed MJCF model of one file.
    """
    return _Reader(place).read(file_bytes(path, place))


class _Reader:
    """One pass over one file; handlers called by expat."""

    def __init__(self, place: Place) -> None:
        self.place = place
        self.root: Element | None = None
        self.open: list[Element | None] = []
        self.count = 0
        self.parser = expat.ParserCreate()
        self.parser.StartDoctypeDeclHandler = self._doctype
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end

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
        raise self._here().error(found, "remove it: an MJCF model has none")

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        self.count += 1
        if len(self.open) >= _MOST_DEPTH or self.count > _MOST_ELEMENTS:
            found = f"more than {_MOST_DEPTH} nested or {_MOST_ELEMENTS} elements"
            raise self._here().error(found, "give the model of one arm")
        if self.root is None and tag != "mujoco":
            found = f"the root element is {quoted(tag)}, not mujoco"
            raise self._here().error(found, "give an MJCF model")
        if tag in _OUTSIDE:
            found, expected = _OUTSIDE[tag]
            expected = expected.replace("FILE", str(self.place.file))
            raise self._here().error(found, expected)
        above = self.open[-1] if self.open else None
        element = None
        if tag in _KEPT and (above is not None or self.root is None):
            line = self.parser.CurrentLineNumber
            element = Element(tag, line, attributes)
            if above is not None:
                above.children.append(element)
            else:
                self.root = element
        self.open.append(element)

    def _end(self, tag: str) -> None:
        self.open.pop()
