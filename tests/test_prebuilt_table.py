from __future__ import annotations

from pathlib import Path

import numpy as np
from prebuilt_table import read, show, table

from cuspaudit.robot.frames import frames

MODULE = """\
import numpy as np
raise RuntimeError("read, never imported")
T_HOME = np.array([[0.0, 0.0, 1.0, 1.4], [0.0, 1.0, 0.0, 0.0],
                   [-1.0, 0.0, 0.0, 0.5], [0.0, 0.0, 0.0, 1.0]], dtype=np.float64)
_JOINT_NAMES = ["j1", "j2", "j3", "j4", "j5", "j6"]
_JOINT_AXES = [np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]),
               np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0]),
               np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])]
"""


def module(folder: Path) -> Path:
    """A module as the package has them, of a small arm with a spherical wrist."""
    step = "np.array([[1.0, 0, 0, {}], [0, 1.0, 0, 0], [0, 0, 1.0, {}], [0, 0, 0, 1]])"
    lefts = [("0", "0.5000000000000001"), ("0", "0"), ("0.7", "0")]
    lefts += [("0.7", "0"), ("0", "0"), ("0", "0")]
    turned = "np.array([[0, 0, 1.0, 0], [0, 1.0, 0, 0], [-1.0, 0, 0, 0], [0, 0, 0, 1]])"
    before = ", ".join(step.format(*pair) for pair in lefts)
    text = f"{MODULE}_JOINT_T_LEFTS = [{before}]\n"
    rights = [step.format("0", "0")] * 5 + [turned]
    text += f"_JOINT_T_RIGHTS = [{', '.join(rights)}]\n"
    text += f"_JOINT_TYPES = {['revolute'] * 6}\n"
    text += f"_JOINT_LIMITS = {[(-1.5, 1.5)] * 5 + [None]}\n"
    path = folder / "prebuilt" / "maker" / "arm_ik.py"
    path.parent.mkdir(parents=True)
    path.write_text(text)
    return path


def test_a_module_is_read_and_not_run(tmp_path: Path) -> None:
    """Literal numbers become the chain, and its pose at zero is the one stated."""
    chain, home = read(module(tmp_path))
    assert [joint.name for joint in chain.joints] == [
        "j1",
        "j2",
        "j3",
        "j4",
        "j5",
        "j6",
    ]
    assert np.abs(frames(chain, np.zeros(6))[-1] - home).max() < 1e-12
    assert chain.joints[5].limits is None


def test_the_table_counts_verdicts_by_class(tmp_path: Path) -> None:
    """A small arm with a spherical wrist is audited and counted."""
    module(tmp_path)
    rows = list(table(tmp_path, 5.0))
    assert show(rows) == "6 joints, spherical wrist: 1 noncuspidal"
