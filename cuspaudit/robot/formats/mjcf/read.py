"""Serial chains from MJCF files, read to the same chain as a URDF of the arm."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

from cuspaudit.errors import UnsupportedJointError
from cuspaudit.robot.chain import Chain, Joint, JointKind, Motion
from cuspaudit.robot.coupling import Coupling, uncoupled
from cuspaudit.robot.formats.choice import Build, Candidate
from cuspaudit.robot.formats.elements import Element, read_elements
from cuspaudit.robot.formats.format import MOST_JOINTS
from cuspaudit.robot.formats.mjcf.elements import MJCF_KINDS
from cuspaudit.robot.formats.mjcf.numbers import numbers
from cuspaudit.robot.formats.mjcf.settings import settings
from cuspaudit.robot.formats.mjcf.tree import WORLD, MjcfJoint, tree_from_elements
from cuspaudit.robot.formats.tree import Tree
from cuspaudit.robot.formats.tree_robot import chains_of_tree, robot_from_tree
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.task import default_task, parse_task

__all__ = ["mjcf_candidates", "read_mjcf"]


def read_mjcf(
    path: Path | str,
    base: str | None = None,
    tip: str | None = None,
    task: str | None = None,
) -> Robot:
    """The serial chain from ``base`` to ``tip`` of an MJCF model.

    Args:
        path: the file.
        base: a body; by default the world, or the body that floats.
        tip: a body or a site; by default the only body that is an end.
        task: a name in `robot.task.DIMENSIONS`; by default the
            one for so many joints.

    Raises:
        InvalidRobotError: the file is not an MJCF model with such a chain, or base or
            tip must be chosen among several.
        UnsupportedJointError: a joint on the chain has no exact model here.
    """
    path = Path(path)
    tree, build = _opened(path, task)
    return robot_from_tree(path, tree, build, base, tip, world=WORLD, marks_are="sites")


def mjcf_candidates(
    path: Path | str, base: str | None = None, most: int = 100
) -> list[Candidate]:
    """The serial chains of an MJCF model, likely ones first.

    Raises:
        InvalidRobotError: the file is not an MJCF model, or several bodies may be its
            base.
    """
    return chains_of_tree(*_opened(Path(path), None), base, most)


def _opened(path: Path, task: str | None) -> tuple[Tree[MjcfJoint], Build]:
    """The tree of a file, and how a chain is made of it."""
    place = Place(str(path))
    root = read_elements(path, place, MJCF_KINDS)
    tree = tree_from_elements(root, settings(root, place), place)
    name = root.attributes.get("model") or path.stem
    couplings = _couplings(root, tree)
    loops = list(_loops(root, tree))

    def build(base: str, tip: str) -> tuple[Chain, list[str]]:
        return _chain(tree, name, base, tip, task, couplings, loops)

    return tree, build


def _chain(
    tree: Tree[MjcfJoint],
    name: str,
    base: str,
    tip: str,
    task: str | None,
    couplings: Mapping[str, Coupling],
    loops: list[tuple[Element, frozenset[str]]],
) -> tuple[Chain, list[str]]:
    """The chain from ``base`` to ``tip``, and remarks on what was read."""
    path = tree.path(base, tip)
    if path is None:
        found = f"body {quoted(tip)} does not hang on {quoted(base)}"
        raise tree.place.error(found, "choose a --base on the way to the world")
    moving = [joint for joint in path if joint.kind != "fixed"]
    if not 0 < len(moving) <= MOST_JOINTS:
        found = f"{len(moving)} moving joints between {quoted(base)} and {quoted(tip)}"
        raise tree.place.error(found, f"choose a chain of 1 to {MOST_JOINTS}")
    for element, tied in loops:
        if any(joint.name in tied for joint in moving):
            found = f"a <{element.tag}> that ties joints of the chain in a loop"
            expected = "leave it out, or choose a serial chain"
            raise element.place(tree.place).error(found, expected)
    joints: list[Joint] = []
    pending: tuple[Motion, ...] = ()
    for edge in path:
        pending += edge.before
        if edge.kind == "fixed":
            continue
        if edge.kind not in ("revolute", "prismatic"):
            raise UnsupportedJointError(
                file=edge.place.file,
                where=edge.place.where,
                found=f"a {edge.kind} joint",
                expected="hinges and slides are supported",
            )
        kind: JointKind = "revolute" if edge.kind == "revolute" else "prismatic"
        joints.append(Joint(edge.name, kind, pending, edge.axis, edge.limits))
        pending = ()
    chain, remarks = uncoupled(
        Chain(name, tuple(joints), pending, base=base, tip=tip), couplings
    )
    count = len(chain.joints)
    chosen = parse_task(task, tree.place) if task else default_task(count)
    return replace(chain, task=chosen), remarks


def _couplings(root: Element, tree: Tree[MjcfJoint]) -> dict[str, Coupling]:
    """The joints that an equality makes a linear function of another.

    Raises:
        InvalidRobotError: an equality cannot be read, is not linear, or is one of
            tendons.
    """
    found: dict[str, Coupling] = {}
    known = {edge.name: edge for edge in tree.above.values()}
    for element in _active(root, "joint", "tendon"):
        here = element.place(tree.place)
        if element.tag == "tendon":
            raise here.error("an equality of tendons", "write it between two joints")
        driven = element.attributes.get("joint1", "")
        driver = element.attributes.get("joint2", "")
        text = element.attributes.get("polycoef", "0 1 0 0 0")
        words = text.split() + ["0"] * (5 - len(text.split()))
        offset, factor, *rest = numbers(" ".join(words), 5, here.at("polycoef"))
        if driven not in known or (driver and driver not in known):
            raise here.error("it names no joint of the file", "name one that is")
        if any(rest):
            raise here.error("a coupling that is not linear", "leave it out")
        multiplier = factor if driver else Fraction(0)
        own = known[driver].limits if driver else None
        found[driven] = Coupling(driver, multiplier, offset, here, own)
    return found


def _loops(
    root: Element, tree: Tree[MjcfJoint]
) -> Iterator[tuple[Element, frozenset[str]]]:
    """The equalities that close a loop, and the joints that they tie."""
    for element in _active(root, "connect", "weld"):
        ends = []
        for key in ("body1", "body2"):
            link = element.attributes.get(key, WORLD)
            path = tree.path(WORLD, link) if link in tree.above else ()
            ends.append({joint.name for joint in path or () if joint.kind != "fixed"})
        yield element, frozenset(ends[0] ^ ends[1])


def _active(root: Element, *tags: str) -> Iterator[Element]:
    for equality in root.all("equality"):
        for element in equality.all(*tags):
            if element.attributes.get("active", "true") != "false":
                yield element
