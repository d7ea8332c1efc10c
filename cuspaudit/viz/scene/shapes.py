"""The shapes of a robot's own links: boxes, cylinders, spheres and meshes.

A mesh is read into plain triangles here, so that the page carries no file that could
ask for another one (a texture, a material library), and is thinned out until all
meshes of a robot together fit a page. A mesh that cannot be read leaves its link to
the primitives of `cuspaudit.viz.scene.arm`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

import numpy as np
import trimesh
from numpy.typing import NDArray

__all__ = ["LinkShape", "Triangles", "read_mesh", "thinned"]

Matrix = NDArray[np.float64]
MESH_SUFFIXES = frozenset({".stl", ".obj", ".dae", ".ply"})
LARGEST_FILE = 60_000_000
FORBIDDEN = (b"<!DOCTYPE", b"<!ENTITY")


class LinkShape(Protocol):
    """One visual shape of a link, as a URDF gives it.

    Attributes:
        joint_index: the joint that carries it, -1 for the base.
        kind: "mesh", "box", "cylinder" (along its z) or "sphere".
        path: the mesh file when there is one and it was found.
        size: box: three sides; cylinder: radius, length; sphere: radius; mesh: ().
        scale: three factors for a mesh.
        origin: (4, 4) placement in the frame of the joint after its motion.
        rgba: colour, each from 0 to 1, or None.
    """

    @property
    def joint_index(self) -> int: ...  # noqa: D102 - described above
    @property
    def kind(self) -> str: ...  # noqa: D102 - described above
    @property
    def path(self) -> Path | None: ...  # noqa: D102 - described above
    @property
    def size(self) -> tuple[float, ...]: ...  # noqa: D102 - described above
    @property
    def scale(self) -> tuple[float, ...]: ...  # noqa: D102 - described above
    @property
    def origin(self) -> Matrix: ...  # noqa: D102 - described above
    @property
    def rgba(self) -> tuple[float, ...] | None: ...  # noqa: D102 - described above


class Triangles:
    """Vertices (v, 3) and faces (f, 3) of a mesh."""

    __slots__ = ("faces", "vertices")

    def __init__(self, vertices: Matrix, faces: NDArray[np.int64]) -> None:
        """Hold both arrays as they are."""
        self.vertices, self.faces = vertices, faces


def read_mesh(path: Path, scale: tuple[float, ...]) -> Triangles | None:
    """The triangles of a mesh file, scaled; None when it cannot be used.

    Refused are files of another kind, too large ones, and XML with a document type or
    entities. No file named inside the mesh is opened.
    """
    if path.suffix.lower() not in MESH_SUFFIXES or not path.is_file():
        return None
    if path.stat().st_size > LARGEST_FILE:
        return None
    if path.suffix.lower() == ".dae" and _is_hostile(path):
        return None
    try:
        scene = trimesh.load_scene(str(path), skip_materials=True)
        mesh = scene.to_mesh()
    except Exception:  # a parser met by a foreign file; primitives are drawn instead
        return None
    vertices = np.asarray(mesh.vertices, dtype=np.float64) * np.array(scale)
    faces = np.asarray(mesh.faces, dtype=np.int64)
    if not len(faces) or not np.all(np.isfinite(vertices)):
        return None
    return Triangles(vertices, faces)


def thinned(mesh: Triangles, cell: float) -> Triangles:
    """The mesh with all vertices in a cube of side ``cell`` drawn together.

    >>> flat = Triangles(np.array([[0, 0, 0], [.1, 0, 0], [9, 0, 0], [0, 9, 0.]]),
    ...                  np.array([[0, 1, 2], [0, 2, 3]]))
    >>> len(thinned(flat, 1.0).vertices), len(thinned(flat, 1.0).faces)
    (3, 1)
    """
    keys = np.floor(mesh.vertices / cell).astype(np.int64)
    _, group = np.unique(_codes(keys), return_inverse=True)
    group = group.reshape(-1)
    size = np.bincount(group).astype(np.float64)
    vertices = np.column_stack(
        [np.bincount(group, weights=mesh.vertices[:, i]) / size for i in range(3)]
    )
    faces = group[mesh.faces]
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    faces = faces[np.unique(_codes(np.sort(faces, axis=1)), return_index=True)[1]]
    return Triangles(vertices, faces)


def _codes(triples: NDArray[np.int64]) -> NDArray[np.int64]:
    """One integer a row, the same for equal rows only (below 2 million a column)."""
    x, y, z = (triples - triples.min(axis=0, initial=0)).T
    base = np.int64(2_097_152)
    return np.asarray((x * base + y) * base + z)


def _is_hostile(path: Path) -> bool:
    text = path.read_bytes()
    return any(word in text for word in FORBIDDEN)
