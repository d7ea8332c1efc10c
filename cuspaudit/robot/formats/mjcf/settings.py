"""What an MJCF file says once for all: units, Euler sequence, defaults by class.

An attribute of a joint is its own; else that of the class it names, or of the nearest
``childclass`` above it; else that of the class around that one, up to the main class.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from cuspaudit.robot.formats.elements import Element
from cuspaudit.robot.formats.mjcf.numbers import ORIENTATIONS
from cuspaudit.robot.place import Place, quoted

__all__ = ["CompilerSettings", "settings"]

Defaults = Mapping[str, Mapping[str, str]]

_MAIN = "main"
_TAGS = ("joint", "site")
_YES = {"true": True, "false": False}


@dataclass(frozen=True, slots=True)
class CompilerSettings:
    """The settings of a file.

    Attributes:
        degrees: whether bare angles are in degrees, which is MuJoCo's default.
        sequence: of Euler angles.
        autolimits: whether a range alone limits a joint.
        classes: by class, those around it included, and by tag (joint, site), the
            attributes that an element has unless it says otherwise.
    """

    degrees: bool
    sequence: str
    autolimits: bool
    classes: Mapping[str, Defaults]

    def given(
        self, element: Element, childclass: str | None, place: Place
    ) -> Mapping[str, str]:
        """The attributes of a joint or a site, defaults included.

        Raises:
            InvalidRobotError: its class is not there.
        """
        name = element.attributes.get("class", childclass) or _MAIN
        if name not in self.classes:
            found = f"the class {quoted(name)} is not in the file"
            raise place.error(found, "write its <default>, or another class")
        tag = "site" if element.tag == "site" else "joint"
        own = element.attributes
        around = self.classes[name][tag]
        if any(key in own for key in ORIENTATIONS):
            around = {k: v for k, v in around.items() if k not in ORIENTATIONS}
        return {**around, **own}


def settings(root: Element, place: Place) -> CompilerSettings:
    """The settings of a file; of several compilers the last word counts.

    Raises:
        InvalidRobotError: a word is unknown, coordinates are global, or a class stands
            twice.
    """
    words: dict[str, str] = {}
    for compiler in root.all("compiler"):
        words |= compiler.attributes
    here = place.at("compiler")
    unit = words.get("angle", "degree")
    if unit not in ("degree", "radian"):
        raise here.error(f"the angle {quoted(unit)}", "write degree or radian")
    sequence = words.get("eulerseq", "xyz")
    if len(sequence) != 3 or not set(sequence) <= set("xyzXYZ"):
        raise here.error(f"the eulerseq {quoted(sequence)}", "write three of x, y, z")
    if words.get("coordinate", "local") != "local":
        raise here.error("global coordinates", "write local ones, as MuJoCo 2.4 on")
    automatic = words.get("autolimits", "true")
    if automatic not in _YES:
        raise here.error(f"autolimits {quoted(automatic)}", "write true or false")
    classes: dict[str, Defaults] = {_MAIN: {tag: {} for tag in _TAGS}}
    for default in root.all("default"):
        _collect(default, {tag: {} for tag in _TAGS}, True, classes, place)
    return CompilerSettings(unit == "degree", sequence, _YES[automatic], classes)


def _collect(
    default: Element,
    around: Defaults,
    is_top: bool,
    classes: dict[str, Defaults],
    place: Place,
) -> None:
    """Add the class of a <default> and those inside it."""
    name = default.attributes.get("class", _MAIN if is_top else "")
    own = {
        tag: {**around[tag], **(classes[_MAIN][tag] if is_top else {})} for tag in _TAGS
    }
    for element in default.all(*_TAGS):
        own[element.tag] |= element.attributes
    if not name:
        raise default.place(place).error("a default without a class", "name its class")
    if name in classes and not is_top:
        found = f"the class {quoted(name)} stands twice"
        raise default.place(place).error(found, "name it once")
    classes[name] = own
    for inner in default.all("default"):
        _collect(inner, own, False, classes, place)
