"""What the importer understood of a robot, for `cuspaudit import`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from fractions import Fraction
from typing import Any

from cuspaudit.errors import NoAngleError, UnableError
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.export import factor_texts
from cuspaudit.kinematics.polynomial_map import place
from cuspaudit.robot.chain import Angle, Motion
from cuspaudit.robot.formats.motion_text import format_motion, format_vector
from cuspaudit.robot.numbers import format_angle, format_rational
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snap_policy import DEFAULT_POLICY, SnapPolicy
from cuspaudit.robot.snapping import snap

__all__ = ["import_record"]


def import_record(robot: Robot, policy: SnapPolicy = DEFAULT_POLICY) -> dict[str, Any]:
    """The literal chain in exact text, what snapping changes, and the map.

    The polynomial map is that of the snapped chain: f, R (`polynomial_map.place`; none
    where the tip has no angle) and, when the task has as many dimensions as there are
    joints, det J with its factors.
    """
    chain = robot.chain
    snapped_chain, snapped = snap(chain, policy)
    model = exact_model(snapped_chain)
    entries = _map(model)
    notes = list(robot.notes)
    if model.chain.joints[-1].is_virtual:
        number = len(model.joints)
        notes.append(
            f"joint {number} of the map is virtual: it turns about the tool axis"
        )
    if entries["determinant"] == "0":
        notes.append("det J is 0 everywhere: the tip never has the task's full freedom")
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
                "axis": format_vector(joint.axis),
                "before": _motions(joint.before),
                "limits": _limits(joint.limits),
            }
            for joint in chain.joints
        ],
        "tool": _motions(chain.tool),
        "snap_policy": policy.record(),
        "snapped": [asdict(entry) for entry in snapped],
        "approximated": [asdict(entry) for entry in model.approximations],
        "notes": notes,
        "map": entries,
    }


def _map(model: ExactModel) -> dict[str, Any]:
    entries: dict[str, Any] = {
        "ring": repr(model.ring),
        "f": [str(p) for p in model.equations],
        "R": [],
        "determinant": None,
        "factors": [],
    }
    try:
        entries["R"] = [str(p) for p in place(model)]
        entries["determinant"] = str(jacobian_determinant(model))
    except (NoAngleError, UnableError):
        return entries
    entries["factors"] = factor_texts(model)
    return entries


def _motions(motions: Sequence[Motion]) -> str:
    return ", ".join(format_motion(motion) for motion in motions)


def _limits(limits: Sequence[Angle | Fraction] | None) -> str:
    if limits is None:
        return ""
    return " .. ".join(
        format_angle(limit) if isinstance(limit, Angle) else format_rational(limit)
        for limit in limits
    )
