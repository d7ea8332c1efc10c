"""Serial chains from URDF files, their numbers exactly as printed.

URDF places a joint by ``origin`` (xyz, then R = Rz(yaw) Ry(pitch) Rx(roll)) and moves
it about or along ``axis``, by default (1, 0, 0); what is absent is the identity. Fixed
joints are folded into the transforms between the moving ones.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

from cuspaudit.errors import UnsupportedJointError
from cuspaudit.robot.chain import Chain, Joint, JointKind, Motion, Translation
from cuspaudit.robot.coupling import Coupling, uncoupled
from cuspaudit.robot.formats.choice import Build, Candidate
from cuspaudit.robot.formats.format import MOST_JOINTS
from cuspaudit.robot.formats.tree import Tree
from cuspaudit.robot.formats.tree_robot import chains_of_tree, robot_from_tree
from cuspaudit.robot.formats.urdf.numbers import axis, limits, origin
from cuspaudit.robot.formats.urdf.tree import tree_from_robot
from cuspaudit.robot.formats.urdf.xml import JointElement, read_xml
from cuspaudit.robot.numbers import parse_decimal
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.task import default_task, parse_task

__all__ = ["read_urdf", "urdf_candidates"]

_KINDS: dict[str, JointKind] = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
}
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
    tree, name = _opened(path)
    build = _builder(tree, name, task)
    return robot_from_tree(
        path, tree, build, base, tip, urdf=path, remarks_on=_scale_notes
    )


def urdf_candidates(
    path: Path | str, base: str | None = None, most: int = 100
) -> list[Candidate]:
    """The serial chains of a URDF, likely ones first; see `choice.candidates`.

    Raises:
        InvalidRobotError: the file is not a URDF, or several links may be its base.
    """
    tree, name = _opened(Path(path))
    return chains_of_tree(tree, _builder(tree, name, None), base, most)


def _opened(path: Path) -> tuple[Tree[JointElement], str]:
    """The tree of a URDF, and the robot's name."""
    place = Place(str(path))
    robot = read_xml(path, place)
    return tree_from_robot(robot, place), robot.name or path.stem


def _builder(tree: Tree[JointElement], name: str, task: str | None) -> Build:
    return lambda base, tip: _chain(tree, name, base, tip, task)


def _chain(
    tree: Tree[JointElement], name: str, base: str, tip: str, task: str | None
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
    notes: list[str] = []
    joints: list[Joint] = []
    pending: tuple[Motion, ...] = ()
    for element in path:
        here = element.place(tree.place)
        pending += origin(element, here, notes)
        if element.kind != "fixed":
            joints.append(_joint(element, pending, here, notes))
            pending = ()
    couplings = {e.name: _coupling(e, tree) for e in path if "mimic" in e.parts}
    chain, remarks = uncoupled(
        Chain(name, tuple(joints), pending, base=base, tip=tip), couplings
    )
    count = len(chain.joints)
    chosen = parse_task(task, tree.place) if task else default_task(count)
    return replace(chain, task=chosen), notes + remarks


def _coupling(element: JointElement, tree: Tree[JointElement]) -> Coupling:
    """How a joint is driven by another.

    Raises:
        InvalidRobotError: there is no such joint, or a number cannot be read.
    """
    here = element.place(tree.place)
    driver = element.text("mimic", "joint") or ""
    drivers = [joint for joint in tree.above.values() if joint.name == driver]
    if not drivers:
        found = f"it mimics joint {quoted(driver)}, which is not in the file"
        raise here.error(found, "name one that is")
    numbers = (element.text("mimic", name) for name in ("multiplier", "offset"))
    multiplier, offset = (
        None if text is None else parse_decimal(text, here.at("mimic"))
        for text in numbers
    )
    one = Fraction(1) if multiplier is None else multiplier
    kind = _KINDS.get(drivers[0].kind)
    own = None if kind is None else limits(drivers[0], kind, here, [])
    return Coupling(driver, one, offset or Fraction(0), here, own)


def _joint(
    element: JointElement, before: tuple[Motion, ...], place: Place, notes: list[str]
) -> Joint:
    kind = _kind(element, place)
    direction, printed = axis(element, place, notes)
    return Joint(
        name=element.name,
        kind=kind,
        before=before,
        axis=direction,
        limits=limits(element, kind, place, notes),
        printed_axis=printed,
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


def _scale_notes(chain: Chain) -> list[str]:
    """A remark when a length is so long that it must be a mistake."""
    motions = [m for joint in chain.joints for m in joint.before] + [*chain.tool]
    return [
        f"{motion.source} is longer than 1000 km: a mistake?"
        for motion in motions
        if isinstance(motion, Translation)
        and max(abs(x) for x in motion.vector) > _ABSURD
    ]
