"""The tree of a URDF's links, and the one path through it that is the chain.

Which link is the tip can change the verdict, so it is taken without being named only
when there is one place it can be; otherwise the candidates are listed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cuspaudit.robot.formats.urdf.xml import JointElement, RobotElement
from cuspaudit.robot.place import Place, listing, quoted

__all__ = ["Tree", "tree_from_robot"]

Path = tuple[JointElement, ...]


@dataclass(frozen=True, slots=True)
class Tree:
    """The links of a URDF, joined.

    Attributes:
        place: the file.
        links: every link, in file order.
        above: link to the joint that carries it; roots are absent.
        below: link to the joints it carries, in file order.
    """

    place: Place
    links: Sequence[str]
    above: dict[str, JointElement]
    below: dict[str, list[JointElement]]

    @property
    def roots(self) -> list[str]:
        """The links that no joint carries."""
        return [link for link in self.links if link not in self.above]

    def path(self, base: str, tip: str) -> Path | None:
        """The joints from ``base`` out to ``tip``, None if base is not above tip."""
        joints = []
        while tip != base:
            if tip not in self.above:
                return None
            joints.append(self.above[tip])
            tip = _parent(self.above[tip])
        return tuple(reversed(joints))

    def leaves(self, base: str) -> list[str]:
        """The links at or below ``base`` that carry no joint, in depth-first order."""
        found, waiting = [], [base]
        while waiting:
            link = waiting.pop()
            carried = [_child(joint) for joint in self.below.get(link, [])]
            waiting.extend(reversed(carried))
            if not carried:
                found.append(link)
        return found

    def choose_base(self, tip: str | None, notes: list[str]) -> str:
        """The root above ``tip``, or the only root that carries a joint."""
        if tip is not None:
            self.check_link(tip)
            while tip in self.above:
                tip = _parent(self.above[tip])
            return tip
        carrying = [link for link in self.roots if link in self.below]
        if len(carrying) > 1:
            found = f"{len(carrying)} links that no joint carries: {listing(carrying)}"
            raise self.place.error(found, "choose one by --base LINK")
        for link in self.roots:
            if link not in carrying:
                notes.append(f"link {quoted(link)} is attached to nothing: left out")
        return carrying[0]

    def check_link(self, name: str) -> None:
        """Check that there is a link ``name``.

        Raises:
            InvalidRobotError: there is none.
        """
        if name not in self.links:
            found = f"no link is named {quoted(name)}"
            raise self.place.error(found, f"the links are {listing(list(self.links))}")

    def ends(self, base: str) -> list[list[str]]:
        """The leaves below ``base``, grouped by the moving joints that carry them.

        A leaf is left out when another one is carried by the same moving joints and
        more: a flange of the base, a camera of the forearm.
        """
        groups: dict[tuple[str, ...], list[str]] = {}
        for leaf in self.leaves(base):
            moving = tuple(j.name for j in self.path(base, leaf) or () if _moves(j))
            groups.setdefault(moving, []).append(leaf)
        inner = {key[:k] for key in groups for k in range(len(key))}
        return [group for key, group in groups.items() if key not in inner]

    def fork(self, base: str, tips: Sequence[str]) -> str:
        """The last link that is above all ``tips``."""
        paths = [self.path(base, tip) or () for tip in tips]
        link = base
        for joints in zip(*paths, strict=False):
            if any(joint is not joints[0] for joint in joints):
                break
            link = _child(joints[0])
        return link


def tree_from_robot(robot: RobotElement, place: Place) -> Tree:
    """The tree of ``robot``.

    Raises:
        InvalidRobotError: a joint lacks a name, parent or child, a link is not
            declared or carried twice, a name is used twice, or joints form a loop.
    """
    if not robot.joints:
        raise place.error("no joints", "give a URDF with <joint> elements in <robot>")
    above: dict[str, JointElement] = {}
    below: dict[str, list[JointElement]] = {}
    names: dict[str, int] = {}
    for joint in robot.joints:
        here = joint.place(place)
        _check_name(joint, names, here)
        parent, child = _ends(joint, robot, here)
        if child in above:
            other = quoted(above[child].name)
            found = f"its child link {quoted(child)} is already that of joint {other}"
            raise here.error(found, "let one joint carry each link")
        above[child] = joint
        below.setdefault(parent, []).append(joint)
    tree = Tree(place, list(robot.links), above, below)
    _check_loops(tree)
    return tree


def _check_name(joint: JointElement, names: dict[str, int], here: Place) -> None:
    if not joint.name:
        raise here.error("a joint without a name", "name it")
    if joint.name in names:
        found = f"its name is already used in line {names[joint.name]}"
        raise here.error(found, "give each joint its own name")
    names[joint.name] = joint.line


def _ends(joint: JointElement, robot: RobotElement, here: Place) -> tuple[str, str]:
    """The parent and child link of ``joint``, both declared and not the same."""
    links = []
    for part in ("parent", "child"):
        link = joint.text(part, "link")
        if not link:
            found = f"no {part} link"
            raise here.error(found, f'write <{part} link="NAME"/>')
        if link not in robot.links:
            found = f"its {part} link {quoted(link)} is not declared"
            raise here.error(found, "add the <link> or correct the name")
        links.append(link)
    if links[0] == links[1]:
        found = f"parent and child are the same link {quoted(links[0])}"
        raise here.error(found, "join two links")
    return links[0], links[1]


def _check_loops(tree: Tree) -> None:
    """Check that every link hangs on a root (each has at most one joint above)."""
    reached = set(tree.roots)
    waiting = list(tree.roots)
    while waiting:
        for joint in tree.below.get(waiting.pop(), []):
            reached.add(_child(joint))
            waiting.append(_child(joint))
    loose = [link for link in tree.links if link not in reached]
    if loose:
        found = f"the links {listing(loose)} form a loop"
        raise tree.place.error(found, "give a tree: one link that no joint carries")


def _moves(joint: JointElement) -> bool:
    return joint.kind != "fixed"


def _parent(joint: JointElement) -> str:
    return joint.parts["parent"]["link"]


def _child(joint: JointElement) -> str:
    return joint.parts["child"]["link"]
