"""Arms and tool paths that several tests trace."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Rotation,
    Task,
    Translation,
)
from cuspaudit.toolpath.traced_arm import TracedArm, traced_arm
from cuspaudit.toolpath.waypoints import Pose, ToolPath

Number = float | str

FACTS = json.loads((Path(__file__).parent / "tool_paths.json").read_text())["paths"]
_AXES = {"x": X_AXIS, "y": Y_AXIS, "z": Z_AXIS}


def exact(value: Number) -> Fraction:
    """The number as it is printed."""
    return Fraction(str(value))


def arm_of_axes(
    axes: str,
    points: Sequence[Sequence[Number]],
    tip: Sequence[Number],
    task: Task = "pose",
    limits: Sequence[tuple[Angle, Angle] | None] | None = None,
) -> Chain:
    """A chain whose axes go through points of the base frame when all joints are 0."""
    joints: list[Joint] = []
    last = [Fraction(0)] * 3
    for k, (name, point) in enumerate(zip(axes, points, strict=True)):
        here = [exact(x) for x in point]
        step = Translation(_vector([a - b for a, b in zip(here, last, strict=True)]))
        own = limits[k] if limits else None
        joints.append(Joint(f"j{k + 1}", "revolute", (step,), _AXES[name], own))
        last = here
    end = [exact(x) - b for x, b in zip(tip, last, strict=True)]
    return Chain("arm", tuple(joints), (Translation(_vector(end)),), task)


def _vector(entries: Sequence[Fraction]) -> tuple[Fraction, Fraction, Fraction]:
    x, y, z = entries
    return x, y, z


def table_arm(
    lengths: Sequence[Number],
    offsets: Sequence[Number],
    twists: Sequence[str],
    limits: Sequence[tuple[Angle, Angle] | None] = (None, None, None),
) -> Chain:
    """A three-joint arm of a standard D-H table; twists in half turns."""
    joints, pending = [], []
    rows = zip(lengths, offsets, twists, limits, strict=True)
    for k, (a, d, alpha, own) in enumerate(rows):
        joints.append(Joint(f"j{k + 1}", "revolute", tuple(pending), Z_AXIS, own))
        pending = [
            Translation((exact(a), Fraction(0), exact(d))),
            Rotation(X_AXIS, Angle(Fraction(alpha))),
        ]
    return Chain("arm", tuple(joints), tuple(pending), "position")


@cache
def mirror() -> TracedArm:
    """The orthogonal arm of the paper, as its map is printed: cuspidal."""
    return traced_arm(table_arm([1, 2, "1.5"], [0, 1, 0], ["-1/2", "1/2", "0"]))


@cache
def crx() -> TracedArm:
    """The CRX-10iA/L."""
    elbow, wrist = (0, 0, ".71"), (".15", ".54", ".71")
    base = (0, 0, 0)
    points = [base, base, elbow, elbow, wrist, wrist]
    return traced_arm(arm_of_axes("zxxyxy", points, wrist))


def places(*rows: Sequence[Number]) -> ToolPath:
    """A tool path of positions."""
    poses = [
        Pose(_vector([exact(x) for x in row]), None, k) for k, row in enumerate(rows, 1)
    ]
    return ToolPath(tuple(poses))


def fact(name: str) -> Any:
    """The tool path of this name."""
    [found] = [path for path in FACTS if path["name"] == name]
    return found
