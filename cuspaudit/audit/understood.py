"""What the importer understood of a robot, for `cuspaudit import`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from fractions import Fraction
from typing import Any

from cuspaudit.kinematics.chain import Angle, Motion, Translation, Vector
from cuspaudit.kinematics.numbers import format_angle, format_rational
from cuspaudit.kinematics.robot import Robot
from cuspaudit.kinematics.snapping import snap

__all__ = ["understood"]


def understood(robot: Robot) -> dict[str, Any]:
    """The literal chain in exact text, and what snapping changes in it."""
    chain = robot.chain
    _, snapped = snap(chain)
    return {
        "name": robot.name,
        "title": robot.title,
        "source": robot.source,
        "file": robot.file,
        "base": chain.base,
        "tip": chain.tip,
        "task": chain.task,
        "unit": chain.unit,
        "joints": [
            {
                "name": joint.name,
                "type": joint.kind,
                "axis": _vector(joint.axis),
                "before": _motions(joint.before),
                "limits": _limits(joint.limits),
            }
            for joint in chain.joints
        ],
        "tool": _motions(chain.tool),
        "snapped": [asdict(entry) for entry in snapped],
        "notes": list(robot.notes),
    }


def _vector(vector: Vector) -> str:
    return " ".join(format_rational(entry) for entry in vector)


def _motions(motions: Sequence[Motion]) -> str:
    return ", ".join(
        f"move {_vector(motion.vector)}"
        if isinstance(motion, Translation)
        else f"turn {format_angle(motion.angle)} about {_vector(motion.axis)}"
        for motion in motions
    )


def _limits(limits: Sequence[Angle | Fraction] | None) -> str:
    if limits is None:
        return ""
    return " .. ".join(
        format_angle(limit) if isinstance(limit, Angle) else format_rational(limit)
        for limit in limits
    )
