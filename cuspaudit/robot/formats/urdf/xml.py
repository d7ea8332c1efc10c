"""The links and joints of a URDF file, as text, read by a strict XML parser.

A document type declaration is refused where it begins, so no entity is ever defined;
nothing outside the file is opened; a malformed file is never repaired. Only children
of <robot> are links and joints: what extensions nest elsewhere is ignored.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn
from xml.parsers import expat

from cuspaudit.robot.place import Place, quoted

__all__ = ["JointElement", "RobotElement", "check_beginning", "file_bytes", "read_xml"]

_MOST_BYTES = 30_000_000
_MOST_DEPTH = 100
_BEGINNING = 65536
_BOM = b"\xef\xbb\xbf"
_PARTS = {"parent", "child", "origin", "axis", "limit", "mimic"}
_EXPAND = "end its name in .xacro, or expand it first: xacro FILE > robot.urdf"
_LEFT_BY_XACRO = {"property", "arg"}
_ROOTS = {
    "html": ("a saved web page", "download the file itself"),
    "mujoco": ("an MJCF model", "rename the file to end in .xml or .mjcf"),
    "sdf": ("an SDF model", "rename the file to end in .sdf"),
    "svg": ("a picture", "give the URDF"),
    "collada": ("a mesh", "give the URDF"),
}


@dataclass(slots=True)
class JointElement:
    """A <joint> of a URDF.

    Attributes:
        name: its name attribute, or "".
        kind: its type attribute, or "".
        line: where it begins.
        parts: the attributes of its parent, child, origin, axis, limit and mimic.
    """

    name: str
    kind: str
    line: int
    parts: dict[str, Mapping[str, str]] = field(default_factory=dict)

    @property
    def parent(self) -> str:
        """The link it stands on, "" when it names none."""
        return self.text("parent", "link") or ""

    @property
    def child(self) -> str:
        """The link it carries, "" when it names none."""
        return self.text("child", "link") or ""

    def text(self, part: str, attribute: str) -> str | None:
        """The attribute of a part, None when either is absent."""
        return self.parts.get(part, {}).get(attribute)

    def place(self, file: Place) -> Place:
        """Where this joint stands."""
        name = f"joint {quoted(self.name)} " if self.name else "joint "
        return file.at(f"{name}(line {self.line})")


@dataclass(slots=True)
class RobotElement:
    """The <robot> of a URDF: its name, its links with their lines, its joints."""

    name: str = ""
    links: dict[str, int] = field(default_factory=dict)
    joints: list[JointElement] = field(default_factory=list)


def read_xml(path: Path, place: Place) -> RobotElement:
    """The links and joints in ``path``, in file order.

    Raises:
        InvalidRobotError: it is not a well-formed URDF, or it has a document type
            declaration, or two links or joints of one name.
    """
    return _Reader(place).read(file_bytes(path, place))


def file_bytes(path: Path, place: Place) -> bytes:
    """The content of an XML file of at most 30 MB.

    Raises:
        InvalidRobotError: it cannot be read, or it is longer, or no such file.
    """
    try:
        if path.is_dir() or (path.exists() and not path.is_file()):
            raise place.error("not a regular file", "give a URDF file")
        with path.open("rb") as stream:
            content = stream.read(_MOST_BYTES + 1)
    except OSError as error:
        reason = error.strerror or "it cannot be read"
        raise place.error(reason, "give a readable file") from None
    if len(content) > _MOST_BYTES:
        raise place.error(f"more than {_MOST_BYTES} bytes", "give a URDF file")
    if content.startswith(b"version https://git-lfs"):
        raise place.error("a Git LFS pointer, not the file", "run git lfs pull")
    return content


def check_beginning(content: bytes, place: Place) -> None:
    """Check that nothing stands before the XML declaration, if there is one.

    Raises:
        InvalidRobotError: something does: a warning that was printed into the file.
    """
    start = content[:_BEGINNING].find(b"<?xml ")
    if start > 0 and b"<" not in content[:start] and content[:start] != _BOM:
        found = f"{start} bytes before <?xml"
        raise place.error(found, "delete what stands before <?xml")


class _Reader:
    """One pass over one file; handlers called by expat."""

    def __init__(self, place: Place) -> None:
        self.place = place
        self.robot = RobotElement()
        self.depth = 0
        self.encoding = ""
        self.namespace = ""
        self.joint: JointElement | None = None
        self.parser = expat.ParserCreate(namespace_separator=" ")
        self.parser.XmlDeclHandler = self._declaration
        self.parser.StartDoctypeDeclHandler = self._doctype
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end

    def read(self, content: bytes) -> RobotElement:
        """Parse ``content`` to its end."""
        check_beginning(content, self.place)
        try:
            self.parser.Parse(content, True)
        except expat.ExpatError as error:
            self._malformed(error)
        except (LookupError, ValueError):
            found = f"the encoding {quoted(self.encoding)} is unknown"
            raise self.place.error(found, "save the file as UTF-8") from None
        return self.robot

    def _malformed(self, error: expat.ExpatError) -> NoReturn:
        found = expat.ErrorString(error.code) or "not XML"
        if found == "unknown encoding":
            found = f"the encoding {quoted(self.encoding)} is unknown"
        here = self.place.at(f"line {error.lineno} column {error.offset + 1}")
        raise here.error(found, "give well-formed XML") from None

    def _line(self) -> Place:
        return self.place.at(f"line {self.parser.CurrentLineNumber}")

    def _declaration(self, version: str, encoding: str | None, alone: int) -> None:
        self.encoding = encoding or ""

    def _doctype(self, name: str, *rest: object) -> None:
        if name.lower() in _ROOTS:
            raise self._line().error(*_ROOTS[name.lower()])
        found = "a document type declaration"
        raise self._line().error(found, "remove it: a URDF has no DTD or entities")

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        self.depth += 1
        if self.depth > _MOST_DEPTH:
            found = f"more than {_MOST_DEPTH} nested elements"
            raise self._line().error(found, "give a URDF file")
        space, _, name = tag.rpartition(" ")
        if self.depth == 1:
            self._root(space, name, attributes)
        elif "xacro" in space and name not in _LEFT_BY_XACRO:
            found = f"the xacro element {quoted(name)}"
            raise self._line().error(found, _EXPAND)
        elif self.depth == 2 and space == self.namespace:
            self._child(name, attributes)
        elif self.depth == 3 and space == self.namespace:
            self._part(name, attributes)

    def _end(self, tag: str) -> None:
        self.depth -= 1
        if self.depth == 1:
            self.joint = None

    def _root(self, space: str, name: str, attributes: dict[str, str]) -> None:
        if name != "robot":
            kind, expected = _ROOTS.get(name.lower(), ("", "give a URDF file"))
            found = f"the root element is {quoted(name)}, not robot"
            raise self._line().error(f"{kind}: {found}" if kind else found, expected)
        self.namespace = space
        self.robot.name = attributes.get("name", "")

    def _child(self, name: str, attributes: dict[str, str]) -> None:
        line = self.parser.CurrentLineNumber
        if name == "link":
            self._link(attributes.get("name", ""), line)
        elif name == "joint":
            kind = attributes.get("type", "")
            self.joint = JointElement(attributes.get("name", ""), kind, line)
            self.robot.joints.append(self.joint)

    def _link(self, name: str, line: int) -> None:
        if not name:
            raise self._line().error("a link without a name", "name it")
        if name in self.robot.links:
            first = self.robot.links[name]
            found = f"link {quoted(name)} is already declared in line {first}"
            raise self._line().error(found, "give each link its own name")
        self.robot.links[name] = line

    def _part(self, name: str, attributes: dict[str, str]) -> None:
        if self.joint is None or name not in _PARTS:
            return
        here = self.joint.place(self.place)
        if name in self.joint.parts:
            raise here.error(f"two <{name}> elements", "leave one")
        for text in attributes.values():
            if "${" in text or "$(" in text:
                raise here.error(f"the xacro expression {quoted(text)}", _EXPAND)
        self.joint.parts[name] = attributes
