"""An arm in ball arithmetic: where its tip is, and the screws of its joints.

The motion of a joint and the fixed transform before it are one matrix, affine in the
cosine and sine of the joint value (or in the slide), so that a frame costs one product
of 4 x 4 matrices a joint. Every entry is a ball that contains the true number: the
constants come from the chain, whose numbers are exact.

Slides are measured in ``unit`` of the arm, its longest fixed step, so that one radian
and one unit of a slide move the tip about equally far.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from flint import arb, arb_mat, ctx
from numpy.typing import NDArray

from cuspaudit.algebra.ring import rational
from cuspaudit.robot.chain import Angle, Chain, Joint, Motion, Translation, Vector

__all__ = ["BITS", "BallArm", "PlacedArm", "angle_ball", "ball_arm", "cross"]

Array = NDArray[np.float64]
Step = tuple[arb_mat, arb_mat, arb_mat]

BITS = 64
"""Working precision of the tubes; the constants of an arm have twice as many bits."""


@dataclass(frozen=True, eq=False)
class PlacedArm:
    """A posture, or a box of postures.

    Attributes:
        tip: (4, 4), the frame of the tip.
        turns: for each joint the angular velocity that its unit speed gives the hand.
        speeds: likewise the velocity of the tip's origin.
    """

    tip: arb_mat
    turns: list[list[arb]]
    speeds: list[list[arb]]


@dataclass(frozen=True, eq=False)
class BallArm:
    """A chain with its constants in balls.

    Attributes:
        steps: for each joint (P, Q, R): its frame is that before it times P + c Q + s R
            where it turns by the angle of cosine c and sine s, P + x R where it slides.
        marks: for each joint (4, 2): its axis, and the origin of its frame.
        revolute: which joints turn.
        tool: (4, 4).
        unit: what a slide of 1 is, in the unit of the chain.
    """

    steps: tuple[Step, ...]
    marks: tuple[arb_mat, ...]
    revolute: tuple[bool, ...]
    tool: arb_mat
    unit: float

    @property
    def scales(self) -> list[float]:
        """For each joint, its value in rad or the chain's unit over its coordinate."""
        return [1.0 if turns else self.unit for turns in self.revolute]

    @cached_property
    def reach(self) -> float:
        """A bound on the distance of the tip from any axis, the slides left out."""
        total = 0.0
        for step in (*(step for step, _, _ in self.steps), self.tool):
            total += float(np.linalg.norm([float(step[i, 3].mid()) for i in range(3)]))
        return max(total, self.unit) * (1 + 1e-12)

    @cached_property
    def _plain(self) -> tuple[Array, Array, Array, Array, Array]:
        parts = [np.array([_floats(step[k]) for step in self.steps]) for k in range(3)]
        marks = np.array([_floats(mark) for mark in self.marks])
        return parts[0], parts[1], parts[2], marks, _floats(self.tool)

    def plain(self, values: Array) -> tuple[Array, Array, Array]:
        """Tip (4, 4), angular velocities (n, 3) and speeds (n, 3) in doubles."""
        fixed, cosine, sine, marks, tool = self._plain
        turns = self.turns
        c, s = np.cos(values)[:, None, None], np.sin(values)
        s = np.where(turns, s, values)[:, None, None]
        steps = fixed + c * cosine + s * sine
        frame, lines = steps[0], np.empty_like(marks)
        lines[0] = frame @ marks[0]
        for k in range(1, len(steps)):
            frame = frame @ steps[k]
            lines[k] = frame @ marks[k]
        tip = frame @ tool
        axes, arms = lines[:, :3, 0], tip[:3, 3] - lines[:, :3, 1]
        if turns.all():
            return tip, axes, cross(axes, arms)
        mask = turns[:, None]
        speeds = np.where(mask, cross(axes, arms), self.unit * axes)
        return tip, np.where(mask, axes, 0.0), speeds

    @cached_property
    def turns(self) -> NDArray[np.bool_]:
        """Which joints turn."""
        return np.array(self.revolute)

    def placed(self, values: Sequence[arb]) -> PlacedArm:
        """The tip and the screws at ``values``: rad, slides in ``unit``."""
        frame, lines = None, []
        for (fixed, cosine, sine), mark, turns, value in zip(
            self.steps, self.marks, self.revolute, values, strict=True
        ):
            if turns:
                s, c = value.sin_cos()
                step = fixed + cosine * c + sine * s
            else:
                step = fixed + sine * value
            frame = step if frame is None else frame * step
            lines.append((frame * mark).entries())
        assert frame is not None, "a chain has at least one joint"
        tip = frame * self.tool
        p = [tip[0, 3], tip[1, 3], tip[2, 3]]
        nothing = [arb(0), arb(0), arb(0)]
        turning, speeds = [], []
        for (a, x, b, y, c, z, *_), turns in zip(lines, self.revolute, strict=True):
            if not turns:
                turning.append(nothing)
                speeds.append([a * self.unit, b * self.unit, c * self.unit])
                continue
            u, v, w = p[0] - x, p[1] - y, p[2] - z
            turning.append([a, b, c])
            speeds.append([b * w - c * v, c * u - a * w, a * v - b * u])
        return PlacedArm(tip, turning, speeds)


def ball_arm(chain: Chain) -> BallArm:
    """The arm of ``chain``, every constant enclosed."""
    with ctx.workprec(2 * BITS):
        befores = [_fixed(joint.before) for joint in chain.joints]
        tool = _fixed(chain.tool)
        lengths = [
            float(abs(motion[i, 3].mid()))
            for motion in (*befores, tool)
            for i in range(3)
        ]
        unit = max(lengths) or 1.0
        steps, marks = [], []
        for joint, before in zip(chain.joints, befores, strict=True):
            axis = _unit(joint.axis)
            fixed, cosine, sine = _parts(joint, axis, unit)
            steps.append((before * fixed, before * cosine, before * sine))
            entries: list[list[Any]] = [*([x, 0] for x in axis), [0, 1]]
            marks.append(arb_mat(entries))
        turns = tuple(joint.kind == "revolute" for joint in chain.joints)
        return BallArm(tuple(steps), tuple(marks), turns, tool, unit)


def cross(a: Array, b: Array) -> Array:
    """The vector products along the last axis; quicker than numpy's for a few."""
    x, y, z = a[..., 0], a[..., 1], a[..., 2]
    u, v, w = b[..., 0], b[..., 1], b[..., 2]
    first = y * w - z * v
    result = np.empty((*first.shape, 3))
    result[..., 0], result[..., 1], result[..., 2] = first, z * u - x * w, x * v - y * u
    return result


def angle_ball(angle: Angle) -> arb:
    """A ball of the angle in rad, at the working precision."""
    return arb(rational(angle.half_turns)) * arb.pi() + arb(rational(angle.radians))


def _fixed(motions: Sequence[Motion]) -> arb_mat:
    """The product of the motions, left to right, (4, 4)."""
    result = arb_mat([[int(i == j) for j in range(4)] for i in range(4)])
    for motion in motions:
        if isinstance(motion, Translation):
            entries: list[list[Any]] = [
                [int(i == j) for j in range(4)] for i in range(4)
            ]
            for i in range(3):
                entries[i][3] = rational(motion.vector[i])
            step = arb_mat(entries)
        else:
            still, cosine, sine = _rotation(_unit(motion.axis))
            s, c = _sin_cos(motion.angle)
            step = still + cosine * c + sine * s
        result = result * step
    return result


def _parts(joint: Joint, axis: list[arb], unit: float) -> Step:
    """(P, Q, R) of the joint's own motion."""
    if joint.kind == "revolute":
        return _rotation(axis)
    still = arb_mat([[int(i == j) for j in range(4)] for i in range(4)])
    rows: list[list[Any]] = [*([0, 0, 0, x * unit] for x in axis), [0, 0, 0, 0]]
    slide = arb_mat(rows)
    return still, slide * 0, slide


def _rotation(n: list[arb]) -> Step:
    """Rodrigues: n n^T, 1 - n n^T and [n]x, as motions: their sum with 1, c, s."""
    (x, y, z), zero = n, arb(0)
    along = [[a * b for b in n] for a in n]
    still = arb_mat([*([*row, zero] for row in along), [0, 0, 0, 1]])
    across = [[int(i == j) - along[i][j] for j in range(3)] for i in range(3)]
    cosine = arb_mat([*([*row, zero] for row in across), [0, 0, 0, 0]])
    sine: list[list[Any]] = [[0, -z, y, 0], [z, 0, -x, 0], [-y, x, 0, 0], [0] * 4]
    return still, cosine, arb_mat(sine)


def _unit(axis: Vector) -> list[arb]:
    square = sum(x * x for x in axis)
    length = arb(rational(square)).sqrt()
    return [arb(rational(x)) / length for x in axis]


def _sin_cos(angle: Angle) -> tuple[arb, arb]:
    """Exactly 0 and 1 at quarter turns."""
    if angle.radians == 0:
        turns = rational(angle.half_turns)
        return arb.sin_pi_fmpq(turns), arb.cos_pi_fmpq(turns)
    return angle_ball(angle).sin_cos()


def _floats(matrix: arb_mat) -> Array:
    return np.array([[float(x.mid()) for x in row] for row in matrix.tolist()])
