"""Serial chains from SDF models, read to the same chain as a URDF of the arm.

A joint stands where its pose says, and moves about or along its axis, which is written
in its own frame, or in another one that it names (before SDF 1.5 in the model's). The
fixed motions of the chain are those from one joint to the next: the poses of the links
between them only carry those of the joints.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

from cuspaudit.errors import UnsupportedJointError
from cuspaudit.robot.axes import scaled_axis, unit_axis
from cuspaudit.robot.chain import Angle, Chain, Joint, JointKind, Motion, Rotation
from cuspaudit.robot.coupling import Coupling, uncoupled
from cuspaudit.robot.formats.choice import Build, Candidate
from cuspaudit.robot.formats.elements import Element, read_elements
from cuspaudit.robot.formats.format import MOST_JOINTS
from cuspaudit.robot.formats.sdf.elements import SDF_KINDS
from cuspaudit.robot.formats.sdf.poses import MODEL, Poses, poses
from cuspaudit.robot.formats.sdf.tree import WORLD, SdfJoint, tree_from_model
from cuspaudit.robot.formats.tree import Tree
from cuspaudit.robot.formats.tree_robot import chains_of_tree, robot_from_tree
from cuspaudit.robot.formats.urdf.numbers import Limits
from cuspaudit.robot.numbers import parse_decimal, printed_decimals
from cuspaudit.robot.place import Place, listing, quoted
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.task import default_task, parse_task

__all__ = ["read_sdf", "sdf_candidates"]

_KINDS: dict[str, JointKind] = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
}
_NO_LIMIT = Fraction(10**16)


def read_sdf(
    path: Path | str,
    base: str | None = None,
    tip: str | None = None,
    task: str | None = None,
) -> Robot:
    """The serial chain from ``base`` to ``tip`` of an SDF model.

    Args:
        path: the file.
        base: a link; by default the root.
        tip: a link or a frame; by default the only link that is an end.
        task: a name in `robot.task.DIMENSIONS`; by default the
            one for so many joints.

    Raises:
        InvalidRobotError: the file is not an SDF model with such a chain, or base or
            tip must be chosen among several.
        UnsupportedJointError: a joint on the chain has no exact model here.
    """
    path = Path(path)
    tree, build = _opened(path, task)
    return robot_from_tree(
        path, tree, build, base, tip, world=WORLD, marks_are="frames"
    )


def sdf_candidates(
    path: Path | str, base: str | None = None, most: int = 100
) -> list[Candidate]:
    """The serial chains of an SDF model, likely ones first.

    Raises:
        InvalidRobotError: the file is not an SDF model, or several links may be its
            base.
    """
    return chains_of_tree(*_opened(Path(path), None), base, most)


def _opened(path: Path, task: str | None) -> tuple[Tree[SdfJoint], Build]:
    """The tree of a file, and how a chain is made of it."""
    place = Place(str(path))
    root = read_elements(path, place, SDF_KINDS)
    model = _model(root, place)
    stands = poses(model, place)
    tree = tree_from_model(model, stands, place)
    name = model.attributes.get("name") or path.stem
    version = root.attributes.get("version", "").split(".")
    is_old = version[0] == "1" and version[1:2] in (["0"], ["2"], ["3"], ["4"])

    def build(base: str, tip: str) -> tuple[Chain, list[str]]:
        return _chain(tree, stands, name, base, tip, task, is_old)

    return tree, build


def _model(root: Element, place: Place) -> Element:
    """The only model with joints.

    Raises:
        InvalidRobotError: there is none or there are several, or it holds others.
    """
    models = [*root.all("model")]
    for world in root.all("world"):
        models += world.all("model")
    moving = [model for model in models if model.one("joint") or model.one("model")]
    if len(moving) != 1:
        found = f"{len(moving)} models with joints"
        names = [model.attributes.get("name", "?") for model in moving]
        expected = f"leave one of {listing(names)}" if names else "give an arm's model"
        raise place.error(found, expected)
    [model] = moving
    inner = model.one("model")
    if inner is not None:
        found = "a model inside a model"
        raise inner.place(place).error(found, "write its links and joints in its place")
    return model


def _chain(
    tree: Tree[SdfJoint],
    stands: Poses,
    name: str,
    base: str,
    tip: str,
    task: str | None,
    is_old: bool,
) -> tuple[Chain, list[str]]:
    """The chain from ``base`` to ``tip``, and remarks on what was read."""
    path = tree.path(base, tip)
    if path is None:
        found = f"link {quoted(tip)} does not hang on {quoted(base)}"
        raise tree.place.error(found, "choose a --base on the way to the root")
    moving = [edge for edge in path if edge.kind != "fixed"]
    if not 0 < len(moving) <= MOST_JOINTS:
        found = f"{len(moving)} moving joints between {quoted(base)} and {quoted(tip)}"
        raise tree.place.error(found, f"choose a chain of 1 to {MOST_JOINTS}")
    notes: list[str] = []
    joints: list[Joint] = []
    couplings: dict[str, Coupling] = {}
    last = MODEL if base == WORLD else base
    turned: tuple[Motion, ...] = ()
    for edge in moving:
        here = edge.element.place(tree.place)
        joint, turns = _joint(edge, stands, here, is_old, notes)
        # from where the last joint's axis is written to where this one's is
        before = (*_back(turned), *stands.between(last, edge.name), *turns)
        joints.append(replace(joint, before=before))
        last, turned = edge.name, turns
        coupling = _coupling(edge, tree, here)
        if coupling is not None:
            couplings[edge.name] = coupling
    tool = (*_back(turned), *stands.between(last, tip))
    chain, remarks = uncoupled(
        Chain(name, tuple(joints), tool, base=base, tip=tip), couplings
    )
    chosen = parse_task(task, tree.place) if task else default_task(len(chain.joints))
    return replace(chain, task=chosen), [*notes, *remarks]


def _back(turns: tuple[Motion, ...]) -> tuple[Motion, ...]:
    found = [turn for turn in reversed(turns) if isinstance(turn, Rotation)]
    return tuple(Rotation(t.axis, -t.angle, t.source, t.decimals) for t in found)


def _joint(
    edge: SdfJoint, stands: Poses, place: Place, is_old: bool, notes: list[str]
) -> tuple[Joint, tuple[Motion, ...]]:
    """A joint without what stands before it, and the turn to where its axis is."""
    if edge.kind not in _KINDS:
        raise UnsupportedJointError(
            file=place.file,
            where=place.where,
            found=f"the joint type {quoted(edge.kind)}",
            expected=f"supported are {', '.join([*_KINDS, 'fixed'])}",
        )
    kind = _KINDS[edge.kind]
    axis = edge.element.one("axis")
    if axis is None:
        raise place.error("no <axis>", "write <axis><xyz>0 0 1</xyz></axis>")
    xyz, parent_frame = axis.one("xyz"), axis.one("use_parent_model_frame")
    words = (xyz.text if xyz is not None else "0 0 1").split()
    here = place.at("axis xyz")
    if len(words) != 3:
        raise here.error(f"{len(words)} numbers", "write three decimal numbers")
    x, y, z = (parse_decimal(word, here) for word in words)
    if not any((x, y, z)):
        raise here.error("the zero vector", "write a direction")
    frame = "" if xyz is None else xyz.attributes.get("expressed_in", "")
    in_model = parent_frame is not None and parent_frame.text.strip() in ("1", "true")
    if is_old or in_model:
        frame = frame or MODEL
    if frame and frame != MODEL and frame not in stands.stands:
        found = f"it is expressed in {quoted(frame)}, which is not in the model"
        raise here.error(found, "name a link, joint or frame of it")
    way = stands.between(edge.name, frame) if frame else ()
    turns = tuple(motion for motion in way if isinstance(motion, Rotation))
    unit = unit_axis((x, y, z))
    if unit is None:
        notes.append(f"{edge.name} axis has no rational unit vector: direction kept")
    decimals = tuple(map(printed_decimals, words))
    printed = ((x, y, z), decimals) if xyz is not None else None
    limits = _limits(edge, axis, kind, place, notes)
    direction = unit or scaled_axis((x, y, z))
    joint = Joint(edge.name, kind, (), direction, limits, printed_axis=printed)
    return joint, turns


def _limits(
    edge: SdfJoint, axis: Element, kind: JointKind, place: Place, notes: list[str]
) -> Limits:
    """The limits of a joint; none where it turns freely or one is infinite."""
    limit = axis.one("limit")
    if limit is None or edge.kind == "continuous":
        return None
    found = []
    for tag in ("lower", "upper"):
        part = limit.one(tag)
        text = "" if part is None else part.text.strip()
        endless = not text or text.lower().lstrip("+-") in ("inf", "infinity")
        value = None if endless else parse_decimal(text, place.at(tag))
        found.append(None if value is None or abs(value) >= _NO_LIMIT else value)
    low, high = found
    if low is None or high is None:
        if low is not high:
            notes.append(f"{edge.name} has an infinite limit: read as unlimited")
        return None
    if low == high:
        notes.append(f"{edge.name} has equal limits: read as unlimited")
        return None
    if kind == "prismatic":
        return low, high
    return Angle(radians=low), Angle(radians=high)


def _coupling(edge: SdfJoint, tree: Tree[SdfJoint], place: Place) -> Coupling | None:
    """How a joint is driven by another; None when it moves freely.

    Raises:
        InvalidRobotError: there is no such joint, or a number cannot be read.
    """
    axis = edge.element.one("axis")
    mimic = axis.one("mimic") if axis is not None else None
    if mimic is None:
        return None
    here = place.at("mimic")
    driver = mimic.attributes.get("joint", "")
    drivers = [joint for joint in tree.above.values() if joint.name == driver]
    if not drivers:
        found = f"it mimics joint {quoted(driver)}, which is not in the model"
        raise here.error(found, "name one that is")
    numbers = []
    for tag, usual in (("multiplier", 1), ("offset", 0), ("reference", 0)):
        part = mimic.one(tag)
        value = Fraction(usual)
        if part is not None:
            value = parse_decimal(part.text.strip(), here.at(tag))
        numbers.append(value)
    factor, offset, reference = numbers
    outer, kind = drivers[0].element.one("axis"), _KINDS.get(drivers[0].kind)
    own = None
    if outer is not None and kind is not None:
        own = _limits(drivers[0], outer, kind, here, [])
    return Coupling(driver, factor, offset - factor * reference, here, own)
