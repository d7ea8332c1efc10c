"""The equations of a leg: which postures have their tip on it, and where.

The unknown is y = (q, s): joint values, and a parameter 0 <= s <= 1 of the leg. With
p(s) and R(s) the position and orientation of the leg, F(y) = 0 says that the posture q
has its tip there:

    position             F = p(q) - p(s)
    position and angle   F = (p(q) - p(s), sin(sum of signed joint values - psi(s)))
    pose                 F = (p(q) - p(s), vee E),  E = R(s)^T R(q),

vee E = (E32 - E23, E13 - E31, E21 - E12) / 2. A zero of the last line may also be a
half turn (trace E = -1), one of the second half a turn off; `is_genuine` tells. Along a
curve of zeros E is symmetric throughout, so it cannot change from one to the other.

The leg is one more joint that carries the goal away. Joint i of speed v_i and angular
velocity w_i, and the parameter of speed -p' and angular velocity -omega, are the
columns of K = (v_i, -p'; R^T w_i, -R^T omega), and F' = M K: with [x]x E + E^T [x]x =
[(tr E - E) x]x, M is the identity but for the last rows, (tr E - E) / 2 (for an angle
the cosine of what is missing). At a zero M is the identity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from flint import arb, arb_mat
from numpy.typing import NDArray

from cuspaudit.toolpath.ball_arm import BallArm, PlacedArm

__all__ = ["Goal", "LegSystem"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Goal:
    """A leg in balls.

    Attributes:
        position: p(0).
        velocity: dp/ds, constant.
        rotation: R(0), (3, 3); None for a task that asks for no orientation.
        axis: unit axis about which the orientation turns, in base coordinates.
        angle: by how much from s = 0 to s = 1, rad; or that of the tip's angle psi.
        psi: the tip's angle at s = 0, of a position-and-angle task.
    """

    position: tuple[arb, ...]
    velocity: tuple[arb, ...]
    rotation: arb_mat | None = None
    axis: tuple[arb, arb, arb] | None = None
    angle: arb = field(default_factory=arb)
    psi: arb | None = None

    def place(self, s: arb) -> list[arb]:
        """p(s)."""
        pairs = zip(self.position, self.velocity, strict=True)
        return [p + v * s for p, v in pairs]

    def back(self, s: arb) -> arb_mat:
        """R(s)^T."""
        assert self.rotation is not None
        if self.axis is None:
            return self.rotation.transpose()
        x, y, z = self.axis
        sine, cosine = (s * self.angle).sin_cos()
        k = 1 - cosine
        # the turn by s angle about the axis, transposed
        turn = arb_mat(
            [
                [cosine + x * x * k, x * y * k + z * sine, x * z * k - y * sine],
                [y * x * k - z * sine, cosine + y * y * k, y * z * k + x * sine],
                [z * x * k + y * sine, z * y * k - x * sine, cosine + z * z * k],
            ]
        )
        return self.rotation.transpose() * turn

    @property
    def omega(self) -> list[arb]:
        """The angular velocity of the goal, in base coordinates."""
        return [self.angle * n for n in self.axis or [arb(0)] * 3]


@dataclass(frozen=True, eq=False)
class LegSystem:
    """F on one leg.

    Attributes:
        arm: n joints.
        goal: the leg.
        signs: of the joints, for a position-and-angle task.
    """

    arm: BallArm
    goal: Goal
    signs: tuple[int, ...] | None = None

    @property
    def size(self) -> int:
        """N."""
        return len(self.arm.revolute)

    @property
    def has_pose(self) -> bool:
        """Whether the task is a pose."""
        return self.goal.rotation is not None

    @cached_property
    def omega(self) -> Array:
        """The angular velocity of the goal, nearly."""
        return np.array([float(x) for x in self.goal.omega])

    @cached_property
    def rate(self) -> float:
        """By how much the orientation turns on the leg, rad, rounded up."""
        return float(abs(self.goal.angle).upper()) * (1 + 1e-15)

    @cached_property
    def _plain(self) -> tuple[Array, Array, Array, float, float]:
        goal = self.goal
        rotation = np.eye(3) if goal.rotation is None else _floats(goal.rotation)
        place, speed = (
            np.array([float(x) for x in v]) for v in (goal.position, goal.velocity)
        )
        return place, speed, rotation, float(goal.angle), float(goal.psi or 0)

    def plain(self, y: Array) -> tuple[Array, Array]:
        """F and K in doubles, (n,) and (n, n + 1): for searching."""
        place, speed, rotation, angle, psi = self._plain
        tip, turns, speeds = self.arm.plain(y[:-1])
        s, n = y[-1], self.size
        value, slope = np.empty(n), np.empty((n, n + 1))
        value[:3] = tip[:3, 3] - place - s * speed
        slope[:3, :n], slope[:3, n] = speeds.T, -speed
        if self.signs is not None:
            value[3] = np.sin(np.dot(self.signs, y[:-1]) - psi - s * angle)
            slope[3, :n], slope[3, n] = self.signs, -angle
        elif self.has_pose:
            back = rotation.T @ _turned_back(self.omega, s)
            E = back @ tip[:3, :3]
            value[3:] = (E[2, 1] - E[1, 2]) / 2, (E[0, 2] - E[2, 0]) / 2, 0
            value[5] = (E[1, 0] - E[0, 1]) / 2
            slope[3:, :n], slope[3:, n] = back @ turns.T, -back @ self.omega
        return value, slope

    def value(self, y: Sequence[arb]) -> arb_mat:
        """F(y), (n, 1)."""
        return self.value_of(self.arm.placed(y[:-1]), y)

    def value_of(self, placed: PlacedArm, y: Sequence[arb]) -> arb_mat:
        """F(y), (n, 1), the arm being ``placed`` at y."""
        tip = placed.tip
        values = [tip[i, 3] - p for i, p in enumerate(self.goal.place(y[-1]))]
        if self.signs is not None:
            values.append(self._angle(y).sin())
        elif self.has_pose:
            E = self.goal.back(y[-1]) * _turn(tip)
            values += [
                (E[2, 1] - E[1, 2]) / 2,
                (E[0, 2] - E[2, 0]) / 2,
                (E[1, 0] - E[0, 1]) / 2,
            ]
        return arb_mat(len(values), 1, values)

    def is_genuine(self, y: Sequence[arb]) -> bool:
        """Whether a zero in the box ``y`` is no half turn, proved."""
        return self.is_genuine_at(self.arm.placed(y[:-1]), y)

    def is_genuine_at(self, placed: PlacedArm, y: Sequence[arb]) -> bool:
        """The same, the arm being ``placed`` at y: E turns by less than 90 degrees."""
        if self.signs is not None:
            return bool(self._angle(y).cos() > 0)
        if not self.has_pose:
            return True
        return bool((self.goal.back(y[-1]) * _turn(placed.tip)).trace() > 1)

    def _angle(self, y: Sequence[arb]) -> arb:
        assert self.signs is not None and self.goal.psi is not None
        total = -self.goal.psi - y[-1] * self.goal.angle
        for sign, value in zip(self.signs, y, strict=False):
            if sign:
                total += sign * value
        return total


def _turn(tip: arb_mat) -> arb_mat:
    return arb_mat([[tip[i, j] for j in range(3)] for i in range(3)])


def _floats(matrix: arb_mat) -> Array:
    return np.array([[float(x.mid()) for x in row] for row in matrix.tolist()])


def _turned_back(omega: Array, s: float) -> Array:
    """The turn by -s omega."""
    size = float(np.sqrt(omega @ omega))
    if size == 0.0:
        return np.eye(3)
    x, y, z = omega / size
    c, k, t = np.cos(s * size), 1 - np.cos(s * size), np.sin(s * size)
    return np.array(
        [
            [c + x * x * k, x * y * k + z * t, x * z * k - y * t],
            [y * x * k - z * t, c + y * y * k, y * z * k + x * t],
            [z * x * k + y * t, z * y * k - x * t, c + z * z * k],
        ]
    )
