"""The pose of a joint vector, in rational numbers.

The position is rounded to 1e-15 of the unit, and so are the ratios of the quaternion's
entries, to the simplest rational near by: where the pose is rational it is exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import arb, arb_mat, ctx, fmpq

from cuspaudit.algebra.rationals import exact_rational, simplest_between
from cuspaudit.algebra.ring import rational
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.frames import angle_value
from cuspaudit.toolpath.ball_arm import angle_ball
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import Pose

__all__ = [
    "JointValue",
    "float_values",
    "pose_of_joints",
    "simplest_near",
    "value_balls",
]

JointValue = Angle | Fraction

_BITS = 128
_NEAR = fmpq(1, 10**15)


def value_balls(values: Sequence[JointValue]) -> list[arb]:
    """Joint values in balls of the working precision."""
    return [
        angle_ball(value) if isinstance(value, Angle) else arb(rational(value))
        for value in values
    ]


def float_values(values: Sequence[JointValue]) -> list[float]:
    """Joint values in doubles."""
    return [
        angle_value(value) if isinstance(value, Angle) else float(value)
        for value in values
    ]


def pose_of_joints(arm: TracedArm, values: Sequence[JointValue]) -> Pose:
    """The pose of the tip at joint values of the robot.

    Args:
        arm: the virtual joint of a tool axis stands at 0.
        values: angles, or lengths in the chain's unit.
    """
    with ctx.workprec(_BITS):
        balls = value_balls(values)
        balls += [arb(0)] * (len(arm.chain.joints) - len(balls))
        scaled = [
            ball / arb(scale)
            for ball, scale in zip(balls, arm.balls.scales, strict=True)
        ]
        tip = arm.balls.placed(scaled).tip
        x, y, z = (simplest_near(tip[i, 3]) for i in range(3))
        w, a, b, c = (simplest_near(entry) for entry in _quaternion(tip))
    return Pose((x, y, z), (w, a, b, c))


def _quaternion(tip: arb_mat) -> list[arb]:
    """w, x, y, z over the largest of them."""
    r = [[tip[i, j] for j in range(3)] for i in range(3)]
    trace = r[0][0] + r[1][1] + r[2][2]
    # four times the products of each entry with the others, by rows
    rows = [
        [1 + trace, r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]],
        [
            r[2][1] - r[1][2],
            1 + 2 * r[0][0] - trace,
            r[0][1] + r[1][0],
            r[0][2] + r[2][0],
        ],
        [
            r[0][2] - r[2][0],
            r[0][1] + r[1][0],
            1 + 2 * r[1][1] - trace,
            r[1][2] + r[2][1],
        ],
        [
            r[1][0] - r[0][1],
            r[0][2] + r[2][0],
            r[1][2] + r[2][1],
            1 + 2 * r[2][2] - trace,
        ],
    ]
    best = max(range(4), key=lambda k: float(rows[k][k].mid()))
    return [entry / rows[best][best] for entry in rows[best]]


def simplest_near(ball: arb) -> Fraction:
    """The simplest rational within 1e-15 of a narrow ball."""
    middle = exact_rational(ball)
    found = simplest_between(middle - _NEAR, middle + _NEAR)
    return Fraction(int(found.p), int(found.q))
