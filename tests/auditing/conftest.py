from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import cuspaudit
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats.read_robot import read_robot

LINKS = ("stand", "base", *(f"l{k}" for k in range(1, 8)), "tip", "camera")


def joint(
    name: str, kind: str, parent: str, child: str, axis: str, xyz: str, rpy: str
) -> str:
    """A <joint> element."""
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    axis = f'<axis xyz="{axis}"/>' if kind != "fixed" else ""
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/>'
        f'<child link="{child}"/><origin xyz="{xyz}" rpy="{rpy}"/>{axis}{limit}</joint>'
    )


def seven_joints() -> str:
    """A URDF with every kind of joint, on a stand, with a branch beside the chain."""
    rows = (
        ("mount", "revolute", "stand", "base", "0 1 0", "1 2 3", "0.1 0.2 0.3"),
        ("j1", "continuous", "base", "l1", "0 0 1", "0 0 0.4", "0 0 0"),
        ("j2", "revolute", "l1", "l2", "0 -1 0", "0.1 0 0.2", "1.5707963 0 0.3"),
        ("j3", "prismatic", "l2", "l3", "3 0 4", "0.3 0.1 0", "0 0 1.5708"),
        ("j4", "revolute", "l3", "l4", "1 2 2", "0 0.2 0.5", "0.7 -0.4 0.2"),
        ("j5", "continuous", "l4", "l5", "1 2 3", "0.1 0 0.1", "0 1.5707963 0"),
        ("j6", "revolute", "l5", "l6", "1 0 0", "0 0 0.2", "-1.5707963 0 0"),
        ("j7", "revolute", "l6", "l7", "0 0 1", "0.05 0 0", "0 0 0"),
        ("flange", "fixed", "l7", "tip", "", "0 0 0.1", "0 0.5 0"),
        ("pan", "continuous", "l2", "camera", "0 0 1", "0 0 1", "0 0 0"),
    )
    links = "".join(f'<link name="{name}"/>' for name in LINKS)
    return f'<robot name="seven">{links}{"".join(joint(*row) for row in rows)}</robot>'


@pytest.fixture(scope="session")
def seven(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The URDF of a seven-joint arm with every kind of joint."""
    path = tmp_path_factory.mktemp("urdf") / "seven.urdf"
    path.write_text(seven_joints())
    return path


@pytest.fixture(scope="session")
def chain_of() -> Callable[[str], Chain]:
    """A reader of the chains of ``robots/`` by name."""
    robots = Path(cuspaudit.__file__).parents[1] / "robots"
    return lambda name: read_robot(robots / f"{name}.yaml").chain
