"""An arm and what a tool path needs of it: its balls, its exact model, its task.

Here, and nowhere else, the joint values of the robot meet the variables of the exact
model: the model's angle is the joint value and the joint's zero. A task of a tool axis
has one more joint, a virtual one about that axis; it is no joint of the robot.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from flint import arb, arb_mat, fmpq
from numpy.typing import NDArray

from cuspaudit.algebra.ring import rational
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.common_direction import common_direction
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import angle_value, frames
from cuspaudit.robot.virtual_joint import with_virtual_joint
from cuspaudit.toolpath.ball_arm import BallArm, angle_ball, ball_arm
from cuspaudit.toolpath.following.leg_system import Goal, LegSystem
from cuspaudit.toolpath.waypoints import Pose, Quaternion

__all__ = ["TracedArm", "traced_arm"]

Array = NDArray[np.float64]

_ON_AXIS = 1e-6
_DIGITS = 15


@dataclass(frozen=True, eq=False)
class TracedArm:
    """An arm with a square task.

    Attributes:
        robot_chain: the arm.
        chain: the same, with its virtual joint if the task has one.
        balls: ``chain`` in balls.
    """

    robot_chain: Chain
    chain: Chain
    balls: BallArm

    @property
    def joints(self) -> int:
        """How many joints the robot has; a virtual one is not counted."""
        return len(self.robot_chain.joints)

    @property
    def task(self) -> str:
        """The task of the chain: "pose" with a virtual joint."""
        return self.chain.task

    @cached_property
    def model(self) -> ExactModel:
        """The exact model of the chain."""
        return exact_model(self.chain)

    @cached_property
    def signs(self) -> tuple[int, ...] | None:
        """The signs of the joints in the tip's angle; None for another task.

        Raises:
            NoAngleError: the tip has no angle.
        """
        if self.task != "position-and-angle":
            return None
        return common_direction(self.model).signs

    @cached_property
    def zeros(self) -> list[arb]:
        """For each joint what is added to its value to get the model's variable."""
        return [angle_ball(joint.zero) for joint in self.model.joints]

    @property
    def scales(self) -> Array:
        """For each joint its value over its coordinate in the balls."""
        return np.array(self.balls.scales)

    @property
    def turning(self) -> NDArray[np.bool_]:
        """Which joints turn."""
        return np.array(self.balls.revolute)

    def determinant(self, values: Sequence[arb]) -> arb:
        """Det J of the task on a box of coordinates: no row is turned or scaled.

        The rows are those of `robot.frames.jacobian`; slides are in the arm's unit,
        which scales det J by a positive number.
        """
        placed = self.balls.placed(values)
        rows = [list(row) for row in zip(*placed.speeds, strict=True)]
        if self.signs is not None:
            rows.append([arb(sign) for sign in self.signs])
        elif self.task == "pose":
            rows += [list(row) for row in zip(*placed.turns, strict=True)]
        return arb_mat(rows).det()

    def system(self, first: Pose, second: Pose) -> LegSystem:
        """The equations of the leg from one pose to another.

        Raises:
            UnableError: the leg turns by 180 degrees: it has no one axis.
        """
        position = [arb(rational(x)) for x in first.position]
        step = zip(first.position, second.position, strict=True)
        velocity = [arb(rational(b - a)) for a, b in step]
        here, there = tuple(position), tuple(velocity)
        if self.signs is not None:
            psi, to = (self.tip_angle(pose) for pose in (first, second))
            change = float(
                np.remainder(float(to - psi) + math.pi, 2 * math.pi) - math.pi
            )
            turns = round((float(to - psi) - change) / (2 * math.pi))
            angle = to - psi - 2 * arb.pi() * turns
            return LegSystem(
                self.balls, Goal(here, there, None, None, angle, psi), self.signs
            )
        if self.task != "pose":
            return LegSystem(self.balls, Goal(here, there))
        start = arb_mat([[rational(x) for x in row] for row in first.rotation])
        assert first.quaternion is not None and second.quaternion is not None
        axis, angle = _turn_between(first.quaternion, second.quaternion)
        return LegSystem(self.balls, Goal(here, there, start, axis, angle))

    def tip_angle(self, pose: Pose) -> arb:
        """psi, the sum of signed joint values at the pose, up to whole turns.

        Raises:
            UnableError: the tip never points so.
        """
        c, s = self.cos_sin_of_angle(pose)
        angle = arb.atan2(arb(s), arb(c))
        for sign, zero in zip(self.signs or (), self.zeros, strict=True):
            angle -= sign * zero
        return angle

    def cos_sin_of_angle(self, pose: Pose) -> tuple[fmpq, fmpq]:
        """A rational point of the circle: the tip's angle in the model's variables.

        It is the angle of the orientation to 15 digits.

        Raises:
            UnableError: the tip never points so.
        """
        chain, model = self.chain, self.model
        start = [-angle_value(joint.zero) for joint in model.joints]
        placed = frames(chain, start)
        rows = [[float(x) for x in row] for row in pose.rotation]
        turn = np.array(rows) @ placed[-1][:3, :3].T
        axes = [
            frame[:3, :3] @ _floats(joint.axis)
            for joint, frame in zip(chain.joints, placed, strict=False)
        ]
        kind = common_direction(model).kind
        n = [a for a, turns in zip(axes, self.turning, strict=True) if turns][-1]
        if kind == "parallel axes":
            tilt = np.abs(turn @ n - n).max()
            skew = (turn - turn.T) / 2
            sine = float(n @ [skew[2, 1], skew[0, 2], skew[1, 0]])
            cosine = (float(np.trace(turn)) - 1) / 2
        else:
            z = axes[0]
            moved = turn @ n
            tilt = abs(float(moved @ z))
            cosine = float(z @ turn @ z)
            sine = float((turn @ z) @ np.cross(moved, z))
        if tilt > _ON_AXIS:
            where = f"row {pose.row}" if pose.row else "the pose"
            raise UnableError(
                "tool path",
                f"{where}: the tip of this arm of four joints never points so; it is "
                f"{math.degrees(math.asin(min(1.0, tilt))):.3g} deg off the directions "
                "it has",
            )
        return _rational_point(math.atan2(sine, cosine))

    def exact_pose(self, pose: Pose) -> NDArray[Any]:
        """The pose as (4, 4) rationals."""
        result = np.full((4, 4), fmpq(0), dtype=object)
        for i in range(3):
            result[i, :3] = [rational(x) for x in pose.rotation[i]]
            result[i, 3] = rational(pose.position[i])
        result[3, 3] = fmpq(1)
        return result


def traced_arm(chain: Chain) -> TracedArm:
    """The arm of ``chain``, whose task is square."""
    whole = with_virtual_joint(chain)
    return TracedArm(chain, whole, ball_arm(whole))


def _floats(vector: Sequence[Fraction]) -> Array:
    found = np.array([float(x) for x in vector])
    return np.asarray(found / np.linalg.norm(found))


def _rational_point(angle: float) -> tuple[fmpq, fmpq]:
    """A point of the circle with rational coordinates within 1e-15 of the angle."""
    quarter = round(2 * angle / math.pi)
    near = Fraction(math.tan((angle - quarter * math.pi / 2) / 2))
    t = rational(near.limit_denominator(10**_DIGITS))
    c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    for _ in range(quarter % 4):
        c, s = -s, c
    return c, s


def _turn_between(
    first: Quaternion, second: Quaternion
) -> tuple[tuple[arb, arb, arb] | None, arb]:
    """Axis, in base coordinates, and angle in [0, pi) of the turn from one to another.

    Raises:
        UnableError: it is half a turn.
    """
    a, b = first, second
    w = sum(x * y for x, y in zip(a, b, strict=True))
    # the vector part of second times the conjugate of first
    v = (
        -b[0] * a[1] + b[1] * a[0] - b[2] * a[3] + b[3] * a[2],
        -b[0] * a[2] + b[2] * a[0] - b[3] * a[1] + b[1] * a[3],
        -b[0] * a[3] + b[3] * a[0] - b[1] * a[2] + b[2] * a[1],
    )
    if not any(v):
        return None, arb(0)
    if w == 0:
        raise UnableError("tool path", "the leg turns by 180 degrees")
    if w < 0:
        w, v = -w, (-v[0], -v[1], -v[2])
    square = arb(rational(sum(x * x for x in v)))
    length = square.sqrt()
    x, y, z = (arb(rational(entry)) / length for entry in v)
    return (x, y, z), 2 * arb.atan2(length, arb(rational(w)))
