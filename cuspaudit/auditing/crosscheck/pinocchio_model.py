"""A chain in Pinocchio: an independent forward kinematics and Jacobian.

Pinocchio shares no code with our own kinematics: from a chain it is given axes and
placements made by its own exponential map, from a URDF it is given the file, which it
reads by its own parser. Everything is asked for relative to the chain's base frame.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Motion,
    Task,
    Translation,
    Vector,
)
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.numbers import parse_angle, parse_length
from cuspaudit.robot.place import Place, quoted

__all__ = [
    "LockValue",
    "PinocchioArm",
    "PinocchioPosture",
    "arm_from_chain",
    "arm_from_urdf",
    "is_readable",
    "reach_scale",
]

Array = NDArray[np.float64]
LockValue = Angle | Fraction | str


@dataclass(frozen=True)
class PinocchioPosture:
    """What Pinocchio says of one posture.

    Attributes:
        pose: (4, 4) tip frame in the base frame.
        jacobian: velocity of the tip's origin in the axes of the base frame; then for
            a pose the angular velocity, for a tool axis its two parts across that,
            for an angle its part along the last axis that turns.
    """

    pose: Array
    jacobian: Array

    @property
    def determinant(self) -> float:
        """The number det J, its sign and unit those of the exact polynomial."""
        return float(np.linalg.det(self.jacobian))

    def scaled_jacobian(self, length: float) -> Array:
        """The Jacobian with lengths divided by ``length``."""
        scales = [1 / length] * 3 + [1.0] * (len(self.jacobian) - 3)
        return np.asarray(np.array(scales)[:, None] * self.jacobian)

    def singular_values(self, length: float) -> Array:
        """Those of `scaled_jacobian`, largest first."""
        return np.asarray(np.linalg.svd(self.scaled_jacobian(length), compute_uv=False))


class PinocchioArm:
    """A Pinocchio model and which of its joints and frames are the chain's.

    Attributes:
        chain: names, order and task are taken from it, and no number.
    """

    def __init__(
        self,
        chain: Chain,
        model: Any,
        *,
        base: int,
        tip: int,
        rest: Mapping[str, float] | None = None,
    ) -> None:
        """Keep ``model``; frames by index, joints off the chain stay at ``rest``."""
        self.chain = chain
        self._model, self._data = model, model.createData()
        self._base, self._tip = base, tip
        self._joints = [model.joints[model.getJointId(j.name)] for j in chain.joints]
        self._neutral = pin.neutral(model)
        for name, value in (rest or {}).items():
            joint = model.joints[model.getJointId(name)]
            _set_joint(self._neutral, joint, value)

    def at(self, posture: Sequence[float] | Array) -> PinocchioPosture:
        """Tip pose and Jacobian at ``posture``, (n,) joint values in chain order."""
        q = self._neutral.copy()
        for joint, value in zip(self._joints, posture, strict=True):
            _set_joint(q, joint, float(value))
        pin.forwardKinematics(self._model, self._data, q)
        pin.updateFramePlacements(self._model, self._data)
        base, tip = (self._data.oMf[k] for k in (self._base, self._tip))
        full = pin.computeFrameJacobian(
            self._model, self._data, q, self._tip, pin.LOCAL_WORLD_ALIGNED
        )[:, [joint.idx_v for joint in self._joints]]
        pose = np.array((base.inverse() * tip).homogeneous)
        back = np.array(base.rotation).T
        turning = back @ full[3:]
        rows = _turning_rows(self.chain.task, pose[:3, :3], turning)
        return PinocchioPosture(pose, np.vstack([back @ full[:3], rows @ turning]))


def _turning_rows(task: Task, rotation: Array, turning: Array) -> Array:
    """(k, 3) directions about which the task sees the tip turn."""
    if task == "position":
        return np.zeros((0, 3))
    if task == "position-and-angle":
        return np.asarray(turning[:, np.abs(turning).any(axis=0)].T[-1:])
    turned = {"position-and-x-axis": "yz", "position-and-y-axis": "zx"}
    if task == "position-and-z-axis" or task in turned:
        columns = ["xyz".index(letter) for letter in turned.get(task, "xy")]
        return np.asarray(rotation[:, columns].T)
    return np.eye(3)


def arm_from_chain(chain: Chain) -> PinocchioArm:
    """The arm of the exact ``chain``, each number rounded to a double once."""
    model = pin.Model()
    parent = 0
    for joint in chain.joints:
        kinds = {
            "revolute": pin.JointModelRevoluteUnaligned,
            "prismatic": pin.JointModelPrismaticUnaligned,
        }
        kind = kinds[joint.kind](_unit(joint.axis))
        parent = model.addJoint(parent, kind, _placement(joint.before), joint.name)
    tool = pin.Frame("tip", parent, 0, _placement(chain.tool), pin.FrameType.OP_FRAME)
    return PinocchioArm(chain, model, base=0, tip=model.addFrame(tool))


def is_readable(path: Path) -> bool:
    """Whether Pinocchio reads the URDF; odd effort limits, say, make it refuse."""
    try:
        pin.buildModelFromUrdf(str(path))
    except (ValueError, RuntimeError):
        return False
    return True


def arm_from_urdf(
    chain: Chain, path: Path | str, locked: Mapping[str, LockValue] | None = None
) -> PinocchioArm:
    """The arm that Pinocchio reads from the URDF that ``chain`` was read from.

    Args:
        chain: gives the names of base link, tip link and joints, and the task.
        path: the file.
        locked: values of joints between base and tip that the chain holds fixed, as
            for `robot.task.lock`; any other joint is at Pinocchio's neutral.

    Raises:
        InvalidRobotError: Pinocchio cannot read the file, or finds no such link or
            joint in it.
    """
    place = Place(str(path))
    try:
        model = pin.buildModelFromUrdf(str(path))
    except (ValueError, RuntimeError) as error:
        found = f"Pinocchio cannot read it ({str(error).splitlines()[0]})"
        raise place.error(found, "check the file with check_urdf") from None
    locked = locked or {}
    for name in [*(joint.name for joint in chain.joints), *locked]:
        if not model.existJointName(name):
            raise _missing("joint", name, place)
    rest = {name: _value(model, name, v, place) for name, v in locked.items()}
    base, tip = (_link(model, name, place) for name in (chain.base, chain.tip))
    return PinocchioArm(chain, model, base=base, tip=tip, rest=rest)


def reach_scale(chain: Chain) -> float:
    """The sum of the lengths of all translations of ``chain``, 1 if there is none.

    No point of the arm at rest is farther from the base than this.
    """
    motions = [m for joint in chain.joints for m in joint.before] + [*chain.tool]
    lengths = (_floats(m.vector) for m in motions if isinstance(m, Translation))
    return float(sum(np.linalg.norm(v) for v in lengths)) or 1.0


def _set_joint(q: Array, joint: Any, value: float) -> None:
    """Write ``value`` where ``joint`` keeps it; an unbounded one has cos and sin."""
    if joint.nq == 2:
        q[joint.idx_q : joint.idx_q + 2] = math.cos(value), math.sin(value)
    else:
        q[joint.idx_q] = value


def _placement(motions: Sequence[Motion]) -> Any:
    """The product of ``motions`` by Pinocchio's own exponential map."""
    result = pin.SE3.Identity()
    for motion in motions:
        if isinstance(motion, Translation):
            result = result * pin.SE3(np.eye(3), _floats(motion.vector))
        else:
            turn = pin.exp3(_unit(motion.axis) * angle_value(motion.angle))
            result = result * pin.SE3(turn, np.zeros(3))
    return result


def _link(model: Any, name: str, place: Place) -> int:
    if not model.existFrame(name, pin.FrameType.BODY):
        raise _missing("link", name, place)
    return int(model.getFrameId(name, pin.FrameType.BODY))


def _missing(kind: str, name: str, place: Place) -> InvalidRobotError:
    found = f"Pinocchio finds no {kind} {quoted(name)} in it"
    return place.error(found, "give the URDF that the chain was read from")


def _value(model: Any, name: str, value: LockValue, place: Place) -> float:
    if isinstance(value, str):
        here = place.at(f"joint {quoted(name)}")
        kind = model.joints[model.getJointId(name)].shortname()
        slides = kind.startswith("JointModelP")
        value = parse_length(value, here) if slides else parse_angle(value, here)
    return angle_value(value) if isinstance(value, Angle) else float(value)


def _floats(vector: Vector) -> Array:
    return np.array([float(x) for x in vector])


def _unit(axis: Vector) -> Array:
    largest = max(abs(x) for x in axis)
    direction = np.array([float(x / largest) for x in axis])
    return np.asarray(direction / np.linalg.norm(direction))
