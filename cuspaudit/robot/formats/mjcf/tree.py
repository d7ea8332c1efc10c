"""The tree of an MJCF file: bodies as links, and between two of them their joints.

A body stands in the frame of the one around it by its position and orientation; its
joints then move it in file order, each about or along its axis through its own anchor,
in the body's frame as the joints before it have moved it. Between the joints of one
body stand links of our own making, named BODY/JOINT. A body without joints is fixed. A
site is a frame fixed on its body, which ends a chain where it is named.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from cuspaudit.robot.axes import unit_axis
from cuspaudit.robot.chain import Z_AXIS, Motion, Rotation, Translation, Vector
from cuspaudit.robot.formats.elements import Element
from cuspaudit.robot.formats.mjcf.numbers import (
    angle,
    direction,
    numbers,
    orientation,
    turn_of_z,
    vector,
)
from cuspaudit.robot.formats.mjcf.settings import CompilerSettings
from cuspaudit.robot.formats.tree import Tree
from cuspaudit.robot.formats.urdf.numbers import Limits
from cuspaudit.robot.place import Place, quoted

__all__ = ["WORLD", "MjcfJoint", "tree_from_elements"]

WORLD = "world"
_KINDS = {"hinge": "revolute", "slide": "prismatic", "ball": "ball", "free": "free"}


@dataclass(frozen=True, slots=True)
class MjcfJoint:
    """An edge of the tree.

    Attributes:
        name: of the joint, or of the body that is fixed.
        kind: "revolute", "prismatic", "fixed", or one that no chain has.
        parent: the link it stands on.
        child: the link it carries.
        before: the fixed transform that stands before it.
        axis: of a moving joint.
        limits: of its value, None when it has none.
        place: where the file has it.
    """

    name: str
    kind: str
    parent: str
    child: str
    before: tuple[Motion, ...]
    axis: Vector
    limits: Limits
    place: Place


def tree_from_elements(
    root: Element, settings: CompilerSettings, place: Place
) -> Tree[MjcfJoint]:
    """The tree below the world.

    Raises:
        InvalidRobotError: there is no body, a name stands twice, or a number or a
            class cannot be read.
    """
    builder = _Builder(settings, place)
    for world in root.all("worldbody"):
        builder.inside(world, WORLD, (), world.attributes.get("childclass"))
    if not builder.above:
        raise place.error("no body", "give an MJCF model with <body> elements")
    links = [WORLD, *builder.above, *builder.free]
    return Tree(place, links, builder.above, builder.below, builder.marked())


class _Builder:
    """Walks down the bodies."""

    def __init__(self, settings: CompilerSettings, place: Place) -> None:
        self.settings = settings
        self.place = place
        self.above: dict[str, MjcfJoint] = {}
        self.below: dict[str, list[MjcfJoint]] = {}
        self.free: list[str] = []
        self.names: dict[str, int] = {}
        self.sites: list[MjcfJoint] = []

    def inside(
        self,
        element: Element,
        link: str,
        frame: tuple[Motion, ...],
        childclass: str | None,
    ) -> None:
        """The bodies and frames directly inside an element.

        Args:
            element: a body, a frame or the world.
            link: the body it belongs to.
            frame: the motions from that body to it.
            childclass: the class that joints inside it have by default.
        """
        for site in element.all("site"):
            self._site(site, link, frame, childclass)
        for child in element.all("body", "frame"):
            inner = child.attributes.get("childclass", childclass)
            placed = frame + self._pose(child, child.attributes)
            if child.tag == "frame":
                self.inside(child, link, placed, inner)
            else:
                self.inside(child, self._body(child, link, placed, inner), (), inner)

    def marked(self) -> dict[str, list[str]]:
        """The sites by the body they stand on; each is a link that carries nothing.

        A site with the name of a body is called BODY/SITE.
        """
        found: dict[str, list[str]] = {}
        for site in self.sites:
            name = site.name
            if name in self.above or name in self.free or name == WORLD:
                name = f"{site.parent}/{name}"
            self.above[name] = replace(site, child=name)
            found.setdefault(site.parent, []).append(name)
        return found

    def _site(
        self,
        site: Element,
        link: str,
        frame: tuple[Motion, ...],
        childclass: str | None,
    ) -> None:
        """Add a site that has a name."""
        if not site.attributes.get("name"):
            return
        here = site.place(self.place)
        name = self._unique(site, "")
        given = self.settings.given(site, childclass, here)
        before = frame + self._pose(site, given)
        self.sites.append(
            MjcfJoint(name, "fixed", link, name, before, Z_AXIS, None, here)
        )

    def _pose(self, element: Element, given: Mapping[str, str]) -> tuple[Motion, ...]:
        here = element.place(self.place)
        name = element.attributes.get("name", "")
        motions: tuple[Motion, ...] = ()
        if "fromto" in given:
            return _between(numbers(given["fromto"], 6, here.at("fromto")), name, here)
        if "pos" in given:
            step = vector(given["pos"], here.at("pos"))
            if any(step):
                motions = (Translation(step, f"{name} pos xyz"),)
        unit, sequence = self.settings.degrees, self.settings.sequence
        return motions + orientation(given, unit, sequence, name, here)

    def _body(
        self,
        body: Element,
        parent: str,
        before: tuple[Motion, ...],
        childclass: str | None,
    ) -> str:
        """Add a body and its joints; its name."""
        here = body.place(self.place)
        name = self._unique(body, f"body_{len(self.above) + len(self.free) + 1}")
        joints = list(body.all("joint", "freejoint"))
        link = parent
        for number, element in enumerate(joints, 1):
            spot = element.place(self.place)
            given = self.settings.given(element, childclass, spot)
            kind = "free" if element.tag == "freejoint" else given.get("type", "hinge")
            if kind not in _KINDS:
                expected = f"write one of {', '.join(_KINDS)}"
                raise spot.error(f"the joint type {quoted(kind)}", expected)
            if kind == "free":
                self.free.append(name)
                return name
            title = self._unique(element, f"joint_{len(self.names) + 1}")
            anchor = vector(given.get("pos", "0 0 0"), spot.at("pos"))
            step = (Translation(anchor, f"{title} pos xyz"),) if any(anchor) else ()
            is_last = number == len(joints) and not step
            child = name if is_last else f"{name}/{title}"
            axis = direction(given.get("axis", "0 0 1"), spot.at("axis"))
            before += step + self._reference(given, kind, axis, title, spot)
            limits = self._limits(given, kind, spot)
            edge = MjcfJoint(
                title, _KINDS[kind], link, child, before, axis, limits, spot
            )
            self._add(edge)
            link, before = child, tuple(_opposite(motion) for motion in step)
        if link != name:
            fixed = MjcfJoint(name, "fixed", link, name, before, Z_AXIS, None, here)
            self._add(fixed)
        return name

    def _add(self, edge: MjcfJoint) -> None:
        self.above[edge.child] = edge
        self.below.setdefault(edge.parent, []).append(edge)

    def _unique(self, element: Element, unnamed: str) -> str:
        """The name of a body or a joint; each kind has names of its own."""
        name = element.attributes.get("name") or unnamed
        kind = element.tag if element.tag in ("body", "site") else "joint"
        key = f"{kind} {name}"
        if key in self.names or (element.tag == "body" and name == WORLD):
            first = self.names.get(key, 0)
            found = f"its name is already used{f' in line {first}' if first else ''}"
            raise element.place(self.place).error(found, "give each its own name")
        self.names[key] = element.line
        return name

    def _reference(
        self,
        given: Mapping[str, str],
        kind: str,
        axis: Vector,
        name: str,
        place: Place,
    ) -> tuple[Motion, ...]:
        """The motion by the joint's reference value, backwards: there it is at rest."""
        [ref] = numbers(given.get("ref", "0"), 1, place.at("ref"))
        if not ref or kind == "ball":
            return ()
        if kind == "hinge":
            turn = angle(-ref, self.settings.degrees)
            return (Rotation(axis, turn, f"{name} ref"),)
        unit = unit_axis(axis)
        if unit is None:
            found = "a reference along an axis without a rational unit vector"
            raise place.error(found, "write ref=0 or another axis")
        x, y, z = unit
        return (Translation((-ref * x, -ref * y, -ref * z), f"{name} ref"),)

    def _limits(self, given: Mapping[str, str], kind: str, place: Place) -> Limits:
        limited = given.get("limited", "auto")
        if limited not in ("true", "false", "auto"):
            raise place.error(f"limited {quoted(limited)}", "write true, false or auto")
        automatic = self.settings.autolimits and "range" in given
        if limited == "false" or (limited == "auto" and not automatic):
            return None
        if kind == "ball":
            return None
        lower, upper = numbers(given.get("range", "0 0"), 2, place.at("range"))
        if lower == upper:
            return None
        if kind == "slide":
            return lower, upper
        degrees = self.settings.degrees
        return angle(lower, degrees), angle(upper, degrees)


def _between(ends: Sequence[Fraction], name: str, place: Place) -> tuple[Motion, ...]:
    """To the middle of two points, z from the second to the first."""
    pairs = list(zip(ends[:3], ends[3:], strict=True))
    x, y, z = ((a + b) / 2 for a, b in pairs)
    u, v, w = (a - b for a, b in pairs)
    turns = turn_of_z((u, v, w), place.at("fromto"))
    return (
        Translation((x, y, z), f"{name} fromto xyz"),
        *(Rotation(axis, turn, f"{name} fromto") for axis, turn in turns),
    )


def _opposite(step: Translation) -> Motion:
    x, y, z = step.vector
    return Translation((-x, -y, -z), step.source)
