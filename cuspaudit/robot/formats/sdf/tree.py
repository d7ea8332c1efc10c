"""The tree of an SDF model: links, and the joints between them.

A joint stands between the links that its parent and child are fixed on. Frames are
fixed on links too; each ends a chain where it is named.
"""

from __future__ import annotations

from dataclasses import dataclass

from cuspaudit.robot.formats.elements import Element
from cuspaudit.robot.formats.sdf.poses import MODEL, Poses
from cuspaudit.robot.formats.tree import Tree
from cuspaudit.robot.place import Place, listing, quoted

__all__ = ["WORLD", "SdfJoint", "tree_from_model"]

WORLD = "world"


@dataclass(frozen=True, slots=True)
class SdfJoint:
    """An edge of the tree.

    Attributes:
        name: of the joint, or of a frame.
        kind: its type as the file has it; "fixed" of a frame.
        parent: the link it stands on.
        child: the link it carries, or the frame.
        element: the joint or frame itself.
    """

    name: str
    kind: str
    parent: str
    child: str
    element: Element


def tree_from_model(model: Element, stands: Poses, place: Place) -> Tree[SdfJoint]:
    """The tree of a model.

    Raises:
        InvalidRobotError: there is no joint, an end of one is missing or unknown, a
            link is carried twice, or joints form a loop.
    """
    links = [WORLD, *(link.attributes["name"] for link in model.all("link"))]
    above: dict[str, SdfJoint] = {}
    below: dict[str, list[SdfJoint]] = {}
    for element in model.all("joint"):
        joint = _joint(element, stands, links, element.place(place))
        if joint.child in above:
            other = quoted(above[joint.child].name)
            found = f"its child {quoted(joint.child)} is already that of joint {other}"
            raise element.place(place).error(found, "let one joint carry each link")
        above[joint.child] = joint
        below.setdefault(joint.parent, []).append(joint)
    if not above:
        raise place.error("no joints", "give a model with <joint> elements")
    _check_loops(above, place)
    marks: dict[str, list[str]] = {}
    for frame in model.all("frame"):
        name = frame.attributes["name"]
        link = stands.link_of(name)
        if link in links:
            above[name] = SdfJoint(name, "fixed", link, name, frame)
            marks.setdefault(link, []).append(name)
    return Tree(place, links, above, below, marks)


def _joint(element: Element, stands: Poses, links: list[str], place: Place) -> SdfJoint:
    ends = []
    for tag in ("parent", "child"):
        end = element.one(tag)
        name = end.text.strip() if end is not None else ""
        if not name:
            raise place.error(f"no {tag}", f"write <{tag}>NAME</{tag}>")
        link = WORLD if name == WORLD and tag == "parent" else stands.link_of(name)
        if link == MODEL and tag == "parent":
            link = WORLD
        if link not in links or (link == WORLD and tag == "child"):
            found = f"its {tag} {quoted(name)} is no link of the model"
            raise place.error(found, "name a link, or a frame fixed on one")
        ends.append(link)
    if ends[0] == ends[1]:
        raise place.error(
            f"parent and child are one link {quoted(ends[0])}", "join two"
        )
    kind = element.attributes.get("type", "")
    name = element.attributes["name"]
    return SdfJoint(name, kind, ends[0], ends[1], element)


def _check_loops(above: dict[str, SdfJoint], place: Place) -> None:
    """Check that the way up from every link ends."""
    good: set[str] = set()
    for start in above:
        seen: list[str] = []
        link = start
        while link in above and link not in good:
            if link in seen:
                found = f"the links {listing(seen[seen.index(link) :])} form a loop"
                raise place.error(found, "give a tree: one link that no joint carries")
            seen.append(link)
            link = above[link].parent
        good.update(seen)
