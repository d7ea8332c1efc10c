"""The code of the how-to page, run as it stands there."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import cuspaudit
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import library
from cuspaudit.toolpath.reading import read_path
from cuspaudit.toolpath.traced_arm import traced_arm

PAGE = Path(cuspaudit.__file__).parents[1] / "docs" / "how-to-trace.md"
VECTORS = ((0.2, -1.2, 1.3, 0.4, 0.7, 0.1), (0.25, -1.1, 1.25, 0.45, 0.75, 0.15))
NAMES = (
    *("shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint"),
    *("wrist_1_joint", "wrist_2_joint", "wrist_3_joint"),
)


def code(which: str) -> str:
    """The Python block of the page that has this word."""
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    [found] = [block for block in blocks if which in block]
    return str(found)


@pytest.fixture
def arm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the URDF of a UR5, which is the current one."""
    if not PAGE.exists():
        pytest.skip("no docs beside the package")
    known = dict(library())
    if "ur5_robot" not in known:
        pytest.skip("no example-robot-data")
    shutil.copy(known["ur5_robot"], tmp_path / "arm.urdf")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("as_json", [False, True])
def test_a_trajectory_of_moveit_becomes_a_path(arm: Path, as_json: bool) -> None:
    """A dump of the message, its joints in another order, is read by their names."""
    order = [2, 0, 1, 3, 5, 4]
    points = [
        {
            "positions": [vector[k] for k in order],
            "velocities": [],
            "time_from_start": {"sec": number, "nanosec": 0},
        }
        for number, vector in enumerate(VECTORS)
    ]
    header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "world"}
    names = [NAMES[k] for k in order]
    message = {
        "joint_trajectory": {"header": header, "joint_names": names, "points": points},
        "multi_dof_joint_trajectory": {"joint_names": [], "points": []},
    }
    # ros2 topic echo ends a message by a line of its own
    text = json.dumps(message) if as_json else yaml.safe_dump(message) + "---\n"
    (arm / "plan.yaml").write_text(text)
    exec(code("plan.yaml"), {})
    chain = cuspaudit.load("arm.urdf", tip="tool0").chain
    path = read_path(Path("plan.csv"), traced_arm(chain))
    assert path.joints is not None
    assert np.allclose(path.joints, VECTORS)


def test_poses_of_ros_become_waypoints(arm: Path) -> None:
    """The quaternion is turned round: w first."""
    place: dict[str, Any] = {}
    exec(code("def waypoints"), place)
    pose = {
        "position": {"x": 0.4, "y": 0.1, "z": 0.3},
        "orientation": {"x": 1.0, "y": 0.0, "z": 0.0, "w": 0.0},
    }
    [found] = place["waypoints"]([pose])
    assert found == {"position": [0.4, 0.1, 0.3], "quaternion": [0.0, 1.0, 0.0, 0.0]}
    (arm / "path.json").write_text(json.dumps([found, found]))
    chain = cuspaudit.load("arm.urdf", tip="tool0").chain
    path = read_path(Path("path.json"), traced_arm(chain))
    assert [float(x) for x in path.poses[0].quaternion or ()] == [0, 1, 0, 0]


@pytest.mark.slow
def test_placements_of_pinocchio_are_traced(arm: Path) -> None:
    """Its forward kinematics are ours; the motion is one of the runs that reach."""
    pytest.importorskip("pinocchio")
    place: dict[str, Any] = {"trajectory": [np.array(vector) for vector in VECTORS]}
    exec(code("import pinocchio"), place)
    chain = cuspaudit.load("arm.urdf", tip="tool0").chain
    for vector, placement in zip(VECTORS, place["placements"], strict=True):
        assert np.abs(frames(chain, vector)[-1] - placement.homogeneous).max() < 1e-12
    starts = [run.start for run in place["trace"].runs if run.end == "reached"]
    turned = [2 * np.sin((np.array(start) - VECTORS[0]) / 2) for start in starts]
    assert min(np.abs(gap).max() for gap in turned) < 1e-6
    assert (arm / "trace.html").stat().st_size > 10_000
