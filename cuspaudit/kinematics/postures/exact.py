"""All postures of a pose of a six-joint arm, exactly.

The pose is that of a posture with rational half-angle tangents, so it has its numbers
in the field K of the model. The closed loop is solved in a chart of half-angle tangents
(`posture_chart`): forwards, where the roots are those of joint 2, or else backwards,
where they are those of joint 5, which tells the two sides of a wrist apart. Where every
joint angle may belong to two postures the equations are solved (`loop_equations`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from flint import fmpq, fmpq_poly
from numpy.typing import NDArray

from cuspaudit.algebra.points.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
)
from cuspaudit.algebra.quadratic_matrix import QuadraticField
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.postures.arm import ArmArrays, reversed_arm, rigid_inverse
from cuspaudit.kinematics.postures.chart import PostureChart, UnluckyChartError
from cuspaudit.kinematics.postures.loop_equations import postures_by_equations
from cuspaudit.kinematics.postures.loop_turns import cos_sin, turn
from cuspaudit.kinematics.transform import Transform

__all__ = [
    "GROUND",
    "arm_and_pose",
    "exact_postures",
    "exact_postures_of",
    "posture_sign",
    "real_postures",
]

Array = NDArray[Any]
Found = tuple[fmpq_poly, list[fmpq_poly], tuple[str, ...]]

GROUND = "Raghavan-Roth resultant, exact, with one null vector a root"
STEP = "exact postures"
_TRIES = 4


def exact_postures(
    model: ExactModel, tangents: Sequence[fmpq], seed: int = 0
) -> ZeroDimensionalParametrization:
    """All complex postures that share the pose of a rational one.

    Args:
        model: six revolute joints; where it is an approximation, so are they.
        tangents: tan(theta_i / 2), theta_i the variables of the model (a joint value
            and its zero), of a posture; its pose is the one solved for.
        seed: of the charts.

    Returns:
        The points (t, c1, s1, ..., c6, s6), t the form of the parametrization (mostly
        the tangent of half of one joint in a turned chart); at most 16. Over Q(sqrt m)
        they have one more coordinate, "sqrtm", and the postures are those where it is
        positive: the others, at most 16 too, are those of the conjugate arm.
        `real_postures` are the postures of the arm, and the given one is among them.

    Raises:
        UnableError: not six revolute joints, or out of reach, as where a posture is
            singular.
        NotZeroDimensionalError: infinitely many postures have this pose.
        PrecisionError: the numbers are longer than was tried.
    """
    _, _, pose = arm_and_pose(model, tangents)
    return exact_postures_of(model, pose, seed)


def exact_postures_of(
    model: ExactModel, pose: Array, seed: int = 0
) -> ZeroDimensionalParametrization:
    """All complex postures of a pose, as `exact_postures` returns them.

    Args:
        model: six revolute joints; where it is an approximation, so are they.
        pose: (4, 4), entries in the field K of the model.
        seed: of the charts.

    Raises:
        UnableError: not six revolute joints, or out of reach, as where a posture is
            singular.
        NotZeroDimensionalError: infinitely many postures have this pose.
        PrecisionError: the numbers are longer than was tried.
    """
    field = QuadraticField(model.ring.radicand)
    arm, pose = _exact_arm(field, model), field.reduced(pose)
    found = _by_charts(field, arm, pose, seed)
    if found is None:
        found = postures_by_equations(field, arm, pose, seed)
    return _parametrization(field, *found)


def _by_charts(
    field: QuadraticField, arm: ArmArrays, pose: Array, seed: int
) -> Found | None:
    """The postures by the resultant, forwards or backwards; None where it refuses."""
    rng = np.random.default_rng(seed)
    for sense in (1, -1):
        if sense < 0:
            arm, pose = _reduced(field, reversed_arm(arm)), rigid_inverse(pose)
            pose = field.reduced(pose)
        for _ in range(_TRIES):
            turns = [fmpq(int(x), 17) for x in rng.integers(-40, 40, 3)]
            try:
                omega, rho = PostureChart(field, arm, pose, turns).postures(seed)
            except UnluckyChartError:
                continue
            except UnableError:
                break
            pairs = list(zip(rho[0:12:2], rho[1:12:2], strict=True))[::sense]
            rho = [*(x for pair in pairs for x in pair), *rho[12:]]
            return omega, rho, (GROUND,)
    return None


def arm_and_pose(
    model: ExactModel, tangents: Sequence[fmpq]
) -> tuple[QuadraticField, ArmArrays, Array]:
    """K, the arm over it, and the pose of a rational posture.

    Raises:
        UnableError: not six revolute joints.
    """
    field = QuadraticField(model.ring.radicand)
    arm = _exact_arm(field, model)
    return field, arm, _forward(field, arm, [cos_sin(t) for t in tangents])


def real_postures(found: ZeroDimensionalParametrization) -> list[RealPoint]:
    """The postures of the arm among the points of ``exact_postures``; complete."""
    last = found.variables[-1]
    if not last.startswith("sqrt"):
        return list(found.real_points())
    return [p for p in found.real_points() if p.ball(8)[last] > 0]


def posture_sign(posture: RealPoint, model: ExactModel, polynomial: Polynomial) -> int:
    """The exact sign of a polynomial of the model's ring at a posture."""
    ring = model.ring
    if ring.radicand is not None:
        ring = Ring([*ring.variables, f"sqrt{ring.radicand}"])
    return posture.sign(polynomial, ring)


def _parametrization(
    field: QuadraticField,
    omega: fmpq_poly,
    rho: list[fmpq_poly],
    grounds: tuple[str, ...],
) -> ZeroDimensionalParametrization:
    own = fmpq_poly([0, 1]) * omega.derivative() % omega
    names = ["t", *(f"{x}{k}" for k in range(1, 7) for x in "cs")]
    if field.radicand is not None:
        names.append(f"sqrt{field.radicand}")
    form = (fmpq(1), *(fmpq(0) for _ in names[1:]))
    return ZeroDimensionalParametrization(
        tuple(names), omega, (own, *rho), form, grounds
    )


def _exact_arm(field: QuadraticField, model: ExactModel) -> ArmArrays:
    if model.chain.kinds != ("revolute",) * 6:
        raise UnableError(STEP, "only arms of six revolute joints are solved")

    def value(constant: Polynomial) -> Any:
        return field.element(model.ring, constant)

    def motion(transform: Transform) -> Array:
        result = np.eye(4, dtype=object)
        for i in range(3):
            result[i, :3] = [value(x) for x in transform.rotation[i]]
            result[i, 3] = value(transform.translation[i])
        return result

    def axis(entries: Sequence[Polynomial]) -> Array:
        result = np.empty(3, dtype=object)
        result[:] = [value(x) for x in entries]
        return result

    return ArmArrays(
        [motion(joint.before) for joint in model.joints],
        [axis(joint.axis) for joint in model.joints],
        motion(model.tool),
        fmpq(1, 2),
    )


def _reduced(field: QuadraticField, arm: ArmArrays) -> ArmArrays:
    before = [field.reduced(step) for step in arm.before]
    return ArmArrays(before, arm.axes, field.reduced(arm.tool), arm.half)


def _forward(
    field: QuadraticField, arm: ArmArrays, postures: list[tuple[fmpq, fmpq]]
) -> Array:
    placed = np.eye(4, dtype=object)
    for k, (c, s) in enumerate(postures):
        placed = field.reduced(placed @ arm.before[k] @ turn(arm, k, c, s))
    return field.reduced(placed @ arm.tool)
