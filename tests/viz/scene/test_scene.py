from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
import umsgpack
from drawn_arms import crx_chain, issac_chain, issac_path, slider_chain

from cuspaudit.robot.frames import frames, transform
from cuspaudit.viz import build_scene, sample_path, sample_postures
from cuspaudit.viz.scene.arm import arm_pieces, elbows
from cuspaudit.viz.scene.shapes import read_mesh


@dataclass
class Shape:
    """A link's shape, as `cuspaudit.robot.formats.urdf.visuals` gives it."""

    kind: str = "mesh"
    path: Path | None = None
    joint_index: int = 0
    size: tuple[float, ...] = ()
    scale: tuple[float, ...] = (1.0, 1.0, 1.0)
    origin: Any = field(default_factory=lambda: np.eye(4))
    rgba: tuple[float, ...] | None = (1.0, 0.5, 0.0, 1.0)


def commands(scene: Any) -> list[dict[str, Any]]:
    """The commands, unpacked."""
    return [umsgpack.unpackb(packed) for packed in scene.commands]


def parts(scene: Any, under: str) -> list[str]:
    """Paths of the objects drawn below a node."""
    found = [c["path"] for c in commands(scene) if c["type"] == "set_object"]
    return [path for path in found if path.startswith(under)]


@pytest.mark.parametrize("chain", [issac_chain(), crx_chain(), slider_chain()])
def test_the_tubes_end_at_the_next_joint(chain: Any) -> None:
    """Each link's corners start on its joint and end on the next, square on the way."""
    posture = [0.3 + 0.2 * i for i in range(len(chain.joints))]
    placed = frames(chain, posture)
    for body in range(len(chain.joints)):
        corners = elbows(chain, body, 1.0)
        end = placed[body] @ np.r_[corners[-1], 1.0]
        following = chain.joints[body + 1 :]
        before = transform(following[0].before if following else chain.tool)
        assert np.allclose(end, placed[body] @ before[:, 3])


def test_an_arm_is_drawn_alike_in_m_and_mm() -> None:
    """The drawing is in parts of the arm's length, whatever the unit."""
    scenes = []
    for unit in ("m", "mm"):
        chain = issac_chain(unit=unit)
        scenes.append(build_scene(chain, sample_path(chain, issac_path(chain), 20)))
    assert scenes[0].commands == scenes[1].commands
    assert scenes[0].drawing["joints"] == scenes[1].drawing["joints"]
    assert scenes[1].drawing["gridPitch"] == 1000 * scenes[0].drawing["gridPitch"]


def test_bodies_are_nested_joint_in_joint() -> None:
    """The last link hangs under every joint before it, the tool at its end."""
    scene = build_scene(crx_chain(), sample_postures(crx_chain(), [[0.1] * 6]))
    assert parts(scene, "/meshcat/arm/j0/j1/j2/j3/j4/j5/body/")
    assert len(parts(scene, "/meshcat/arm/body/")) > 0


def test_a_sliding_bar_stays_in_its_sleeve() -> None:
    """The bar is as long as its slide, and lies where no posture leaves the sleeve."""
    chain = slider_chain()
    shown = sample_postures(chain, [[0, 0, -100], [0, 200, 300]])
    bars = [
        (piece.body, piece.size[2], piece.origin[:3, 3])
        for piece in arm_pieces(chain, 1.0, shown)
        if piece.kind == "box" and piece.role == "cap" and piece.body > 0
    ]
    (_, lift, _), (_, reach, middle) = bars
    assert lift > 200
    assert reach > 400
    assert middle[0] == pytest.approx(-100)


def test_a_mesh_takes_the_place_of_the_tube(tmp_path: Path) -> None:
    """A readable mesh is drawn in its colour instead of the link's primitives."""
    file = tmp_path / "link.stl"
    trimesh.creation.box((1, 1, 1)).export(str(file))
    shown = sample_postures(issac_chain(), [[0, 0, 0]])
    scene = build_scene(issac_chain(), shown, [Shape(path=file)])
    (drawn,) = [
        c
        for c in commands(scene)
        if c["type"] == "set_object" and c["path"].startswith("/meshcat/arm/j0/body/")
    ]
    assert drawn["object"]["geometries"][0]["type"] == "BufferGeometry"
    assert drawn["object"]["materials"][0]["color"] == 0xFF8000
    assert scene.notes == ()


@pytest.mark.parametrize("shape", [Shape(), Shape(path=Path("nowhere.stl"))])
def test_a_missing_mesh_leaves_the_tube_and_a_note(shape: Shape) -> None:
    """A mesh that is not at hand changes nothing but a sentence on the page."""
    shown = sample_postures(issac_chain(), [[0, 0, 0]])
    bare, scene = (build_scene(issac_chain(), shown, s) for s in ([], [shape]))
    assert bare.commands == scene.commands
    assert "1 of the robot's links" in scene.notes[0]


def test_own_boxes_and_cylinders_are_drawn_to_scale() -> None:
    """Primitives of a URDF are scaled with the arm."""
    shapes = [Shape("box", size=(1.1, 2.2, 3.3)), Shape("sphere", size=(5.5,))]
    chain = issac_chain()
    scene = build_scene(chain, sample_postures(chain, [[0, 0, 0]]), shapes)
    drawn = [
        c["object"]["geometries"][0]
        for c in commands(scene)
        if c["type"] == "set_object" and c["path"].startswith("/meshcat/arm/j0/body/")
    ]
    assert [d["type"] for d in drawn] == ["BoxGeometry", "SphereGeometry"]
    assert drawn[0]["width"] == pytest.approx(1.1 / 5.5)
    assert drawn[1]["radius"] == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.dae", '<!DOCTYPE x [<!ENTITY a "b">]><COLLADA/>'),
        ("a.dae", "<COLLADA"),
        ("a.stl", "solid nothing"),
        ("a.stl", ""),
        ("a.txt", "o"),
    ],
)
def test_a_foreign_mesh_file_is_refused(
    tmp_path: Path, name: str, content: str
) -> None:
    """XML with entities, broken or empty meshes and other files give no triangles."""
    (tmp_path / name).write_text(content)
    assert read_mesh(tmp_path / name, (1.0, 1.0, 1.0)) is None


def test_heavy_meshes_are_thinned(tmp_path: Path) -> None:
    """Meshes of a hundred thousand faces still make a page of a few megabytes."""
    file = tmp_path / "ball.stl"
    trimesh.creation.icosphere(subdivisions=6, radius=2.0).export(str(file))
    shown = sample_postures(issac_chain(), [[0, 0, 0]])
    scene = build_scene(issac_chain(), shown, [Shape(path=file)])
    assert 200_000 < sum(map(len, scene.commands)) < 2_000_000
