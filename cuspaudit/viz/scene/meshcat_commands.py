"""The door to meshcat: its commands, packed, in the order they must be replayed.

meshcat's own static page sends every command in a racing request; here they are one
list, replayed in order by the page. Identifiers are counted, not drawn from the clock
and the network card, so the same robot gives the same bytes.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
import umsgpack  # type: ignore[import-untyped]
from meshcat import geometry as g
from meshcat.commands import SetObject, SetTransform
from meshcat.path import Path as TreePath
from numpy.typing import NDArray

from cuspaudit.viz.scene.arm import ArmPiece
from cuspaudit.viz.scene.shapes import Triangles

__all__ = ["CommandList", "viewer_license", "viewer_script"]

Matrix = NDArray[np.float64]
# three's cylinder runs along y, ours along z
UPRIGHT = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])


@cache
def viewer_script() -> str:
    """The viewer's JavaScript, from the installed meshcat."""
    dist = files("meshcat") / "viewer" / "dist"
    return (dist / "main.min.js").read_text("utf-8")


@cache
def viewer_license() -> str:
    """The notices that go with the viewer's JavaScript."""
    dist = files("meshcat") / "viewer" / "dist"
    return (dist / "main.min.js.LICENSE.txt").read_text("utf-8")


class CommandList:
    """Collects meshcat commands under ``/meshcat``.

    Attributes:
        packed: the commands so far, each as msgpack, in order.
    """

    def __init__(self) -> None:
        self.packed: list[bytes] = []
        self._names = 0
        self._ids = 0

    def piece(self, path: str, piece: ArmPiece, colour: int) -> None:
        """Draw a primitive under ``path``."""
        size = piece.size
        shape: Any
        origin = piece.origin
        if piece.kind == "cylinder":
            shape, origin = g.Cylinder(size[1], size[0]), origin @ UPRIGHT
            shape.radialSegments = 40 if size[0] > 0.01 else 10
        elif piece.kind == "sphere":
            shape = _Ball(size[0])
        else:
            shape = g.Box(list(size))
        self._mesh(path, shape, _material(colour), origin)

    def triangles(
        self,
        path: str,
        mesh: Triangles,
        colour: int,
        *,
        opacity: float = 1.0,
        flat: bool = False,
        lit: bool = True,
    ) -> None:
        """Draw triangles under ``path``."""
        shape = g.TriangularMeshGeometry(mesh.vertices, mesh.faces)
        material = _material(colour, opacity=opacity, flat=flat, lit=lit)
        self._mesh(path, shape, material, np.eye(4))

    def lines(self, path: str, ends: Matrix, colour: int, opacity: float) -> None:
        """Draw separate segments between consecutive pairs of the (2k, 3) ``ends``."""
        shape = g.PointsGeometry(np.asarray(ends.T, dtype=np.float32))
        material = g.LineBasicMaterial(
            color=colour, opacity=opacity, transparent=True, depthWrite=False
        )
        self._object(path, g.LineSegments(shape, material), np.eye(4))

    def transform(self, path: str, matrix: Matrix) -> None:
        """Place the node ``path`` in its parent."""
        self._pack(SetTransform(matrix, _tree(path)).lower())

    def hide(self, path: str) -> None:
        """Hide a node; ``path`` is absolute here."""
        command = {"type": "set_property", "path": path, "property": "visible"}
        self._pack({**command, "value": False})

    def _mesh(self, path: str, shape: Any, material: Any, origin: Matrix) -> None:
        self._object(path, g.Mesh(shape, material), origin)

    def _object(self, path: str, drawn: Any, origin: Matrix) -> None:
        self._names += 1
        place = f"{path}/part{self._names}"
        for element in (drawn, drawn.geometry, drawn.material):
            self._ids += 1
            element.uuid = f"{self._ids:08x}"
        self._pack(SetObject(drawn, path=_tree(place)).lower())
        self.transform(place, origin)

    def _pack(self, command: dict[str, Any]) -> None:
        self.packed.append(bytes(umsgpack.packb(_plain(command))))


class _Ball(g.Sphere):  # type: ignore[misc]
    """A sphere of fewer faces than meshcat's own; a robot has many elbows."""

    def lower(self, object_data: Any) -> Any:
        """The sphere as three's JSON."""
        faces = {"widthSegments": 16, "heightSegments": 10}
        return {**super().lower(object_data), **faces}


def _tree(path: str) -> Any:
    return TreePath(("meshcat", *path.split("/")))


def _material(
    colour: int, *, opacity: float = 1.0, flat: bool = False, lit: bool = True
) -> Any:
    if not lit:
        return g.MeshBasicMaterial(color=colour, opacity=opacity, depthWrite=False)
    return g.MeshPhongMaterial(
        color=colour, opacity=opacity, shininess=24, specular=0x222222, flatShading=flat
    )


def _plain(value: Any) -> Any:
    """The value with numpy's numbers as Python's, floats at single precision."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str | bytes):
        return [_plain(item) for item in value]
    if isinstance(value, np.integer):
        return int(value)
    if isinstance(value, float | np.floating):
        return float(np.float32(value))
    return value
