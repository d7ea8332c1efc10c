"""The closed loop of a six-joint arm as polynomial equations, and its solutions.

X(theta2, theta3, theta4) = Y(theta6, theta1) of `raghavan_roth` in (c, s): fourteen
equations and five circles in ten unknowns. Joint 5 follows from the loop.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq_poly
from numpy.typing import NDArray

from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.quadratic_matrix import QuadraticField
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.postures.arm import ArmArrays
from cuspaudit.kinematics.postures.loop_closure import closes
from cuspaudit.kinematics.postures.loop_turns import arm_at, closing_turn, elements_at
from cuspaudit.kinematics.postures.raghavan_roth import closed, fifth_axis, first_side

__all__ = ["element_in", "loop_equations", "postures_by_equations"]

Array = NDArray[Any]

_JOINTS = (6, 1, 2, 3, 4)
_TIMEOUT = 15
SURD = "surd"


def loop_equations(
    field: QuadraticField, fifth: Array, side: Array
) -> tuple[Ring, list[Polynomial]]:
    """The equations in c2, s2, ..., with sqrt m as the variable "surd".

    Args:
        field: K.
        fifth: X, (14, 3, 3, 3), in K.
        side: Y, (14, 3, 3), in K.
    """
    names = [f"{x}{k}" for k in _JOINTS for x in "cs"]
    ring = Ring([*names, SURD] if field.radicand else names)
    sixth, first, second, third, fourth = (
        (ring.constant(1), ring.gen(f"c{k}"), ring.gen(f"s{k}")) for k in _JOINTS
    )
    equations = [
        ring.total(
            element_in(ring, x[i, j, k]) * second[i] * third[j] * fourth[k]
            for i, j, k in np.ndindex(3, 3, 3)
        )
        - ring.total(
            element_in(ring, y[i, j]) * sixth[i] * first[j] for i, j in np.ndindex(3, 3)
        )
        for x, y in zip(fifth, side, strict=True)
    ]
    equations += [c**2 + s**2 - 1 for _, c, s in (sixth, first, second, third, fourth)]
    if field.radicand:
        equations.append(ring.gen(SURD) ** 2 - field.radicand)
    return ring, equations


def element_in(ring: Ring, element: Any) -> Polynomial:
    """An element of K, its sqrt m the variable "surd"."""
    if not isinstance(element, fmpq_poly):
        return ring.constant(element)
    rest = element[1]
    own = ring.constant(element[0])
    return own + ring.gen(SURD) * rest if rest else own


def postures_by_equations(
    field: QuadraticField, arm: ArmArrays, pose: Array, seed: int
) -> tuple[fmpq_poly, list[fmpq_poly], tuple[str, ...]]:
    """All complex postures, and what their completeness rests on.

    Args:
        field: K.
        arm: entries in K.
        pose: (4, 4), in K.
        seed: of the linear forms.

    Returns:
        omega, monic and square-free with one posture over each root, and rho_i:
        (c_1, s_1, ..., c_6, s_6), and sqrt m last unless K = Q, are rho_i / omega'.

    Raises:
        UnableError: the equations are too hard, or do not close the loop.
        NotZeroDimensionalError: infinitely many postures have this pose.
    """
    fifth = field.reduced(fifth_axis(arm))
    side = field.reduced(first_side(arm, field.reduced(closed(arm, pose))))
    ring, equations = loop_equations(field, fifth, side)
    system = PolynomialSystem(ring, tuple(p for p in equations if p != 0))
    found = solve_zero_dimensional(system, seed=seed, timeout=_TIMEOUT)
    omega, at = found.omega, dict(zip(ring.variables, found.coordinates, strict=True))
    pairs = {k: (at[f"c{k}"], at[f"s{k}"]) for k in _JOINTS}
    surd = at.get(SURD)
    pairs[5] = closing_turn(arm_at(arm, surd), elements_at(pose, surd), pairs)
    values = [x for k in range(1, 7) for x in pairs[k]]
    rho = [
        x * omega.derivative() % omega
        for x in (*values, *([] if surd is None else [surd]))
    ]
    if not closes(field, arm, pose, omega, rho):
        raise UnableError("exact postures", "the equations do not close the loop")
    return omega, rho, found.grounds
