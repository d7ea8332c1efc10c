"""Where the links, joints and frames of a model stand to each other.

Each has a pose in another one: that of its ``relative_to``, else the model for a link,
the child link for a joint, what it is attached to for a frame. So the poses are a tree,
and the motion from one to another goes up to where their ways meet and down again:
what both ways share cancels, and the file's own numbers are left.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Motion,
    Rotation,
    Translation,
)
from cuspaudit.robot.formats.elements import Element
from cuspaudit.robot.formats.mjcf.numbers import quaternion_turns
from cuspaudit.robot.numbers import parse_decimal, printed_decimals
from cuspaudit.robot.place import Place, quoted

__all__ = ["MODEL", "FramePlace", "Poses", "poses"]

MODEL = "__model__"
_FORMATS = ("", "euler_rpy", "quat_xyzw")


@dataclass(frozen=True, slots=True)
class FramePlace:
    """How one of them stands: by ``motions``, left to right, from ``on``."""

    on: str
    motions: tuple[Motion, ...]


@dataclass(frozen=True, slots=True)
class Poses:
    """The stands of a model.

    Attributes:
        stands: of each link, joint and frame; the model itself has none.
        attached: frame to the link or frame that it is fixed on.
    """

    stands: Mapping[str, FramePlace]
    attached: Mapping[str, str]

    def between(self, first: str, second: str) -> tuple[Motion, ...]:
        """The motion from one to another."""
        ups, downs = self._ways(first), self._ways(second)
        while ups and downs and ups[-1] == downs[-1]:
            ups.pop()
            downs.pop()
        back = [_inverse(m) for name in ups for m in reversed(self._motions(name))]
        out = [m for name in reversed(downs) for m in self._motions(name)]
        return (*back, *out)

    def link_of(self, name: str) -> str:
        """The link that a frame is fixed on; a link itself."""
        while name in self.attached:
            name = self.attached[name]
        return name

    def _ways(self, name: str) -> list[str]:
        way = []
        while name in self.stands:
            way.append(name)
            name = self.stands[name].on
        return way

    def _motions(self, name: str) -> tuple[Motion, ...]:
        return self.stands[name].motions


def poses(model: Element, place: Place) -> Poses:
    """The stands of everything in a model.

    Raises:
        InvalidRobotError: a pose cannot be read, a name is missing, stands twice or
            is unknown, or poses form a loop.
    """
    stands: dict[str, FramePlace] = {}
    attached: dict[str, str] = {}
    elements = list(model.all("link", "joint", "frame"))
    for element in elements:
        here = element.place(place)
        name = element.attributes.get("name", "")
        if not name:
            raise here.error(f"a {element.tag} without a name", "name it")
        if name in stands or name in (MODEL, "world"):
            raise here.error("its name is already used", "give each its own name")
        on = MODEL
        if element.tag == "joint":
            child = element.one("child")
            on = child.text.strip() if child is not None else MODEL
        if element.tag == "frame":
            on = attached[name] = element.attributes.get("attached_to") or MODEL
        stands[name] = _stand(element, on, here)
    for element in elements:
        _check(element, stands, attached, element.place(place))
    return Poses(stands, attached)


def _stand(element: Element, usual: str, place: Place) -> FramePlace:
    """The pose of an element, in the frame it names or the usual one."""
    pose = element.one("pose")
    if pose is None:
        return FramePlace(usual, ())
    here = place.at("pose")
    on = pose.attributes.get("relative_to") or pose.attributes.get("frame") or usual
    form = pose.attributes.get("rotation_format", "")
    if form not in _FORMATS:
        raise here.error(f"the rotation_format {quoted(form)}", "write euler_rpy")
    words = pose.text.split() or ["0"] * 6
    count = 7 if form == "quat_xyzw" else 6
    if len(words) != count:
        raise here.error(
            f"{len(words)} numbers", f"write {count}: x y z, then the turn"
        )
    values = [parse_decimal(word, here) for word in words]
    decimals = tuple(map(printed_decimals, words))
    name = element.attributes["name"]
    x, y, z, *turn = values
    motions: list[Motion] = []
    if any((x, y, z)):
        motions.append(Translation((x, y, z), f"{name} pose xyz", decimals[:3]))
    if form == "quat_xyzw":
        a, b, c, w = turn
        motions += [
            Rotation(axis, angle, f"{name} pose quat")
            for axis, angle in quaternion_turns((w, a, b, c), here)
            if not angle.is_zero
        ]
        return FramePlace(on, tuple(motions))
    degrees = pose.attributes.get("degrees", "false").strip() in ("true", "1")
    for k, axis in ((2, Z_AXIS), (1, Y_AXIS), (0, X_AXIS)):
        if turn[k]:
            source = f"{name} pose rpy[{k}]"
            if degrees:
                motions.append(Rotation(axis, Angle(turn[k] / 180), source))
                continue
            own = decimals[3 + k :][:1]
            motions.append(Rotation(axis, Angle(radians=turn[k]), source, own))
    return FramePlace(on, tuple(motions))


def _check(
    element: Element,
    stands: Mapping[str, FramePlace],
    attached: Mapping[str, str],
    place: Place,
) -> None:
    """Check that the way up from an element ends at the model.

    Raises:
        InvalidRobotError: it meets an unknown name, or itself.
    """
    for ways in ({name: stand.on for name, stand in stands.items()}, attached):
        name, seen = element.attributes["name"], set()
        while name != MODEL and name in ways:
            seen.add(name)
            name = ways[name]
            if name in seen:
                raise place.error("its pose goes round in a loop", "break the loop")
        if name not in stands and name != MODEL:
            found = f"its pose stands on {quoted(name)}, which is not in the model"
            raise place.error(found, "name a link, joint or frame of it")


def _inverse(motion: Motion) -> Motion:
    if isinstance(motion, Translation):
        x, y, z = motion.vector
        return Translation((-x, -y, -z), motion.source, motion.decimals)
    return Rotation(motion.axis, -motion.angle, motion.source, motion.decimals)
