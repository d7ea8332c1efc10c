"""All postures of a pose of a six-joint arm, exactly.

The pose is that of a posture with rational half-angle tangents, so it has its numbers
in the field K of the model. The closed loop is solved in a chart of half-angle tangents
(`posture_chart`): forwards, where the roots are those of joint 2, or else backwards,
where they are those of joint 5, which tells the two sides of a wrist apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from flint import fmpq, fmpq_poly
from numpy.typing import NDArray

from cuspaudit.algebra.parametrization import RealPoint, ZeroDimensionalParametrization
from cuspaudit.algebra.quadratic_matrix import QuadraticField
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.posture_chart import Chart, UnluckyChartError, cos_sin, turn
from cuspaudit.kinematics.raghavan_roth import Arm, reversed_loop
from cuspaudit.kinematics.transform import Transform

__all__ = ["GROUND", "exact_postures", "posture_sign", "real_postures"]

Array = NDArray[Any]

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
        The points (t, c1, s1, ..., c6, s6), t the tangent of half of one joint in a
        turned chart and the form of the parametrization; at most 16. Over Q(sqrt m)
        they have one more coordinate, "sqrtm", and the postures are those where it is
        positive: the others, at most 16 too, are those of the conjugate arm.
        `real_postures` are the postures of the arm, and the given one is among them.

    Raises:
        UnableError: not six revolute joints; or two postures may share joint 2, and
            two joint 5, as they do where one is singular.
        PrecisionError: the numbers are longer than was tried.
    """
    field = QuadraticField(model.ring.radicand)
    arm = _exact_arm(field, model)
    pose = _forward(field, arm, [cos_sin(t) for t in tangents])
    refused = UnableError(
        STEP, "a posture stays infinite in every chart that was tried"
    )
    rng = np.random.default_rng(seed)
    for backwards in (False, True):
        if backwards:
            arm, pose = _reduced(field, *reversed_loop(arm, pose))
        for _ in range(_TRIES):
            turns = [fmpq(int(x), 17) for x in rng.integers(-40, 40, 3)]
            try:
                omega, rho = Chart(field, arm, pose, turns).postures(seed)
            except UnluckyChartError:
                continue
            except UnableError as limit:
                refused = limit
                break
            return _parametrization(field, omega, rho, -1 if backwards else 1)
    raise refused


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
    field: QuadraticField, omega: fmpq_poly, rho: list[fmpq_poly], sense: int
) -> ZeroDimensionalParametrization:
    """Of the postures of a loop counted forwards (``sense`` 1) or backwards (-1)."""
    own = fmpq_poly([0, 1]) * omega.derivative() % omega
    pairs = list(zip(rho[0:12:2], rho[1:12:2], strict=True))
    every = (own, *(x for pair in pairs[::sense] for x in pair), *rho[12:])
    names = ["t", *(f"{x}{k}" for k in range(1, 7) for x in "cs")]
    if field.radicand is not None:
        names.append(f"sqrt{field.radicand}")
    form = (fmpq(1), *(fmpq(0) for _ in names[1:]))
    return ZeroDimensionalParametrization(tuple(names), omega, every, form, (GROUND,))


def _exact_arm(field: QuadraticField, model: ExactModel) -> Arm:
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

    return Arm(
        [motion(joint.before) for joint in model.joints],
        [axis(joint.axis) for joint in model.joints],
        motion(model.tool),
        fmpq(1, 2),
    )


def _reduced(field: QuadraticField, arm: Arm, pose: Array) -> tuple[Arm, Array]:
    before = [field.reduced(step) for step in arm.before]
    return Arm(before, arm.axes, field.reduced(arm.tool), arm.half), pose


def _forward(
    field: QuadraticField, arm: Arm, postures: list[tuple[fmpq, fmpq]]
) -> Array:
    placed = np.eye(4, dtype=object)
    for k, (c, s) in enumerate(postures):
        placed = field.reduced(placed @ arm.before[k] @ turn(arm, k, c, s))
    return field.reduced(placed @ arm.tool)
