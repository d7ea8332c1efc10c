"""Serial chains from URDF files, their numbers exactly as printed.

URDF places a joint by ``origin`` (xyz, then R = Rz(yaw) Ry(pitch) Rx(roll)) and moves
it about or along ``axis``, by default (1, 0, 0); what is absent is the identity. Fixed
joints are folded into the transforms between the moving ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np

from cuspaudit.errors import InvalidRobotError, UnsupportedJointError
from cuspaudit.robot.chain import Chain, Joint, JointKind, Motion, Translation
from cuspaudit.robot.formats.dh.rows import MOST_JOINTS
from cuspaudit.robot.formats.urdf.numbers import axis, limits, origin
from cuspaudit.robot.formats.urdf.tree import Tree, tree_from_robot
from cuspaudit.robot.formats.urdf.xml import JointElement, read_xml
from cuspaudit.robot.frames import transform
from cuspaudit.robot.place import Place, listing, quoted
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.task import check_limits, default_task, parse_task

__all__ = ["read_urdf"]

_KINDS: dict[str, JointKind] = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
}
_MOST_TIPS = 50
_ABSURD = Fraction(10**6)


def read_urdf(
    path: Path | str,
    base: str | None = None,
    tip: str | None = None,
    task: str | None = None,
) -> Robot:
    """The serial chain from ``base`` to ``tip`` of a URDF.

    Args:
        path: the file.
        base: a link; by default the root.
        tip: a link; by default the only end there is.
        task: a name in `robot.task.DIMENSIONS`; by default the
            one for so many joints.

    Raises:
        InvalidRobotError: the file is not a URDF with such a chain, or base or tip
            must be chosen among several.
        UnsupportedJointError: a joint on the chain has no exact model here.
    """
    path = Path(path)
    place = Place(str(path))
    if path.suffix == ".xacro":
        expected = "expand it first (pip install xacro): xacro FILE > robot.urdf"
        raise place.error("a xacro file", expected)
    robot = read_xml(path, place)
    tree = tree_from_robot(robot, place)
    notes: list[str] = []
    if base is None:
        base = tree.choose_base(tip, notes)
    tree.check_link(base)
    name = robot.name or path.stem
    chains = _chains(tree, name, base, tip, task, notes)
    chain, notes = _one_of(chains, tree, notes)
    notes += check_limits(chain, place) + _scale_notes(chain)
    return Robot(name, str(path), chain, urdf=path, notes=tuple(notes))


def _chains(
    tree: Tree,
    name: str,
    base: str,
    tip: str | None,
    task: str | None,
    notes: list[str],
) -> list[tuple[Chain, list[str]]]:
    """The chain to ``tip``, or to each end that the same moving joints carry."""
    if tip is not None:
        tree.check_link(tip)
        ends = [[tip]]
    else:
        ends = tree.ends(base)
    tips = [link for group in ends for link in group]
    if len(ends) > 1 or len(tips) > _MOST_TIPS:
        raise _several(tree, base, tips)
    return [_chain(tree, name, base, link, task, notes) for link in tips]


def _one_of(
    chains: Sequence[tuple[Chain, list[str]]], tree: Tree, notes: list[str]
) -> tuple[Chain, list[str]]:
    """The only chain, or the one with the most fixed joints after the last moving one.

    Unless the task is a pose, its verdict depends on the point, and may depend on the
    axes of its frame; then the tips must coincide.
    """
    chain, remarks = max(
        chains, key=lambda pair: len(tree.path(pair[0].base, pair[0].tip) or ())
    )
    if len(chains) > 1:
        tips = [other.tip for other, _ in chains]
        placed = np.array([transform(other.tool) for other, _ in chains])
        seen = placed[:, :3, 3] if chain.task == "position" else placed
        if chain.task != "pose" and float(np.ptp(seen, axis=0).max()) > 1e-12:
            raise _several(tree, chain.base, tips)
        remarks.append(f"tip {quoted(chain.tip)} taken among {listing(tips)}")
    return chain, remarks


def _chain(
    tree: Tree, name: str, base: str, tip: str, task: str | None, before: list[str]
) -> tuple[Chain, list[str]]:
    """The chain from ``base`` to ``tip``, and remarks on what was read."""
    path = tree.path(base, tip)
    if path is None:
        found = f"link {quoted(tip)} does not hang on link {quoted(base)}"
        raise tree.place.error(found, "choose a --base on the way to the root")
    moving = [joint for joint in path if joint.kind != "fixed"]
    if not moving:
        found = f"no moving joint between {quoted(base)} and {quoted(tip)}"
        raise tree.place.error(found, "choose another --tip or --base")
    if len(moving) > MOST_JOINTS:
        found = f"{len(moving)} joints between {quoted(base)} and {quoted(tip)}"
        raise tree.place.error(found, f"choose a chain of at most {MOST_JOINTS}")
    notes = list(before)
    joints: list[Joint] = []
    pending: tuple[Motion, ...] = ()
    for element in path:
        here = element.place(tree.place)
        pending += origin(element, here, notes)
        if element.kind != "fixed":
            joints.append(_joint(element, pending, here, notes))
            pending = ()
    chosen = parse_task(task, tree.place) if task else default_task(len(joints))
    return Chain(name, tuple(joints), pending, chosen, base, tip), notes


def _joint(
    element: JointElement, before: tuple[Motion, ...], place: Place, notes: list[str]
) -> Joint:
    kind = _kind(element, place)
    if "mimic" in element.parts:
        other = quoted(element.text("mimic", "joint") or "")
        raise UnsupportedJointError(
            file=place.file,
            where=place.where,
            found=f"it mimics joint {other}",
            expected="choose a chain whose joints move independently",
        )
    return Joint(
        name=element.name,
        kind=kind,
        before=before,
        axis=axis(element, place, notes),
        limits=limits(element, kind, place, notes),
    )


def _kind(element: JointElement, place: Place) -> JointKind:
    if element.kind in _KINDS:
        return _KINDS[element.kind]
    names = ", ".join([*_KINDS, "fixed"])
    if not element.kind:
        raise place.error("no type", f"write type= one of {names}")
    meant = element.kind.strip().lower()
    expected = f'write "{meant}"' if meant in _KINDS else f"supported are {names}"
    raise UnsupportedJointError(
        file=place.file,
        where=place.where,
        found=f"the joint type {quoted(element.kind)}",
        expected=expected,
    )


def _several(tree: Tree, base: str, tips: Sequence[str]) -> InvalidRobotError:
    """The error that lists the tips to choose from."""
    found = f"{len(tips)} possible tips: {listing(list(tips))}"
    fork = tree.fork(base, tips)
    expected = "choose one by --tip LINK"
    if fork != base:
        expected += f" ({quoted(fork)} is the link that carries them all)"
    return tree.place.error(found, expected)


def _scale_notes(chain: Chain) -> list[str]:
    """A remark when a length is so long that it must be a mistake."""
    motions = [m for joint in chain.joints for m in joint.before] + [*chain.tool]
    return [
        f"{motion.source} is longer than 1000 km: a mistake?"
        for motion in motions
        if isinstance(motion, Translation)
        and max(abs(x) for x in motion.vector) > _ABSURD
    ]
