"""What a URDF says its links look like, placed on the joints of a chain.

For drawing only: nothing here reaches a verdict, a missing mesh is no error, and a
description that cannot be understood gives no shapes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Chain, Motion
from cuspaudit.robot.formats.tree import Tree
from cuspaudit.robot.formats.urdf.numbers import origin
from cuspaudit.robot.formats.urdf.tree import tree_from_robot
from cuspaudit.robot.formats.urdf.xml import JointElement, read_xml
from cuspaudit.robot.frames import transform
from cuspaudit.robot.place import Place
from cuspaudit.robot.robot import Robot

__all__ = ["LinkVisual", "visuals"]

Matrix = NDArray[np.float64]

_PROBLEMS = (
    *(ArithmeticError, AttributeError, IndexError, KeyError, OSError),
    *(SyntaxError, TypeError, ValueError),
)


@dataclass(frozen=True, slots=True, eq=False)
class LinkVisual:
    """One visual shape of a link.

    Attributes:
        link: the link's name.
        joint_index: the joint of the chain that carries it, -1 for the base.
        kind: "mesh", "box", "cylinder" (along its z) or "sphere".
        path: the mesh file, None when there is none or it was not found.
        size: box: three sides; cylinder: radius, length; sphere: radius; mesh: ().
        scale: three factors for a mesh.
        origin: (4, 4) placement in the frame of the joint after its motion.
        rgba: colour, each from 0 to 1, or None.
    """

    link: str
    joint_index: int
    kind: str
    path: Path | None
    size: tuple[float, ...]
    scale: tuple[float, ...]
    origin: Matrix
    rgba: tuple[float, ...] | None


def visuals(robot: Robot, packages: Sequence[Path] = ()) -> tuple[LinkVisual, ...]:
    """The shapes of the links at or below the base of ``robot``'s chain.

    Args:
        robot: its chain as read, snapped or with joints locked; joints that are not
            on it stand at 0.
        packages: folders in which package:// addresses are looked up, besides the
            folders above the URDF.
    """
    if robot.urdf is None:
        return ()
    place = Place(robot.file)
    try:
        tree = tree_from_robot(read_xml(robot.urdf, place), place)
    except InvalidRobotError:
        return ()
    model = _model(robot.urdf)
    if model is None:
        return ()
    colours = {m.name: _rgba(m) for m in model.materials}
    links = {link.name: link.visuals for link in model.links}
    result = []
    for name, index, placed in _placed_links(tree, robot.chain):
        for visual in links.get(name, []):
            shape = _shape(visual, _Lookup(robot.urdf, packages))
            if shape is None:
                continue
            kind, path, size, scale = shape
            own = np.eye(4) if visual.origin is None else np.asarray(visual.origin)
            rgba = _colour(visual.material, colours)
            result.append(
                LinkVisual(name, index, kind, path, size, scale, placed @ own, rgba)
            )
    return tuple(result)


@dataclass(frozen=True, slots=True)
class _Lookup:
    """Where meshes are looked for."""

    urdf: Path
    packages: Sequence[Path]

    def find(self, address: str) -> Path | None:
        """The file of a mesh address, None when there is none."""
        scheme, found, rest = address.partition("://")
        if not found:
            return _existing([self.urdf.parent / address])
        if scheme == "file":
            return _existing([Path(rest)])
        if scheme != "package":
            return None
        package, _, inside = rest.partition("/")
        folders = [*self.urdf.resolve().parents, *self.packages]
        named = [folder / inside for folder in folders if folder.name == package]
        return _existing([*named, *(folder / rest for folder in folders)])


def _existing(paths: Sequence[Path]) -> Path | None:
    return next((path for path in paths if path.is_file()), None)


def _model(path: Path) -> Any:
    """The description of ``path`` as yourdfpy reads it, None when it cannot."""
    import yourdfpy  # here because it loads trimesh, which only a drawing needs

    try:
        loaded = yourdfpy.URDF.load(
            str(path), build_scene_graph=False, load_meshes=False
        )
    except _PROBLEMS:
        return None
    return loaded.robot


def _placed_links(
    tree: Tree[JointElement], chain: Chain
) -> Iterator[tuple[str, int, Matrix]]:
    """Each link, the joint that carries it, and its frame in that joint's."""
    index = {joint.name: k for k, joint in enumerate(chain.joints)}
    locked = _locked(chain)
    waiting = [(chain.base, -1, np.eye(4))]
    while waiting:
        link, carrier, placed = waiting.pop()
        yield link, carrier, placed
        for joint in tree.below.get(link, []):
            child = joint.parts["child"]["link"]
            if joint.name in index:
                waiting.append((child, index[joint.name], np.eye(4)))
                continue
            step = _fixed(joint, tree.place, locked)
            if step is not None:
                waiting.append((child, carrier, placed @ step))


def _fixed(
    joint: JointElement, place: Place, locked: Mapping[str, Motion]
) -> Matrix | None:
    """The transform of a joint off the chain, None when its numbers are no numbers."""
    try:
        motions = origin(joint, joint.place(place), [])
    except InvalidRobotError:
        return None
    if joint.name in locked:
        motions += (locked[joint.name],)
    return transform(motions)


def _locked(chain: Chain) -> dict[str, Motion]:
    """The motion of each locked joint, by its name."""
    motions = [m for joint in chain.joints for m in joint.before] + [*chain.tool]
    return {
        motion.source.removesuffix(" lock"): motion
        for motion in motions
        if motion.source.endswith(" lock")
    }


def _shape(
    visual: Any, lookup: _Lookup
) -> tuple[str, Path | None, tuple[float, ...], tuple[float, ...]] | None:
    """Kind, mesh file, size and scale of a visual, None when it has no geometry."""
    ones, geometry = (1.0, 1.0, 1.0), visual.geometry
    if geometry is None:
        return None
    if geometry.box is not None:
        return "box", None, _floats(geometry.box.size), ones
    if geometry.cylinder is not None:
        size = (float(geometry.cylinder.radius), float(geometry.cylinder.length))
        return "cylinder", None, size, ones
    if geometry.sphere is not None:
        return "sphere", None, (float(geometry.sphere.radius),), ones
    if geometry.mesh is None or not geometry.mesh.filename:
        return None
    path = lookup.find(geometry.mesh.filename)
    scale = np.broadcast_to(
        1.0 if geometry.mesh.scale is None else geometry.mesh.scale, 3
    )
    return "mesh", path, (), _floats(scale)


def _colour(
    material: Any, named: Mapping[str, tuple[float, ...] | None]
) -> tuple[float, ...] | None:
    if material is None:
        return None
    return _rgba(material) or named.get(material.name)


def _rgba(material: Any) -> tuple[float, ...] | None:
    color = material.color
    if color is None or len(color.rgba) != 4:
        return None
    return _floats(np.clip(color.rgba, 0, 1))


def _floats(values: Any) -> tuple[float, ...]:
    return tuple(float(x) for x in values)
