"""The tree of a URDF's links, checked."""

from __future__ import annotations

from cuspaudit.robot.formats.tree import Tree
from cuspaudit.robot.formats.urdf.xml import JointElement, RobotElement
from cuspaudit.robot.place import Place, listing, quoted

__all__ = ["tree_from_robot"]


def tree_from_robot(robot: RobotElement, place: Place) -> Tree[JointElement]:
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


def _check_loops(tree: Tree[JointElement]) -> None:
    """Check that every link hangs on a root (each has at most one joint above)."""
    reached = set(tree.roots)
    waiting = list(tree.roots)
    while waiting:
        for joint in tree.below.get(waiting.pop(), []):
            reached.add(joint.child)
            waiting.append(joint.child)
    loose = [link for link in tree.links if link not in reached]
    if loose:
        found = f"the links {listing(loose)} form a loop"
        raise tree.place.error(found, "give a tree: one link that no joint carries")
