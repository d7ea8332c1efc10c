"""A module as ssik writes them, of a small arm with a spherical wrist."""

from __future__ import annotations

from pathlib import Path

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
    """The module in a folder laid out as the package is."""
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
