"""From the tree of a file to the robot that is meant, alike for every such format."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from pathlib import Path

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats.choice import (
    Build,
    Candidate,
    candidates,
    chains_beside,
    choose_chain,
)
from cuspaudit.robot.formats.tree import E, Tree
from cuspaudit.robot.place import quoted
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.task import check_limits

__all__ = ["chains_of_tree", "robot_from_tree"]


def robot_from_tree(
    path: Path,
    tree: Tree[E],
    build: Build,
    base: str | None,
    tip: str | None,
    *,
    urdf: Path | None = None,
    world: str | None = None,
    marks_are: str = "",
    remarks_on: Callable[[Chain], list[str]] = lambda chain: [],
) -> Robot:
    """The robot of the chain from ``base`` to ``tip``.

    Args:
        path: the file.
        tree: its tree.
        build: a chain of the tree.
        base: a link; None for the root.
        tip: a link or a mark; None for the only end.
        urdf: the file, where its meshes can be drawn.
        world: a link that a note on the base need not name.
        marks_are: what the format calls frames that are ends only when named.
        remarks_on: further notes on the chain.

    Raises:
        InvalidRobotError: there is no such chain, or base or tip must be chosen.
        UnsupportedJointError: a joint on the chain has no exact model here.
    """
    notes: list[str] = []
    base = tree.choose_base(tip, notes) if base is None else base
    tree.check_link(base)
    chain, remarks = choose_chain(tree, build, base, tip)
    if world is not None:
        notes = [note for note in notes if quoted(world) not in note]
    notes += [*remarks, *check_limits(chain, tree.place), *remarks_on(chain)]
    marks = tree.marks.get(chain.tip, ())
    if marks and chain.task != "pose":
        way = shlex.quote(marks[0])
        notes.append(f"{marks_are} on {quoted(chain.tip)} may be the tip: --tip {way}")
    beside = chains_beside(tree, build, chain)
    return Robot(
        chain.name, str(path), chain, urdf=urdf, notes=tuple(notes), beside=beside
    )


def chains_of_tree(
    tree: Tree[E], build: Build, base: str | None, most: int
) -> list[Candidate]:
    """The serial chains from ``base`` or the root, likely ones first.

    Raises:
        InvalidRobotError: several links may be the base, or there is no such link.
    """
    base = tree.choose_base(None, []) if base is None else base
    tree.check_link(base)
    return candidates(tree, build, base, most)
