"""A posture of a waypoint, settled, and proved to be one where it is regular."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.strand import settled
from cuspaudit.toolpath.following.tube import Knot, knot_at
from cuspaudit.toolpath.traced_arm import TracedArm

__all__ = ["Known", "known_posture"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """A posture of the first or last pose.

    Attributes:
        knot: round it; None where it is singular, or too near to tell.
        values: coordinates, nearly; angles in (-pi, pi].
        sign: of det J, proved; 0 where it is singular, None where neither is proved.
    """

    knot: Knot | None
    values: Array
    sign: int | None


def known_posture(
    arm: TracedArm,
    system: LegSystem,
    values: Sequence[float],
    s: float,
    sign: int | None = None,
) -> Known:
    """The posture near joint ``values``, settled and proved where it is regular."""
    near = np.array(values, dtype=np.float64) / arm.scales
    if sign == 0:
        return Known(None, near, 0)
    row = np.zeros(len(near) + 1)
    row[-1] = 1.0
    y = settled(system, np.append(near, s), row)
    if y is None or np.abs(y[:-1] - near).max() > 1e-3:
        return Known(None, near, sign)
    y[-1] = s
    knot = knot_at(system, y, np.eye(len(y))[:, :-1])
    if knot is None or not system.is_genuine(knot.balls()):
        return Known(None, y[:-1], sign)
    determinant = arm.determinant(knot.balls()[:-1])
    sign = int(determinant > 0) - int(determinant < 0) or sign
    return Known(knot, y[:-1], sign)
