from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.formats.urdf.visuals import visuals
from cuspaudit.robot.task import lock

VISUAL = '<visual>{origin}<geometry>{shape}</geometry><material name="m"/></visual>'
ARM = """<robot name="arm">
<material name="m"><color rgba="1 0 0 1"/></material>
<link name="base">{box}</link><link name="a">{mesh}</link><link name="b">{ball}</link>
<joint name="turn" type="continuous"><parent link="base"/><child link="a"/></joint>
<joint name="slide" type="prismatic"><parent link="a"/><child link="b"/>
<origin xyz="0 0 1"/><limit lower="0" upper="1"/></joint></robot>"""


@pytest.fixture
def urdf(tmp_path: Path) -> Path:
    """A URDF with a box, a mesh of a package and a sphere."""
    texts = {
        "box": ("", '<box size="1 2 3"/>'),
        "mesh": ("", '<mesh filename="package://pkg/part.stl" scale="2 2 2"/>'),
        "ball": ('<origin xyz="0 1 0"/>', '<sphere radius="0.5"/>'),
    }
    shapes = {k: VISUAL.format(origin=o, shape=s) for k, (o, s) in texts.items()}
    path = tmp_path / "pkg" / "urdf" / "arm.urdf"
    path.parent.mkdir(parents=True)
    path.write_text(ARM.format(**shapes))
    return path


def test_shapes_sit_on_the_joint_that_carries_them(urdf: Path) -> None:
    """Each shape has its joint, its size, its place and its named colour."""
    box, mesh, ball = visuals(read_robot(urdf))
    assert [v.joint_index for v in (box, mesh, ball)] == [-1, 0, 1]
    assert (box.kind, box.size) == ("box", (1, 2, 3))
    assert (mesh.kind, mesh.path, mesh.scale) == ("mesh", None, (2, 2, 2))
    assert (ball.size, list(ball.origin[:3, 3])) == ((0.5,), [0, 1, 0])
    assert box.rgba == (1, 0, 0, 1)


def test_a_mesh_is_found_in_its_package(urdf: Path, tmp_path: Path) -> None:
    """package:// is looked up above the URDF and in the folders given."""
    part = urdf.parents[1] / "part.stl"
    part.touch()
    assert visuals(read_robot(urdf))[1].path == part
    part.unlink()
    elsewhere = tmp_path / "share" / "pkg" / "part.stl"
    elsewhere.parent.mkdir(parents=True)
    elsewhere.touch()
    assert visuals(read_robot(urdf), [tmp_path / "share"])[1].path == elsewhere


def test_a_locked_joint_carries_at_its_value(urdf: Path) -> None:
    """What a locked joint carried hangs on the joint before it, moved by the lock."""
    robot = read_robot(urdf)
    locked = lock(robot.chain, {"slide": "0.5"})
    ball = visuals(replace(robot, chain=locked))[2]
    assert ball.joint_index == 0
    assert np.allclose(ball.origin[:3, 3], [0.5, 1, 1])


def test_an_unreadable_shape_is_no_error(urdf: Path) -> None:
    """A description that makes no sense gives no shapes."""
    urdf.write_text(urdf.read_text().replace('size="1 2 3"', 'size="big"'))
    assert visuals(read_robot(urdf)) == ()
