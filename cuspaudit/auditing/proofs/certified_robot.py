"""A chain as the robot of a certificate: every number as the chain has it, exactly."""

from __future__ import annotations

from fractions import Fraction
from typing import TypedDict

import numpy as np

from cuspaudit import __version__
from cuspaudit.certificate import CertifiedJoint, Rotate, Task, Translate
from cuspaudit.robot.chain import Chain, Motion, Translation
from cuspaudit.robot.frames import jacobian

__all__ = ["CertifiedRobot", "certified_robot", "regular_posture"]

_POSTURES = 32


class CertifiedRobot(TypedDict):
    """The arguments that every kind of certificate takes for its robot."""

    robot_name: str
    task: Task
    unit: str
    joints: tuple[CertifiedJoint, ...]
    tool: tuple[Translate | Rotate, ...]
    made_by: str


def certified_robot(chain: Chain) -> CertifiedRobot:
    """The robot of a certificate; ``chain`` has its virtual joint, if its task asks."""
    return {
        "robot_name": chain.name,
        "task": _task(chain),
        "unit": chain.unit,
        "joints": tuple(
            CertifiedJoint(joint.name, joint.kind, joint.axis, _moves(joint.before))
            for joint in chain.joints
        ),
        "tool": _moves(chain.tool),
        "made_by": f"cuspaudit {__version__}",
    }


def _task(chain: Chain) -> Task:
    if chain.joints[-1].is_virtual:
        return "position-and-axis"
    if chain.task in ("position", "position-and-angle"):
        return chain.task
    return "pose"


def _moves(motions: tuple[Motion, ...]) -> tuple[Translate | Rotate, ...]:
    return tuple(
        Translate(motion.vector)
        if isinstance(motion, Translation)
        else Rotate(motion.axis, motion.angle.half_turns, motion.angle.radians)
        for motion in motions
    )


def regular_posture(chain: Chain) -> tuple[Fraction, ...]:
    """The posture of the largest |det J|, of some spread over the joint space."""
    size = len(chain.joints)
    postures = [
        [((7 * k + 5) * (11 * n + 3) ** 2 % 61 - 30) / 10 for k in range(size)]
        for n in range(_POSTURES)
    ]
    best = max(postures, key=lambda q: abs(float(np.linalg.det(jacobian(chain, q)))))
    return tuple(Fraction(str(value)) for value in best)
