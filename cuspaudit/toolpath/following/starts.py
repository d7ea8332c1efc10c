"""All postures of a pose, with what is proved about the list.

Six revolute joints: `kinematics.postures.exact`. Three and four joints: the equations
R(q) = value on the circles of the joints, solved completely. Joint values are balls,
angles in (-pi, pi].
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb, ctx
from numpy.typing import NDArray

from cuspaudit.algebra.points.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring, rational
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import NotZeroDimensionalError, RetryableError, UnableError
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import place
from cuspaudit.kinematics.postures.ball_count import posture_bound
from cuspaudit.kinematics.postures.exact import (
    exact_postures_of,
    posture_sign,
    real_postures,
)
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.runtime.clock import check_time, time_is_up
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.strand import settled
from cuspaudit.toolpath.following.tube import Knot
from cuspaudit.toolpath.known import known_posture
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import Pose

__all__ = ["Solved", "SolvedPosture", "solve_pose"]

_COUNTED = "Raghavan-Roth resultant in balls, with as many real roots as postures"
_APART = 1e-9
_BITS = 96
_STARTS, _SINGULAR = 64, 1e8
_STEPS, _CAUTIOUS = 30, 0.4


@dataclass(frozen=True, eq=False)
class SolvedPosture:
    """A posture of the exact model.

    Attributes:
        values: joint values, rad in (-pi, pi] or the chain's unit; or the middle of a
            box that holds exactly one posture.
        sign: of det J, 0 proved where it vanishes; None where it is not known.
    """

    values: tuple[arb, ...]
    sign: int | None


@dataclass(frozen=True, eq=False)
class Solved:
    """The postures of a pose.

    Attributes:
        postures: those found.
        complete: whether no other posture of the model exists, proved.
        whole_curves: whether infinitely many complex postures have this pose.
        grounds: what ``complete`` rests on.
        why: why the list is not complete, or "".
    """

    postures: tuple[SolvedPosture, ...]
    complete: bool
    whole_curves: bool = False
    grounds: tuple[str, ...] = ()
    why: str = ""


def solve_pose(arm: TracedArm, pose: Pose, seed: int = 0) -> Solved:
    """All postures of ``pose``.

    Where the exact solvers are unable, those that floating point finds, for a six-joint
    arm, and none for another; then the list is not complete.
    """
    counted = None if arm.model.is_exact else _counted(arm, pose)
    if counted is not None:
        return counted
    try:
        found = _exact(arm, pose, seed)
    except NotZeroDimensionalError:
        why = "infinitely many complex postures have this pose"
        return Solved(tuple(_numeric(arm, pose)), False, True, (), why)
    except (UnableError, RetryableError) as limit:
        return Solved(tuple(_numeric(arm, pose)), False, False, (), str(limit))
    determinant = jacobian_determinant(arm.model)
    postures = [
        SolvedPosture(_values(arm, point), posture_sign(point, arm.model, determinant))
        for point in (
            real_postures(found) if arm.model.ring.radicand else found.real_points()
        )
    ]
    why = "" if arm.model.is_exact else "the model is within 1e-12 of the numbers"
    return Solved(tuple(postures), arm.model.is_exact, False, found.grounds, why)


def _counted(arm: TracedArm, pose: Pose) -> Solved | None:
    """As many postures as a count in balls allows, each proved; None where they differ.

    For arms whose numbers no exact model has, such as twists of 55 degrees.
    """
    if len(arm.turning) != 6 or not arm.turning.all() or time_is_up():
        return None
    system = arm.system(pose, pose)
    knots: list[Knot] = []
    for near in _numeric(arm, pose):
        known = known_posture(arm, system, [float(v) for v in near.values], 0.0)
        if known.knot is None:
            return None
        if all(_are_apart(known.knot, other) for other in knots):
            knots.append(known.knot)
    if len(knots) != posture_bound(arm.chain, arm.exact_pose(pose)):
        return None
    postures = []
    for knot in knots:
        determinant = arm.determinant(knot.balls()[:-1])
        sign = int(determinant > 0) - int(determinant < 0) or None
        # the middle of a box that holds one posture
        postures.append(SolvedPosture(tuple(arb(x) for x in knot.at[:-1]), sign))
    return Solved(tuple(postures), True, False, (_COUNTED, "ball arithmetic"))


def _are_apart(a: Knot, b: Knot) -> bool:
    """Whether two boxes hold no posture in common, whole turns aside."""
    gap = np.abs(np.remainder(a.at[:-1] - b.at[:-1] + np.pi, 2 * np.pi) - np.pi)
    return bool((gap > _APART + a.reach[:-1] + b.reach[:-1]).any())


def _exact(arm: TracedArm, pose: Pose, seed: int) -> ZeroDimensionalParametrization:
    model = arm.model
    check_time("postures")
    if len(model.joints) == 6:
        return exact_postures_of(model, arm.exact_pose(pose), seed)
    values = [rational(x) for x in pose.position]
    if arm.signs is not None:
        values += arm.cos_sin_of_angle(pose)
    equations = [
        *model.equations,
        *(p - v for p, v in zip(place(model), values, strict=True)),
    ]
    return _solved(model, equations, seed)


def _solved(
    model: ExactModel, equations: list[Polynomial], seed: int
) -> ZeroDimensionalParametrization:
    """The solutions, sqrt m one more variable unless K = Q."""
    ring = model.ring
    if ring.radicand is None:
        return solve_zero_dimensional(
            PolynomialSystem(ring, tuple(equations)), seed=seed
        )
    name = f"sqrt{ring.radicand}"
    plain = Ring([*ring.variables, name])
    moved = [plain.from_other(p, ring) for p in equations]
    moved.append(plain.gen(name) ** 2 - ring.radicand)
    return solve_zero_dimensional(PolynomialSystem(plain, tuple(moved)), seed=seed)


def _values(arm: TracedArm, point: Any) -> tuple[arb, ...]:
    with ctx.workprec(2 * _BITS):
        balls, result = point.ball(_BITS), []
        for joint, zero in zip(arm.model.joints, arm.zeros, strict=True):
            if joint.kind == "prismatic":
                result.append(balls[joint.variables[0]])
                continue
            c, s = (balls[name] for name in joint.variables)
            result.append(_wrapped(_direction(c, s) - zero))
        return tuple(result)


def _direction(c: arb, s: arb) -> arb:
    """The angle of a point of the circle; near (-1, 0) that of its opposite, and pi."""
    if c > 0 or not s.contains(0):
        return arb.atan2(s, c)
    return arb.atan2(-s, -c) + arb.pi()


def _wrapped(angle: arb) -> arb:
    """The angle less whole turns, in (-pi, pi] up to its radius."""
    turn = 2 * arb.pi()
    whole = ((angle - arb.pi()) / turn - arb(2) ** -_BITS * 2**16).mid().ceil()
    return angle - whole * turn


def _numeric(arm: TracedArm, pose: Pose) -> Iterator[SolvedPosture]:
    """What floating point finds: by elimination for six that turn, else by Newton."""
    try:
        solver = PostureSolver.of(arm.chain)
        target = arm.exact_pose(pose).astype(float)
        target[:3, 3] /= solver.scale
        [found] = solver.solve(target[None])
    except UnableError:
        yield from _searched(arm, pose)
        return
    for posture in found:
        yield SolvedPosture(tuple(arb(float(x)) for x in posture), None)


def _nearer(system: LegSystem, y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Some cautious Newton steps from a posture far off, s kept."""
    for _ in range(_STEPS):
        value, slope = system.plain(y)
        step = np.linalg.lstsq(slope[:, :-1], value, rcond=1e-9)[0]
        y = y - np.append(np.clip(step, -_CAUTIOUS, _CAUTIOUS), 0.0)
        if np.abs(step).max() < 1e-3:
            break
    return y


def _searched(arm: TracedArm, pose: Pose) -> Iterator[SolvedPosture]:
    """The regular postures that Newton's method meets from random ones."""
    system = arm.system(pose, pose)
    met: list[NDArray[np.float64]] = []
    size = len(arm.turning)
    row = np.eye(size + 1)[-1]
    for start in np.random.default_rng(0).uniform(-np.pi, np.pi, (_STARTS, size)):
        y = settled(system, _nearer(system, np.append(start, 0.0)), row)
        if y is None or np.linalg.cond(system.plain(y)[1][:, :-1]) > _SINGULAR:
            continue
        if not system.is_genuine([arb(x) for x in y]):
            continue
        turns = np.where(arm.turning, np.round(y[:-1] / (2 * np.pi)), 0.0)
        values = y[:-1] - 2 * np.pi * turns
        if all(np.abs(np.sin((values - other) / 2)).max() > 1e-6 for other in met):
            met.append(values)
            yield SolvedPosture(tuple(arb(float(x)) for x in values * arm.scales), None)
