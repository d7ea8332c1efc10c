"""The scene of a page: the arm, its ghosts, the place of the tool and its trace.

The arm is a chain of meshcat nodes, one a joint, each inside the one before; the page
turns the nodes by the joint values, so a posture between two samples is still the arm
and not a blend of pictures. Ghosts are copies of the arm, made by the page. Lengths
are scaled so that the arm stretched out has length 1: meshcat's lights and camera then
fit every unit.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import transform
from cuspaudit.viz.scene.arm import ArmPiece, arm_pieces, pointing, triad, unit_axis
from cuspaudit.viz.scene.camera import Camera, ring, tube
from cuspaudit.viz.scene.meshcat_commands import CommandList
from cuspaudit.viz.scene.motion import PathFrames, chain_length
from cuspaudit.viz.scene.shapes import LinkShape, Triangles, read_mesh, thinned

__all__ = ["Scene", "build_scene"]

Matrix = NDArray[np.float64]
MOST_FACES = 60_000  # of all meshes together
COLOURS = {
    "base": 0x77828F,
    "link": 0x5A84B4,
    "housing": 0x2E3D50,
    "cap": 0xB9CBDD,
    "tool": 0xB5179E,
    "x": 0xD23B3B,
    "y": 0x2E9E4F,
    "z": 0x2F62D9,
}
TARGET, TRACE, GRID = 0xB5179E, 0x8250C4, 0x8A94A0
GHOSTS = (
    *("#12908e", "#e07b1a", "#7a5bd0", "#c2417c"),
    *("#5f8a1d", "#3a78c9", "#b5882a", "#8a6a5c"),
)


@dataclass(frozen=True, slots=True)
class Scene:
    """What the page draws.

    Attributes:
        commands: meshcat commands as msgpack, to be replayed in this order.
        drawing: what the page's script needs besides, plain JSON: joints, ghosts,
            camera, labels.
        shown: the postures drawn.
        chain: the robot.
        notes: sentences on what is not drawn as the file has it.
    """

    commands: tuple[bytes, ...]
    drawing: Mapping[str, Any]
    shown: PathFrames
    chain: Chain
    notes: tuple[str, ...]


def build_scene(
    chain: Chain, shown: PathFrames, shapes: Sequence[LinkShape] = ()
) -> Scene:
    """The scene of ``chain`` going through the postures ``shown``.

    Args:
        chain: the robot.
        shown: from `sample_path` or `sample_postures`.
        shapes: the links' own shapes; links without a readable one are drawn as
            tubes and housings.

    Returns:
        The scene for `cuspaudit.viz.page.render_page`.
    """
    scale = 1.0 / chain_length(chain)
    outlook = Camera(chain, shown, scale)
    commands = CommandList()
    for node in ("/Grid", "/Axes"):
        commands.hide(node)
    drawn, notes = _draw_shapes(commands, shapes, scale)
    for piece in arm_pieces(chain, scale, shown, skip=frozenset(drawn)):
        commands.piece(_node(piece.body), piece, COLOURS[piece.role])
    _draw_ground(commands, outlook)
    if _one_place(shown, scale):
        _draw_target(commands, chain, shown, scale)
    if shown.is_path:
        trace = tube(shown.tips[:, :3, 3] * scale, 0.0042)
        commands.triangles("trace", trace, TRACE)
    return Scene(
        tuple(commands.packed), _drawing(chain, shown, outlook), shown, chain, notes
    )


def _node(body: int) -> str:
    """The meshcat path of a body: joints nested in one another."""
    return "/".join(["arm", *(f"j{i}" for i in range(body + 1)), "body"])


def _one_place(shown: PathFrames, scale: float) -> bool:
    """Whether a path was drawn, or every posture holds the tool at one place."""
    return shown.is_path or bool(np.max(shown.distances) * scale < 1e-4)


def _draw_shapes(
    commands: CommandList, shapes: Sequence[LinkShape], scale: float
) -> tuple[set[int], tuple[str, ...]]:
    """Draw the links' own shapes; return the bodies drawn, and notes on the others."""
    ready: dict[int, list[tuple[LinkShape, Triangles | None]]] = defaultdict(list)
    missing = set()
    for shape in shapes:
        mesh = None
        if shape.kind == "mesh":
            mesh = read_mesh(shape.path, shape.scale) if shape.path else None
            if mesh is None:
                missing.add(shape.joint_index)
                continue
        ready[shape.joint_index].append((shape, mesh))
    for body in missing:
        ready.pop(body, None)
    meshes = [mesh for pairs in ready.values() for _, mesh in pairs if mesh]
    cell = _cell(meshes, 1.0 / scale)
    for body, pairs in ready.items():
        for shape, mesh in pairs:
            _draw_shape(commands, body, shape, mesh and _thin(mesh, cell), scale)
    notes = (
        f"{len(missing)} of the robot's links are drawn as tubes: their meshes are not "
        "at hand.",
    )
    return set(ready), notes if missing else ()


def _cell(meshes: Sequence[Triangles], length: float) -> float:
    """The side of the cubes that leaves the meshes with few enough faces, or 0."""
    if sum(len(mesh.faces) for mesh in meshes) <= MOST_FACES:
        return 0.0
    cell = length / 1000
    while sum(len(thinned(mesh, cell).faces) for mesh in meshes) > MOST_FACES:
        cell *= 1.5
    return cell


def _thin(mesh: Triangles, cell: float) -> Triangles:
    return thinned(mesh, cell) if cell else mesh


def _draw_shape(
    commands: CommandList,
    body: int,
    shape: LinkShape,
    mesh: Triangles | None,
    scale: float,
) -> None:
    colour = _colour(shape.rgba)
    origin = np.array(shape.origin, dtype=np.float64)
    if mesh is not None:
        points = (mesh.vertices @ origin[:3, :3].T + origin[:3, 3]) * scale
        placed = Triangles(points, mesh.faces)
        commands.triangles(_node(body), placed, colour, flat=True)
        return
    origin[:3, 3] *= scale
    size = tuple(float(side) * scale for side in shape.size)
    if shape.kind in ("box", "cylinder", "sphere"):
        kind: Any = shape.kind
        commands.piece(_node(body), ArmPiece(body, kind, size, origin, "link"), colour)


def _colour(rgba: tuple[float, ...] | None) -> int:
    if rgba is None:
        return COLOURS["link"]
    red, green, blue = (round(255 * min(1.0, max(0.0, x))) for x in rgba[:3])
    return (red << 16) + (green << 8) + blue


def _draw_ground(commands: CommandList, outlook: Camera) -> None:
    """Grid and base: a plate, on a column when the arm dips below its base."""
    commands.lines("ground", outlook.grid(), GRID, 0.42)
    up = np.array([0.0, 0.0, 1.0])
    ground, height = outlook.ground, -outlook.ground
    plate = pointing(up, np.array([0.0, 0.0, ground + 0.006]))
    pieces = [ArmPiece(-1, "cylinder", (0.075, 0.012), plate, "base")]
    if height > 0.012:
        column = pointing(up, np.array([0.0, 0.0, ground + height / 2]))
        pieces.append(ArmPiece(-1, "cylinder", (0.026, height), column, "base"))
    for piece in pieces:
        commands.piece("stand", piece, COLOURS["base"])


def _draw_target(
    commands: CommandList, chain: Chain, shown: PathFrames, scale: float
) -> None:
    """The place the tool has at both ends: three rings, and the axes it keeps."""
    place = shown.tips[0].copy()
    place[:3, 3] *= scale
    commands.transform("target", place)
    for axis in np.eye(3):
        circle = ring(axis, 0.052, 0.0028)
        commands.triangles("target", circle, TARGET)
    for piece in triad(-1, np.eye(4), 0.15, 0.0028):
        if chain.task in ("pose", f"position-and-{piece.role}-axis"):
            commands.piece("target", piece, COLOURS[piece.role])


def _drawing(chain: Chain, shown: PathFrames, outlook: Camera) -> dict[str, Any]:
    """Everything the page's script needs, as plain JSON."""
    scale = outlook.scale
    one_place = _one_place(shown, scale)
    joints = []
    for joint in chain.joints:
        before = transform(joint.before)
        before[:3, 3] *= scale
        joints.append(
            {
                "name": joint.name,
                "kind": joint.kind,
                "axis": _rounded(unit_axis(joint)),
                "before": _rounded(before.T.reshape(-1)),
            }
        )
    tool = transform(chain.tool)
    tool[:3, 3] *= scale
    return {
        "joints": joints,
        "tool": _rounded(tool.T.reshape(-1)),
        "scale": scale,
        "unit": chain.unit,
        "task": chain.task,
        "isPath": shown.is_path,
        "postures": [_rounded(row, 6) for row in shown.postures],
        "determinants": [float(f"{x:.5g}") for x in shown.determinants],
        "distances": _rounded(shown.distances, 9),
        "turns": _rounded(shown.turns, 6),
        "target": _rounded(shown.tips[0, :3, 3] * scale) if one_place else None,
        "ghosts": outlook.ghosts(GHOSTS),
        "fit": [_rounded(point, 4) for point in outlook.fit_points()],
        "view": _rounded(outlook.view_direction(), 4),
        "gridPitch": outlook.pitch,
    }


def _rounded(values: Matrix, digits: int = 8) -> list[float]:
    return [round(float(x), digits) + 0.0 for x in values]
